#include "friction_models/laws/stribeck.hpp"

#include <algorithm>
#include <iterator>

#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& Stribeck::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = StribeckCurve::parameters(not_negative);
    std::ranges::copy(StribeckCurve::shape_parameters(), std::back_inserter(list));
    return list;
  }();
  return table;
}

LawEntry stribeck_entry() {
  return {.name = "stribeck",
          .summary = "force against the motion that falls with speed, static friction at v = 0",
          .equation =
              "slip: F = level(|v|) sgn v, level(u) = kinetic + (static - kinetic) h(u/stribeck_velocity), "
              "h(r) = exp(-r^exponent), exp(-r) or 1/(1 + r^2) by form;  stick: F = pull while |pull| <= static",
          .engine = EngineKind::smooth,
          .sources = "stribeck1902, armstrong1994, bo1982",
          .modifiers = all_modifiers(),
          .parameters = Stribeck::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            return {modified(Law(Stribeck(StribeckCurve(p))), p, {p.number("kinetic"), p.number("static")})};
          },
          .check = StribeckCurve::check_shape};
}

}  // namespace dualdamp::friction
