#pragma once
/// Ways to follow the standard case. Each one finds every reversal and hands out the amplitude.

#include "bench/speed/standard_case.hpp"
#include "sim/exact_engine.hpp"

namespace dualdamp::bench::speed {

/// What a contender has found over some forcing periods.
struct Followed {
  double amplitude = 0.0;  ///< half the distance between the last two turning points [m]
  long reversals = 0;
};

/// The exact engine.
class ExactContender {
 public:
  explicit ExactContender(const StandardCase& work) : work_(work), engine_(model_of(work)) {}

  /// From the start of the orbit over `periods` forcing periods.
  [[nodiscard]] Followed follow(int periods);

 private:
  StandardCase work_;
  sim::ExactEngine engine_;
};

/// How the time of a reversal is found on the dense output of a step.
enum class Locator {
  bisection,  ///< until the bracket is 1e-15 of the step
  toms748,    ///< Boost.Math's bracketing solver to the last bits: fewer evaluations
};

/// Boost.Odeint's Dormand-Prince pair with dense output. The sign of the friction is frozen within a phase, so that
/// a step may overrun the reversal and keeps its order; after a reversal the stepper starts anew with its last step
/// size.
class OdeintContender {
 public:
  /// `tolerance`: relative and absolute, of a step.
  OdeintContender(const StandardCase& work, double tolerance, Locator locator)
      : work_(work), tolerance_(tolerance), locator_(locator) {}

  [[nodiscard]] Followed follow(int periods) const;

 private:
  StandardCase work_;
  double tolerance_;
  Locator locator_;
};

}  // namespace dualdamp::bench::speed
