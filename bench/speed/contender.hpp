#pragma once
/// Ways to integrate the standard case. Each one finds every reversal and returns the amplitude.
///
/// The general solvers integrate one interval at a time with the sign of the friction frozen. So a step that passes
/// the reversal keeps its order. They start anew after the reversal.

#include <functional>
#include <string>
#include <vector>

#include "bench/speed/standard_case.hpp"

namespace dualdamp::bench::speed {

/// The result of a contender over some forcing periods.
struct IntegratedMotion {
  double amplitude = 0.0;  ///< half the distance between the last two turning points [m]
  long reversals = 0;
};

struct Contender {
  std::string name;
  double tolerance = 0.0;  ///< relative and absolute, of a step; 0: exact
  int oscillators = 1;     ///< integrated at once; a time is for one of them
  /// From the start of the orbit over some forcing periods.
  std::function<IntegratedMotion(int periods)> integrate;
};

/// The exact engine.
[[nodiscard]] Contender exact_contender(const StandardCase& work);

/// The exact engine's batches on one thread, one contender for each width of vector register that the processor
/// has. The first oscillator is the standard case; the others differ in friction by up to a tenth, so that no two
/// move alike.
[[nodiscard]] std::vector<Contender> batch_contenders(const StandardCase& work);

/// Boost.Odeint's Dormand-Prince pair with dense output, at 1e-9 and 1e-12 (relative and absolute, of a step). The
/// reversal is found on the dense output by bisection until the bracket is 1e-15 of the step; for the last one by
/// Boost.Math's TOMS 748, which needs fewer evaluations. After a reversal a step has the size of the last one.
[[nodiscard]] std::vector<Contender> odeint_contenders(const StandardCase& work);

/// SUNDIALS CVODE with a root function, at 1e-9 and 1e-12: Adams with fixed-point iteration, BDF with dense Newton
/// and the exact Jacobian. CVODE chooses its first step after a reversal. Empty where SUNDIALS is not installed.
[[nodiscard]] std::vector<Contender> cvode_contenders(const StandardCase& work);

/// SciPy's solve_ivp, DOP853 with a terminal event, in a child process that times itself.
struct ScipyResult {
  IntegratedMotion motion;
  std::vector<double> seconds;  ///< of processor time for each batch: one start and `periods` forcing periods
};

/// One result for each tolerance; empty where Python or SciPy is missing.
[[nodiscard]] std::vector<ScipyResult> integrate_with_scipy(const StandardCase& work,
                                                            const std::vector<double>& tolerances, int batches,
                                                            int periods);

}  // namespace dualdamp::bench::speed
