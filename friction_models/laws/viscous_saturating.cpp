#include "friction_models/laws/viscous_saturating.hpp"

#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ViscousSaturating::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "coefficient", .unit = "N.s/m", .range = not_negative, .meaning = "viscous friction at low speed"},
      {.name = "saturation_velocity",
       .unit = "m/s",
       .range = positive,
       .meaning = "speed at which the force is half of its largest value"},
  };
  return table;
}

LawEntry viscous_saturating_entry() {
  return {.name = "viscous_saturating",
          .summary = "viscous friction that saturates with speed",
          .equation = "F = coefficient v/(1 + |v|/saturation_velocity)",
          .engine = EngineKind::smooth,
          .sources = "cross1965",
          .modifiers = {"drift", "fluctuation", "warming"},
          .parameters = ViscousSaturating::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Law law(ViscousSaturating(p.number("coefficient"), p.number("saturation_velocity")));
            return {modified(law, p)};
          }};
}

}  // namespace dualdamp::friction
