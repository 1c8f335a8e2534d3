#include "friction_models/laws/rate_state.hpp"

#include <cmath>
#include <numbers>

#include "core/numbers.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

namespace {

/// asinh(ratio exp(exponent)); the exponential alone may overflow.
double asinh_scaled(double ratio, double exponent) {
  constexpr double largest = 300.0;
  if (exponent < largest) return std::asinh(ratio * std::exp(exponent));
  if (ratio == 0.0) return 0.0;
  // asinh y = ln 2y + O(1/y^2), used where y itself may overflow.
  const double logarithm = exponent + std::log(std::abs(ratio));
  if (logarithm < largest) return std::copysign(std::asinh(std::exp(logarithm)), ratio);
  return std::copysign(logarithm + std::numbers::ln2, ratio);
}

/// r ln |r|, which is 0 at 0.
double entropy(double r) { return r == 0.0 ? 0.0 : r * std::log(std::abs(r)); }

}  // namespace

const std::vector<Parameter>& RateState::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "normal_force",
       .unit = "N",
       .range = not_negative,
       .meaning = "force that presses the faces together"},
      {.name = "mu0",
       .unit = "1",
       .range = positive,
       .meaning = "coefficient of steady friction at the reference velocity"},
      {.name = "a", .unit = "1", .range = positive, .meaning = "direct effect: immediate rise with ln of speed"},
      {.name = "b",
       .unit = "1",
       .range = not_negative,
       .meaning = "evolution effect: fall with ln of speed, over the slip distance"},
      {.name = "slip_distance", .unit = "m", .range = positive, .meaning = "slip over which contacts are renewed"},
      {.name = "reference_velocity", .unit = "m/s", .range = positive, .meaning = "speed to which mu0 refers"},
      {.name = "evolution",
       .kind = ParameterKind::choice,
       .words = {"aging", "slip"},
       .fallback = "aging",
       .meaning = "how contacts change: with time and slip, or with slip only"},
  };
  return table;
}

std::vector<std::string> RateState::warnings(const ParameterValues& values) {
  // While the mass creeps its contacts age. Up to mu0/a = 40 such motions are computed. Above, some are given up,
  // and from 60 on some runs had reversals of a creep that a run with a tighter tolerance does not have.
  constexpr double largest = 40.0;
  const double ratio = values.number("mu0") / values.number("a");
  if (ratio <= largest) return {};
  return {
      "at a reversal the force changes its sign within exp(-mu0/a) = exp(-" + core::format_number(ratio, 3) +
      ") of the reference velocity: a creeping motion may be given up (status 4), and the number of its reversals "
      "is uncertain"};
}

RateState::RateState(const ParameterValues& values)
    : RateState(Contact{.normal_force = values.number("normal_force"),
                        .mu0 = values.number("mu0"),
                        .a = values.number("a"),
                        .b = values.number("b"),
                        .slip_distance = values.number("slip_distance"),
                        .reference_velocity = values.number("reference_velocity"),
                        .evolution = values.choice("evolution") == "slip" ? Evolution::slip : Evolution::aging}) {}

double RateState::respond(const Memory& memory, const Instant& now, Direction direction,
                          std::span<double> rates) const {
  const double psi = memory.state[0];
  const double ratio = now.v / contact_.reference_velocity;
  const double speed_ratio = sign(direction) * ratio;
  const double pace = contact_.reference_velocity / contact_.slip_distance;
  rates[0] = contact_.evolution == Evolution::aging ? pace * (std::exp(-psi) - speed_ratio)
                                                    : -pace * (entropy(speed_ratio) + speed_ratio * psi);
  const double exponent = (contact_.mu0 + contact_.b * psi) / contact_.a;
  return now.force_limit_now(contact_.normal_force) * contact_.a * asinh_scaled(0.5 * ratio, exponent);
}

LawEntry rate_state_entry() {
  return {.name = "rate_state",
          .summary =
              "friction that rises with ln of speed immediately, and falls with ln of speed over a slip distance",
          .equation =
              "F = a normal_force asinh(v/(2 V0) exp((mu0 + b psi)/a));  aging: psi' = (V0/Dc) (exp(-psi) - "
              "|v|/V0);  slip: psi' = -(|v|/Dc) (ln(|v|/V0) + psi)",
          .engine = EngineKind::smooth,
          .states = "age psi of the contacts, ln",
          .sources = "dieterich1979, ruina1983, rice1983, rice2001",
          .modifiers = {"drift", "fluctuation", "warming"},
          .parameters = RateState::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> { return {modified(Law(RateState(p)), p)}; },
          .warnings = RateState::warnings};
}

}  // namespace dualdamp::friction
