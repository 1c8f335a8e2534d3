#include "friction_models/registry.hpp"

#include <algorithm>

#include "friction_models/contact_compliance.hpp"
#include "friction_models/coulomb.hpp"

namespace dualdamp::friction {

const std::vector<LawEntry>& laws() {
  static const std::vector<LawEntry> list = {
      {"contact_compliance", "Coulomb slider behind a contact spring, which may be damped",
       "stuck: F = contact_stiffness (x - a) + contact_damping v, |F| < static;  slipping: F = +-kinetic",
       EngineKind::exact, ContactCompliance::parameters(),
       [](const ParameterValues& p) {
         return Law(ContactCompliance(p.at("kinetic"), p.at("static"), p.at("contact_stiffness"),
                                      p.at("contact_damping")));
       }},
      {"coulomb", "constant force against the motion, static limit at rest",
       "slip: F = kinetic sgn v;  rest: F = pull while |pull| <= static", EngineKind::exact, Coulomb::parameters(),
       [](const ParameterValues& p) { return Law(Coulomb(p.at("kinetic"), p.at("static"))); }},
  };
  return list;
}

const LawEntry* find_law(std::string_view name) {
  const auto& list = laws();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const LawEntry& entry) { return entry.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace dualdamp::friction
