#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "bench/speed/contender.hpp"

namespace dualdamp::bench::speed {
namespace {

namespace odeint = boost::numeric::odeint;
using State = std::array<double, 2>;

/// The right side of one phase: sgn v is `direction` throughout.
struct Field {
  double damping;  // per mass, all of them
  double stiffness;
  double base;
  double friction;
  double frequency;
  double direction = 0.0;

  explicit Field(const StandardCase& work)
      : damping(work.damping / work.mass),
        stiffness(work.stiffness / work.mass),
        base(work.stiffness * work.base_amplitude / work.mass),
        friction(work.friction / work.mass),
        frequency(work.frequency) {}

  [[nodiscard]] double pull(double x, double t) const { return base * std::cos(frequency * t) - stiffness * x; }

  void operator()(const State& state, State& rate, double t) const {
    rate[0] = state[1];
    rate[1] = pull(state[0], t) - damping * state[1] - friction * direction;
  }
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

}  // namespace

Followed OdeintContender::follow(int periods) const {
  const double end = periods * 2.0 * std::numbers::pi / work_.frequency;
  auto stepper = odeint::make_dense_output(tolerance_, tolerance_, odeint::runge_kutta_dopri5<State>());
  Field field(work_);
  State state{work_.start_position, work_.start_velocity};
  field.direction = std::copysign(1.0, state[1]);
  stepper.initialize(state, 0.0, 0.01 / work_.frequency);

  Followed followed;
  double turning = 0.0;
  for (;;) {
    const auto [begin, reached] = stepper.do_step(field);
    double time = reached;
    const bool reverses = field.direction * stepper.current_state()[1] < 0.0;
    if (reverses) {
      const auto velocity = [&](double t) {
        stepper.calc_state(t, state);
        return state[1];
      };
      // Right after a reversal the velocity at the beginning is zero; its sign is that of the phase.
      const double before = field.direction * std::max(std::abs(stepper.previous_state()[1]), 1e-300);
      time = locate(locator_, velocity, begin, reached, before, stepper.current_state()[1]);
    }
    if (time >= end) return followed;
    if (!reverses) continue;

    stepper.calc_state(time, state);
    const double pull = field.pull(state[0], time);
    if (std::abs(pull) <= field.friction) throw std::logic_error("the standard case does not stick");
    field.direction = std::copysign(1.0, pull);
    state[1] = 0.0;
    stepper.initialize(state, time, stepper.current_time_step());
    followed.amplitude = 0.5 * std::abs(state[0] - turning);
    turning = state[0];
    ++followed.reversals;
  }
}

}  // namespace dualdamp::bench::speed
