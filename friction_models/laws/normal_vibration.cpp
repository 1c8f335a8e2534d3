#include "friction_models/laws/normal_vibration.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "friction_models/formulas/smooth.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& NormalVibration::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "mu", .unit = "1", .range = not_negative, .meaning = "coefficient of friction while slipping"},
      {.name = "mu_static",
       .unit = "1",
       .same_as = "mu",
       .range = not_negative,
       .at_least = "mu",
       .meaning = "coefficient of friction at rest"},
      {.name = "weight", .unit = "N", .range = positive, .meaning = "steady load on the contact"},
      {.name = "normal_mass", .unit = "kg", .range = positive, .meaning = "mass that vibrates on the contact"},
      {.name = "static_approach",
       .unit = "m",
       .range = positive,
       .meaning = "compression of the contact by the weight"},
      {.name = "normal_damping_ratio",
       .unit = "1",
       .range = not_negative,
       .meaning = "damping ratio of small normal vibrations"},
      {.name = "lift", .unit = "N.s/m", .range = not_negative, .meaning = "lift force per speed at low speed"},
      {.name = "lift_velocity",
       .unit = "m/s",
       .range = positive,
       .meaning = "speed at which the lift is half of its largest value"},
  };
  return table;
}

std::vector<std::string> NormalVibration::warnings(const ParameterValues& values) {
  const double largest = values.number("lift") * values.number("lift_velocity");
  const double weight = values.number("weight");
  if (largest <= weight) return {};
  const std::string unit = values.unit("N");
  return {"fast slip carries the whole weight and opens the contact and keeps it open: the lift comes to " +
          core::format_number(largest, 4) + " " + unit + ", the weight is " + core::format_number(weight, 4) + " " +
          unit};
}

NormalVibration::NormalVibration(const Rider& rider)
    : rider_(rider), frequency_(std::sqrt(2.0 * rider.weight / (rider.static_approach * rider.normal_mass))) {}

NormalVibration::NormalVibration(const ParameterValues& values)
    : NormalVibration(Rider{.mu = values.number("mu"),
                            .mu_static = values.number("mu_static"),
                            .weight = values.number("weight"),
                            .normal_mass = values.number("normal_mass"),
                            .static_approach = values.number("static_approach"),
                            .normal_damping_ratio = values.number("normal_damping_ratio"),
                            .lift = values.number("lift"),
                            .lift_velocity = values.number("lift_velocity")}) {}

double NormalVibration::respond(const Memory& memory, const Instant& now, Direction direction,
                                std::span<double> rates) const {
  const double normal = normal_force(memory);
  const double speed = memory.state[1];
  const double lift =
      rider_.lift * rider_.lift_velocity * saturated(sign(direction) * now.v / rider_.lift_velocity);
  rates[0] = speed;
  rates[1] =
      (normal - rider_.weight + lift) / rider_.normal_mass - 2.0 * rider_.normal_damping_ratio * frequency_ * speed;
  return sign(direction) * now.force_limit_now(rider_.mu * normal);
}

LawEntry normal_vibration_entry() {
  return {.name = "normal_vibration",
          .summary = "Coulomb friction under a vibrating normal load, with a lift that grows with the speed",
          .equation =
              "F = mu N sgn v, N = weight (1 - y/h0)^2 while y < h0;  normal_mass y'' + d y' = N - weight + lift "
              "|v|/(1 + |v|/lift_velocity);  stick: F = pull while |pull| <= mu_static N",
          .engine = EngineKind::smooth,
          .states = "separation y and its rate, and whether the contact is open",
          .sources = "tolstoi1967, oden1985",
          .modifiers = {"drift", "fluctuation", "warming"},
          .parameters = NormalVibration::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            return {modified(Law(NormalVibration(p)), p, {}, {.states_move = true})};
          },
          .warnings = NormalVibration::warnings};
}

}  // namespace dualdamp::friction
