#include "identify/records/faults/phase_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string brief(double value) {
  constexpr int digits = 3;
  return core::format_number(value, digits);
}

/// What the columns may hold instead, and the pairs read so.
struct Cause {
  std::string text, remedy;
  std::vector<Pair> pairs;
};

/// The pairs with every phase multiplied and turned, or with x and Y exchanged.
std::vector<Pair> altered(std::vector<Pair> pairs, double factor, double turn = 0.0, bool swapped = false) {
  for (Pair& pair : pairs) {
    pair.phase = factor * pair.phase + turn;
    if (swapped) std::swap(pair.x, pair.Y);
  }
  return pairs;
}

std::string their_unit(const core::SettingWords& words, std::string_view unit) {
  return "their unit: " + words(core::Setting::unit, "phase", unit);
}

std::vector<Cause> wrong_units(const std::vector<Pair>& pairs, const core::SettingWords& words) {
  return {{"the phases may be degrees", their_unit(words, "deg"), altered(pairs, degree)},
          {"the phases may be radians", their_unit(words, "rad"), altered(pairs, 1.0 / degree)}};
}

/// A phase that was computed from histories is not a column, so its sign is not among the causes.
std::vector<Cause> wrong_signs(const std::vector<Pair>& pairs, bool from_histories,
                               const core::SettingWords& words) {
  using enum core::Setting;
  std::vector<Cause> list;
  if (!from_histories)
    list.push_back({"the phase has the wrong sign", words(scale, "phase", "-1"), altered(pairs, -1.0)});
  list.push_back(
      {"x or Y (x or y) has the wrong sign", words(scale, "x", "-1"), altered(pairs, 1.0, std::numbers::pi)});
  list.push_back({"x and Y (x and y) are swapped", words(column, "x", "...") + ", " + words(column, "Y", "..."),
                  altered(pairs, -1.0, 0.0, true)});
  return list;
}

/// Does another natural frequency, the same for all pairs, explain the phases?
bool fits_with_other_mass(const std::vector<Pair>& pairs, KnownConstants constants) {
  std::vector<double> masses;
  for (const Pair& pair : pairs) {
    const double omega = frequency_of(pair, constants);
    const double mass = constants.stiffness * (1.0 - pair.Y * std::cos(pair.phase) / pair.x) / (omega * omega);
    if (std::isfinite(mass)) masses.push_back(mass);
  }
  if (masses.empty()) return false;
  constants.mass = upper_median(std::move(masses));
  return constants.mass > 0.0 && phases_fit(pairs, constants);
}

struct Causes {
  std::vector<std::string> texts, remedies;

  void add_fitting(const std::vector<Cause>& list, const KnownConstants& constants) {
    for (const Cause& cause : list)
      if (phases_fit(cause.pairs, constants)) add(cause.text, cause.remedy);
  }
  void add(const std::string& text, const std::string& remedy) {
    texts.push_back(text);
    remedies.push_back(remedy);
  }
};

/// The base would take energy out: with the causes that fit; without one, with all.
PhaseFault work_fault(const Balance& balance, const Causes& causes, const core::SettingWords& words) {
  const bool none = causes.texts.empty();
  return {"by the phases, x leads the base in " + std::to_string(balance.negative_work) + " of " +
              std::to_string(balance.phases) + " pairs, so the base would take energy out of the motion: " +
              (none ? "x and Y (x and y) are swapped, or one of them has the wrong sign"
                    : core::joined(causes.texts, ", or ")),
          "phase is the lag of x behind y, from 0 to 180 deg; " +
              (none ? "a sign is turned by " + words(core::Setting::scale, "x", "-1") + ", or " +
                          words(core::Setting::scale, "phase", "-1")
                    : core::joined(causes.remedies, ", or "))};
}

}  // namespace

Balance balance_of(const std::vector<Pair>& pairs, const KnownConstants& constants) {
  Balance balance;
  for (const Pair& pair : pairs) {
    const double omega = frequency_of(pair, constants);
    const double real = (constants.stiffness - constants.mass * omega * omega) / constants.stiffness;
    if (!(std::isfinite(real) && pair.Y > 0.0 && pair.x > 0.0)) continue;
    ++balance.pairs;
    constexpr double room = 3.0;
    balance.too_much += std::abs(real) * pair.x > room * pair.Y ? 1 : 0;
    balance.swapped_too_much += std::abs(real) * pair.Y > room * pair.x ? 1 : 0;
    balance.excess.push_back(std::abs(real) * pair.x / pair.Y);
    if (std::isnan(pair.phase)) continue;
    ++balance.phases;
    balance.negative_work += std::sin(pair.phase) < -0.3 ? 1 : 0;
    balance.cosines.push_back(std::abs(std::cos(pair.phase) - real * pair.x / pair.Y));
  }
  return balance;
}

