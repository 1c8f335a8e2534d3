#include "bench/departure.hpp"

#include <algorithm>

namespace dualdamp::bench {

std::string Departure::name() const {
  if (is_truth()) return truth_name;
  return std::string(rig->name) + (beside == nullptr ? "" : " + " + std::string(beside->name));
}

Family Departure::family() const {
  if (is_truth()) return Family::none;
  return beside == nullptr ? rig->family : Family::pairs;
}

std::string Departure::severity() const {
  if (is_truth()) return "";
  return std::string(rig->severity) + (beside == nullptr ? "" : "; " + std::string(beside->severity));
}

double Departure::largest() const {
  return beside == nullptr ? rig->largest : std::min(rig->largest, beside->largest);
}

bool Departure::has_zeta() const {
  return is_truth() || (rig->has_zeta && (beside == nullptr || beside->has_zeta));
}

bool Departure::has_F0() const { return is_truth() || (rig->has_F0 && (beside == nullptr || beside->has_F0)); }

bool Departure::needs_sweeps() const {
  return (rig != nullptr && rig->needs_sweeps) || (beside != nullptr && beside->needs_sweeps);
}

sim::Model Departure::model(const Truth& truth, const ReferenceMotion& reference, double s) const {
  if (is_truth()) return undisturbed(truth);
  if (beside == nullptr) return departed(*rig, truth, reference, s);
  // The second rig changes oscillator and drive; friction is that of the first rig. The last law of the second rig
  // is the Coulomb friction of the truth, which is removed; the laws before it are part of the structure.
  Truth changed = truth;
  changed.model = departed(*beside, truth, reference, s);
  changed.model.friction.pop_back();
  return departed(*rig, changed, reference, s);
}

void Departure::mislead(Laboratory& laboratory, const ReferenceMotion& reference, double s) const {
  for (const Rig* one : {rig, beside})
    if (one != nullptr && one->mislead != nullptr) one->mislead(laboratory, reference, s);
}

bool leaves_friction_alone(const Rig& rig) {
  switch (rig.family) {
    case Family::spring:
    case Family::sensors:
    case Family::constants:
    case Family::drive:
      return true;
    default:
      return false;
  }
}

}  // namespace dualdamp::bench
