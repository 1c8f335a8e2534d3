#include "friction_models/laws/coulomb.hpp"

#include "friction_models/formulas/static_parameter.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& Coulomb::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic", .unit = "N", .range = not_negative, .meaning = "friction force while slipping"},
      static_parameter("largest force that holds the mass at rest"),
  };
  return table;
}

LawEntry coulomb_entry() {
  return {.name = "coulomb",
          .summary = "constant force against the slip, static friction at v = 0",
          .equation = "slip: F = kinetic sgn v;  stick: F = pull while |pull| <= static",
          .sources = "coulomb1785, denhartog1931",
          .modifiers = all_modifiers(),
          .parameters = Coulomb::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Law law(Coulomb(p.number("kinetic"), p.number("static")));
            return {modified(law, p, {p.number("kinetic"), p.number("static")})};
          }};
}

}  // namespace dualdamp::friction
