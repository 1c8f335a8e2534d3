#include "friction_models/registry.hpp"

#include <algorithm>

#include "friction_models/contact_compliance.hpp"
#include "friction_models/coulomb.hpp"
#include "friction_models/modifiers.hpp"

namespace dualdamp::friction {

namespace {

using Values = ParameterValues;

std::vector<LawEntry> make_list() {
  return {
      {.name = "contact_compliance",
       .summary = "Coulomb slider behind a contact spring, which may be damped",
       .equation =
           "stuck: F = contact_stiffness (x - a) + contact_damping v, |F| < static;  slipping: F = +-kinetic",
       .states = "position of the slider",
       .sources = "liang2004identifying, jenkins1962, iwan1966",
       .parameters = ContactCompliance::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         return {Law(ContactCompliance(p.number("kinetic"), p.number("static"), p.number("contact_stiffness"),
                                       p.number("contact_damping")))};
       }},
      {.name = "coulomb",
       .summary = "constant force against the motion, static limit at rest",
       .equation = "slip: F = kinetic sgn v;  rest: F = pull while |pull| <= static",
       .sources = "coulomb1785, denhartog1931",
       .parameters = Coulomb::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         return {Law(Coulomb(p.number("kinetic"), p.number("static")))};
       }},
  };
}

}  // namespace

const std::vector<LawEntry>& laws() {
  static const std::vector<LawEntry> list = [] {
    std::vector<LawEntry> entries = make_list();
    for (LawEntry& entry : entries) entry.parameters = with_modifiers(std::move(entry.parameters), entry.modifiers);
    return entries;
  }();
  return list;
}

const LawEntry* find_law(std::string_view name) {
  const auto& list = laws();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const LawEntry& entry) { return entry.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace dualdamp::friction
