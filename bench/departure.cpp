#include "bench/departure.hpp"

#include <algorithm>

namespace dualdamp::bench {

std::string CaseDeparture::name() const {
  if (is_truth()) return std::string(identify::departures::plain_name);
  return std::string(first->name) + (beside == nullptr ? "" : " + " + std::string(beside->name));
}

Family CaseDeparture::family() const {
  if (is_truth()) return Family::none;
  return beside == nullptr ? first->family : Family::pairs;
}

std::string CaseDeparture::meaning_of_severity() const {
  if (is_truth()) return "";
  return std::string(first->severity) + (beside == nullptr ? "" : "; " + std::string(beside->severity));
}

double CaseDeparture::largest_severity() const {
  return beside == nullptr ? first->largest : std::min(first->largest, beside->largest);
}

bool CaseDeparture::has_zeta() const {
  return is_truth() || (first->has_zeta && (beside == nullptr || beside->has_zeta));
}

bool CaseDeparture::has_F0() const {
  return is_truth() || (first->has_F0 && (beside == nullptr || beside->has_F0));
}

bool CaseDeparture::needs_sweeps() const {
  return (first != nullptr && first->needs_sweeps) || (beside != nullptr && beside->needs_sweeps);
}

sim::Model CaseDeparture::model(const Truth& truth, const ReferenceMotion& reference, double s) const {
  if (is_truth()) return undisturbed(truth);
  if (beside == nullptr) return departed(*first, truth, reference, s);
  // The second departure changes oscillator and drive; friction is that of the first. The last law of the second is
  // the Coulomb friction of the truth, which is removed; the laws before it are part of the structure.
  Truth changed = truth;
  changed.model = departed(*beside, truth, reference, s);
  changed.model.friction.pop_back();
  return departed(*first, changed, reference, s);
}

void CaseDeparture::mislead(Laboratory& laboratory, const ReferenceMotion& reference, double s) const {
  for (const Departure* one : {first, beside})
    if (one != nullptr && one->mislead != nullptr) one->mislead(laboratory, reference, s);
}

bool leaves_friction_alone(const Departure& departure) {
  switch (departure.family) {
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
