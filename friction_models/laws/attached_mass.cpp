#include "friction_models/laws/attached_mass.hpp"

#include "friction_models/law_entry.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& AttachedMass::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "mass",
       .unit = "kg",
       .range = positive,
       .meaning = "attached mass, in addition to that of the oscillator"},
      {.name = "stiffness",
       .unit = "N/m",
       .range = positive,
       .meaning = "stiffness of the spring between both masses"},
      {.name = "damping",
       .unit = "N.s/m",
       .fallback = 0.0,
       .range = not_negative,
       .meaning = "damper in parallel with that spring"},
  };
  return table;
}

double AttachedMass::respond(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const {
  const double z = memory.state[0];
  const double w = memory.state[1];
  const double force = stiffness_ * (now.x - z) + damping_ * (now.v - w);
  rates[0] = w;
  rates[1] = force / mass_;
  return force;
}

double AttachedMass::dissipation(const Memory& memory, const Instant& now, Direction) const {
  const double stretching = now.v - memory.state[1];
  return damping_ * stretching * stretching;
}

LawEntry attached_mass_entry() {
  return {.name = "attached_mass",
          .summary = "oscillator attached to the mass: a second mode, a tuned mass damper; no friction",
          .equation = "F = stiffness (x - z) + damping (v - z');  mass z'' = F",
          .engine = EngineKind::smooth,
          .states = "position z and velocity of the attached mass",
          .sources = "ormondroyd1928",
          .parameters = AttachedMass::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            return {Law(AttachedMass(p.number("mass"), p.number("stiffness"), p.number("damping")))};
          }};
}

}  // namespace dualdamp::friction
