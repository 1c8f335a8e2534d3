#include "friction_models/laws/viscous_power.hpp"

#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ViscousPower::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "coefficient",
       .unit = "N",
       .range = not_negative,
       .at_speed = "reference_velocity",
       .power = "exponent",
       .meaning = "force at the reference velocity"},
      {.name = "reference_velocity",
       .unit = "m/s",
       .fallback = 1.0,
       .range = positive,
       .meaning = "speed at which the force equals the coefficient"},
      {.name = "exponent",
       .unit = "1",
       .range = positive,
       .meaning = "exponent of the speed: 1 for a dashpot, 2 for drag"},
  };
  return table;
}

LawEntry viscous_power_entry() {
  return {
      .name = "viscous_power",
      .summary = "force against the motion proportional to a power of speed: drag, films that thin under shear",
      .equation = "F = coefficient (|v|/reference_velocity)^exponent sgn v",
      .engine = EngineKind::smooth,
      .sources = "ostwald1925, jacobsen1930",
      .modifiers = {"drift", "fluctuation", "warming"},
      .parameters = ViscousPower::parameters(),
      .make = [](const ParameterValues& p) -> std::vector<Law> {
        const Law law(ViscousPower(p.number("coefficient"), p.number("reference_velocity"), p.number("exponent")));
        return {modified(law, p)};
      }};
}

}  // namespace dualdamp::friction