bool phases_fit(const std::vector<Pair>& pairs, const KnownConstants& constants) {
  constexpr double good = 0.15;
  const Balance balance = balance_of(pairs, constants);
  return !balance.takes_work() && balance.phases > 0 && upper_median(balance.cosines) < good;
}

std::optional<double> excess_of_Y(const std::vector<Pair>& pairs, const KnownConstants& constants) {
  constexpr double beside = 0.03;  // of k
  constexpr double alike = 0.9;
  bool is_below = false;
  bool is_above = false;
  double given = 0.0;
  double needed = 0.0;
  double both = 0.0;
  for (const Pair& pair : pairs) {
    const double omega = frequency_of(pair, constants);
    const double real = (constants.stiffness - constants.mass * omega * omega) / constants.stiffness;
    const double a = pair.Y * std::cos(pair.phase);
    const double b = real * pair.x;
    if (!std::isfinite(a * b)) continue;
    is_below = is_below || real > beside;
    is_above = is_above || real < -beside;
    given += a * a;
    needed += b * b;
    both += a * b;
  }
  if (!is_below || !is_above || !(both * both > alike * given * needed)) return std::nullopt;
  return both / needed;
}

std::optional<PhaseFault> force_phase_fault(const std::vector<Pair>& pairs, const KnownConstants& constants,
                                            const core::SettingWords& words) {
  constexpr double clearly = 0.3;
  int phases = 0;
  int leading = 0;
  int lagging = 0;
  std::vector<Pair> under_base = pairs;  // one that moves by Y/k exerts the force
  for (Pair& pair : under_base) {
    phases += std::isnan(pair.phase) ? 0 : 1;
    leading += std::sin(pair.phase) < -clearly ? 1 : 0;
    lagging += std::sin(pair.phase) > clearly ? 1 : 0;
    pair.Y /= constants.stiffness;
  }
  if (leading == 0 || leading <= lagging) return std::nullopt;
  const std::vector<Cause> causes = {
      {"the phase has the wrong sign", words(core::Setting::scale, "phase", "-1"), altered(under_base, -1.0)},
      {"x or Y has the wrong sign", words(core::Setting::scale, "x", "-1"),
       altered(under_base, 1.0, std::numbers::pi)}};
  Causes found;
  found.add_fitting(causes, constants);
  if (found.texts.empty())
    for (const Cause& cause : causes) found.add(cause.text, cause.remedy);
  return PhaseFault{
      "by the phases, x leads the force in " + std::to_string(leading) + " of " + std::to_string(phases) +
          " pairs, so the force would take energy out of the motion: " + core::joined(found.texts, ", or "),
      "phase is the lag of x behind the force, from 0 to 180 deg; " + core::joined(found.remedies, ", or ")};
}

std::optional<PhaseFault> phase_fault(const std::vector<Pair>& pairs, const KnownConstants& constants,
                                      bool from_histories, const core::SettingWords& words) {
  const Balance balance = balance_of(pairs, constants);
  if (balance.phases == 0) return std::nullopt;
  constexpr double most = 4.0 * std::numbers::pi;
  double largest = 0.0;
  std::vector<const Pair*> beyond;
  for (const Pair& pair : pairs) {
    if (std::isnan(pair.phase)) continue;
    largest = std::max(largest, std::abs(pair.phase));
    if (std::abs(pair.phase) > most) beyond.push_back(&pair);
  }
  const std::string range = "the phases, up to " + brief(largest) + " rad";
  if (!beyond.empty() && !from_histories && 2 * std::ssize(beyond) < balance.phases)
    return PhaseFault{"the phase of pair " + std::to_string(beyond.front()->number) + ", " +
                          brief(beyond.front()->phase / degree) + " deg, is no lag" +
                          (beyond.size() > 1 ? "; so are " + std::to_string(beyond.size() - 1) + " more" : ""),
                      "a phase from 0 to 180 deg, or an empty field where none was measured"};
  if (largest > most && !from_histories)
    return PhaseFault{range + ", are not lags in radians; the phases may be degrees", their_unit(words, "deg")};
  constexpr double bad = 0.4;
  if (!balance.takes_work() && !(upper_median(balance.cosines) > bad)) return std::nullopt;
  Causes causes;
  if (!from_histories) causes.add_fitting(wrong_units(pairs, words), constants);
  if (balance.takes_work()) {
    causes.add_fitting(wrong_signs(pairs, from_histories, words), constants);
    return work_fault(balance, causes, words);
  }
  if (causes.texts.empty()) return std::nullopt;
  if (fits_with_other_mass(pairs, constants))
    causes.add("the mass, the stiffness or the frequency is wrong", "mass, stiffness and frequency in their units");
  return PhaseFault{range + " (" + brief(largest / degree) +
                        " deg), do not fit x and Y, k Y cos(phase) = (k - m w^2) x; " +
                        core::joined(causes.texts, ", or "),
                    core::joined(causes.remedies, ", or ")};
}

}  // namespace dualdamp::identify
