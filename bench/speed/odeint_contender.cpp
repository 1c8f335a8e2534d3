#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <cstdint>

#include "bench/speed/contender.hpp"
#include "core/constants.hpp"

namespace dualdamp::bench::speed {
namespace {

namespace odeint = boost::numeric::odeint;
using State = std::array<double, 2>;

/// Method that finds the time of a reversal on the dense output of a step.
enum class Locator {
  bisection,  ///< until the bracket is 1e-15 of the step
  toms748,    ///< Boost.Math's bracketing solver to the last bits: fewer evaluations
};

/// A time between `low` and `high`, where `velocity` changes sign.
template <class Velocity>
double locate(Locator locator, const Velocity& velocity, double low, double high, double at_low, double at_high) {
  if (locator == Locator::toms748) {
    std::uintmax_t evaluations = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        velocity, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(50), evaluations);
    return bracket.second;
  }
  const double width = 1e-15 * (high - low);
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((velocity(middle) > 0.0) == (at_low > 0.0) ? low : high) = middle;
  }
  return high;
}

IntegratedMotion integrate(const StandardCase& work, double tolerance, Locator locator, int periods) {
  const double end = periods * core::two_pi / work.frequency;
  auto stepper = odeint::make_dense_output(tolerance, tolerance, odeint::runge_kutta_dopri5<State>());
  IntervalField field(work);
  const auto system = [&field](const State& state, State& rate, double t) {
    rate[0] = state[1];
    rate[1] = field.acceleration(state[0], state[1], t);
  };
  State state{work.start_position, work.start_velocity};
  field.direction = std::copysign(1.0, state[1]);
  stepper.initialize(state, 0.0, 0.01 / work.frequency);

  IntegratedMotion motion;
  double turning = 0.0;
  for (;;) {
    const auto [begin, reached] = stepper.do_step(system);
    double time = reached;
    const bool reverses = field.direction * stepper.current_state()[1] < 0.0;
    if (reverses) {
      const auto velocity = [&](double t) {
        stepper.calc_state(t, state);
        return state[1];
      };
      // Right after a reversal the velocity at the beginning is zero; its sign is that of the interval.
      const double before = field.direction * std::max(std::abs(stepper.previous_state()[1]), 1e-300);
      time = locate(locator, velocity, begin, reached, before, stepper.current_state()[1]);
    }
    if (time >= end) return motion;
    if (!reverses) continue;

    stepper.calc_state(time, state);
    field.direction = field.direction_after(state[0], time);
    state[1] = 0.0;
    stepper.initialize(state, time, stepper.current_time_step());
    motion.amplitude = 0.5 * std::abs(state[0] - turning);
    turning = state[0];
    ++motion.reversals;
  }
}

Contender contender(const char* name, const StandardCase& work, double tolerance, Locator locator) {
  return {name, tolerance, 1, [=](int periods) { return integrate(work, tolerance, locator, periods); }};
}

}  // namespace

std::vector<Contender> odeint_contenders(const StandardCase& work) {
  return {contender("Odeint dopri5 1e-9, bisection", work, 1e-9, Locator::bisection),
          contender("Odeint dopri5 1e-12, bisection", work, 1e-12, Locator::bisection),
          contender("Odeint dopri5 1e-9, TOMS 748", work, 1e-9, Locator::toms748)};
}

}  // namespace dualdamp::bench::speed
