#include "friction_models/registry.hpp"

#include <algorithm>
#include <utility>

#include "friction_models/modifiers/modifiers.hpp"

// The built-in laws, one line each, sorted by name. The source of each law defines its entry, NAME_entry().
#define DUALDAMP_LAWS(LAW)      \
  LAW(asymmetric_coulomb)       \
  LAW(attached_mass)            \
  LAW(bouc_wen)                 \
  LAW(bristle)                  \
  LAW(contact_compliance)       \
  LAW(coulomb)                  \
  LAW(dahl)                     \
  LAW(elasto_plastic)           \
  LAW(free_play)                \
  LAW(friction_lag)             \
  LAW(gap_spring)               \
  LAW(generalized_maxwell_slip) \
  LAW(iwan)                     \
  LAW(iwan_four_parameter)      \
  LAW(lugre)                    \
  LAW(normal_vibration)         \
  LAW(rate_state)               \
  LAW(reset_integrator)         \
  LAW(stribeck)                 \
  LAW(viscous_power)            \
  LAW(viscous_saturating)

namespace dualdamp::friction {

#define DUALDAMP_DECLARE(name) LawEntry name##_entry();
DUALDAMP_LAWS(DUALDAMP_DECLARE)
#undef DUALDAMP_DECLARE

namespace {

std::vector<LawEntry> built_in_laws() {
#define DUALDAMP_ENTRY(name) name##_entry(),
  return {DUALDAMP_LAWS(DUALDAMP_ENTRY)};
#undef DUALDAMP_ENTRY
}

std::vector<LawEntry>& all_laws() {
  static std::vector<LawEntry> list = [] {
    std::vector<LawEntry> entries = built_in_laws();
    for (LawEntry& entry : entries) entry.parameters = with_modifiers(std::move(entry.parameters), entry.modifiers);
    return entries;
  }();
  return list;
}

}  // namespace

const std::vector<LawEntry>& laws() { return all_laws(); }

void add_law(LawEntry entry) {
  entry.parameters = with_modifiers(std::move(entry.parameters), entry.modifiers);
  std::vector<LawEntry>& list = all_laws();
  const auto place = std::ranges::lower_bound(list, entry.name, {}, &LawEntry::name);
  list.insert(place, std::move(entry));
}

void remove_added_law(std::string_view name) {
  std::erase_if(all_laws(), [&](const LawEntry& entry) { return entry.plugin && entry.name == name; });
}

const LawEntry* find_law(std::string_view name) {
  const auto& list = laws();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const LawEntry& entry) { return entry.name == name; });
  return found == list.end() ? nullptr : &*found;
}

std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values) {
  std::vector<ParameterFault> faults = complete(law.parameters, values);
  return faults.empty() && law.check != nullptr ? law.check(values) : faults;
}

}  // namespace dualdamp::friction
