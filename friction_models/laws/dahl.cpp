#include "friction_models/laws/dahl.hpp"

#include <cmath>

#include "friction_models/formulas/smooth.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& Dahl::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic", .unit = "N", .range = positive, .meaning = "friction force after a long slip"},
      {.name = "sigma0", .unit = "N/m", .range = positive, .meaning = "stiffness of the bristles at F = 0"},
      {.name = "exponent",
       .unit = "1",
       .fallback = 1.0,
       .range = {.low = 1.0},
       .meaning = "exponent of the approach to the kinetic friction force"},
  };
  return table;
}

void Dahl::rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const {
  const double kinetic = divisor(now.force_limit_now(kinetic_), kinetic_);
  const double room = 1.0 - sign(direction) * sigma0_ * memory.state[0] / kinetic;
  rates[0] = now.v * (exponent_ == 1.0 ? room : std::copysign(std::pow(std::abs(room), exponent_), room));
}

double Dahl::dissipation(const Memory& memory, const Instant& now, Direction direction) const {
  double rate = 0.0;
  rates(memory, now, direction, {&rate, 1});
  return sigma0_ * memory.state[0] * (now.v - rate);
}

LawEntry dahl_entry() {
  return {.name = "dahl",
          .summary = "bristles that yield gradually, independent of speed (Dahl)",
          .equation = "F = sigma0 z;  z' = v |1 - sigma0 z sgn v/kinetic|^exponent sgn(1 - sigma0 z sgn v/kinetic)",
          .engine = EngineKind::smooth,
          .states = "mean deflection z of the bristles",
          .sources = "dahl1976",
          // Where the load is lost the deflection would relax infinitely fast.
          .modifiers = all_modifiers_but("load_gradient"),
          .parameters = Dahl::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Dahl law(p.number("kinetic"), p.number("sigma0"), p.number("exponent"));
            return {modified(law, p, {p.number("kinetic")})};
          }};
}

}  // namespace dualdamp::friction
