#include "identify/ledger/other_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/records/signals.hpp"
#include "identify/records/usable_histories.hpp"

namespace dualdamp::identify {

namespace {

/// Where x is measured from, and what friction acts against.
struct Geometry {
  const char* words;
  double base_in_x;    ///< motion of the base that is added to x, so that it is the motion against friction
  bool rides_on_base;  ///< friction, damper and spring act against the base
};

constexpr std::array<Geometry, 3> geometries = {{
    {"x is measured from the base, and friction acts against the base", 0.0, true},
    {"x is measured from the ground, and friction acts against the base", -1.0, true},
    {"x is measured from the base, and friction acts against the ground", 1.0, false},
}};

Pair converted(const Pair& pair, const Geometry& geometry, const KnownConstants& constants) {
  const double x = std::isnan(pair.fundamental) ? pair.x : pair.fundamental;
  const std::complex<double> base = std::polar(pair.Y, pair.phase);  // counted from x
  const std::complex<double> motion = x + geometry.base_in_x * base;
  Pair other = pair;
  if (geometry.base_in_x != 0.0) {
    other.x = std::abs(motion);
    const double lag = std::arg(base / motion);
    other.phase = lag < 0.0 ? lag + core::two_pi : lag;
    other.fundamental = other.mean_square_speed = unknown;
  }
  const double r = pair.omega / constants.natural_frequency();
  if (geometry.rides_on_base) other.Y = r * r * pair.Y;
  return other;
}

History converted(const History& history, const Geometry& geometry, const KnownConstants& constants) {
  History other = history;
  other.v.clear();  // of which of the two motions they are is not known
  other.a.clear();
  for (std::size_t i = 0; i < other.x.size(); ++i) other.x[i] += geometry.base_in_x * history.y[i];
  if (!geometry.rides_on_base) return other;
  const ZeroPhaseFilter smooth(cutoffs_for(other, {}).front(), history.sample_rate);
  other.force = sharp_second_difference(smooth(history.y), history.sample_rate);
  for (double& force : other.force) force *= -constants.mass;
  other.y.clear();
  return other;
}

bool have_base(const std::vector<History>& histories) {
  return std::ranges::all_of(histories, [](const History& history) {
    return !history.x.empty() && !history.y.empty() && history.force.empty() && fault_of(history).empty();
  });
}

bool have_phases(const std::vector<Pair>& pairs) {
  const auto is_complete = [](const Pair& pair) { return !std::isnan(pair.phase) && !std::isnan(pair.omega); };
  return std::ranges::all_of(pairs, is_complete) && std::ranges::any_of(pairs, [&](const Pair& pair) {
           return !is_same_frequency(pair.omega, pairs.front().omega);
         });
}

bool contradicts(const Ledger& ledger) {
  return !ledger.departures.empty() || ledger.misfit || ledger.is_unexplained;
}

}  // namespace

std::vector<OtherGeometry> other_geometries(const Record& record, const KnownConstants& constants) {
  if (!(constants.mass > 0.0 && constants.stiffness > 0.0)) return {};
  const bool of_histories = !record.histories.empty();
  if (of_histories ? !have_base(record.histories) : !(record.pairs && have_phases(record.pairs->pairs))) return {};
  std::vector<OtherGeometry> list;
  for (const Geometry& geometry : geometries) {
    const auto convert = [&](const auto& measured) { return converted(measured, geometry, constants); };
    OtherGeometry other{geometry.words, {}};
    if (of_histories)
      std::ranges::transform(record.histories, std::back_inserter(other.record.histories), convert);
    else
      std::ranges::transform(record.pairs->pairs, std::back_inserter(other.record.pairs.emplace().pairs), convert);
    list.push_back(std::move(other));
  }
  return list;
}

void explain_by_geometry(const Record& record, const KnownConstants& constants,
                         const std::function<Ledger(const Record&)>& test, Ledger& ledger) {
  if ((ledger.joint && !ledger.frees_law) || !contradicts(ledger)) return;
  for (const OtherGeometry& other : other_geometries(record, constants)) {
    const Ledger tested = test(other.record);
    if (!tested.joint || contradicts(tested)) continue;
    constexpr int digits = 3;
    const ParameterSet& value = tested.joint->value;
    ledger.other_geometry = "these data contradict no assumption if " + other.words +
                            ", with zeta = " + core::format_number(value.zeta, digits) +
                            " and F0 = " + core::format_number(value.F0, digits) + " " + constants.unit("N");
    if (!ledger.tests_histories) return;
    for (LedgerEntry& entry : ledger.entries)
      if (entry.standing != Standing::untested)
        entry = {.assumption = entry.assumption, .reason = "nothing departs if " + other.words};
    ledger.departures.clear();
    ledger.misfit.reset();
    ledger.is_unexplained = false;
    return;
  }
}

}  // namespace dualdamp::identify
