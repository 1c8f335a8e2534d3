#include "friction_models/laws/asymmetric_coulomb.hpp"

#include <utility>

#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/force_limits.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& AsymmetricCoulomb::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic_forward",
       .unit = "N",
       .range = not_negative,
       .meaning = "friction force while slipping forward (v > 0), in the limit of zero speed"},
      {.name = "kinetic_backward",
       .unit = "N",
       .range = not_negative,
       .meaning = "friction force while slipping backward (v < 0), in the limit of zero speed"},
      {.name = "static_forward",
       .unit = "N",
       .same_as = "kinetic_forward",
       .range = not_negative,
       .at_least = "kinetic_forward",
       .meaning = "largest force that holds the mass against a forward pull"},
      {.name = "static_backward",
       .unit = "N",
       .same_as = "kinetic_backward",
       .range = not_negative,
       .at_least = "kinetic_backward",
       .meaning = "largest force that holds the mass against a backward pull"},
      {.name = "viscous_forward",
       .unit = "N.s/m",
       .fallback = 0.0,
       .range = not_negative,
       .meaning = "growth of the force with speed while slipping forward"},
      {.name = "viscous_backward",
       .unit = "N.s/m",
       .same_as = "viscous_forward",
       .range = not_negative,
       .meaning = "growth of the force with speed while slipping backward"},
  };
  return table;
}

Affine AsymmetricCoulomb::affine_force(const Memory&, const Instant& now, Direction direction) const {
  if (direction == Direction::none)
    return 0.5 * (now.force_limit(forward_.static_level) - now.force_limit(backward_.static_level));
  const Side& side = direction == Direction::forward ? forward_ : backward_;
  Affine force = sign(direction) * now.force_limit(side.kinetic);
  force.velocity = side.viscous;
  return force;
}

Affine AsymmetricCoulomb::affine_limit(const Memory&, const Instant& now) const {
  return 0.5 * (now.force_limit(forward_.static_level) + now.force_limit(backward_.static_level));
}

namespace {

/// Modifiers act only on the levels; with modifiers the viscous part is a law of its own.
std::vector<Law> make_asymmetric_coulomb(const ParameterValues& p) {
  AsymmetricCoulomb::Side forward{p.number("kinetic_forward"), p.number("static_forward"),
                                  p.number("viscous_forward")};
  AsymmetricCoulomb::Side backward{p.number("kinetic_backward"), p.number("static_backward"),
                                   p.number("viscous_backward")};
  const std::vector<double> levels = {forward.kinetic, forward.static_level, backward.kinetic,
                                      backward.static_level};
  if (ModifierSettings(p).do_nothing()) return {Law(AsymmetricCoulomb(forward, backward))};
  const double viscous_forward = std::exchange(forward.viscous, 0.0);
  const double viscous_backward = std::exchange(backward.viscous, 0.0);
  std::vector<Law> laws = {modified(Law(AsymmetricCoulomb(forward, backward)), p, levels)};
  if (viscous_forward > 0.0 || viscous_backward > 0.0)
    laws.emplace_back(AsymmetricCoulomb({.viscous = viscous_forward}, {.viscous = viscous_backward}));
  return laws;
}

}  // namespace

LawEntry asymmetric_coulomb_entry() {
  return {.name = "asymmetric_coulomb",
          .summary = "Coulomb and viscous friction with separate values for each direction",
          .equation =
              "slip: F = kinetic_forward + viscous_forward v for v > 0, -kinetic_backward + viscous_backward v "
              "for v < 0;  stick: F = pull while -static_backward <= pull <= static_forward",
          .is_odd = false,
          .sources = "armstrong1994",
          .modifiers = all_modifiers(),
          .parameters = AsymmetricCoulomb::parameters(),
          .make = make_asymmetric_coulomb};
}

}  // namespace dualdamp::friction
