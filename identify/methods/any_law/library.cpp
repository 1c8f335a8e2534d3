#include "identify/methods/any_law/library.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

#include "identify/departures/groups.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

/// Positive severity: a film takes half of the viscous force and thins with speed. Negative severity: a drag with
/// the square of speed beside the damper. c is that of low speeds, as under `viscous_saturating`. To the first
/// order in the severity both give c v (1 - s |v|/V).
sim::Model film_beside_damper(const departures::RigBase& base, departures::DepartureValues p) {
  sim::Model model = departures::with_coulomb(base);
  const double V = base.reference.speed();
  if (p[0] < 0.0)
    return departures::with_law(std::move(model), "viscous_power",
                                {{"coefficient", -p[0] * base.c() / V}, {"exponent", 2.0}});
  constexpr double share = 0.5;
  model.oscillator.damping *= 1.0 - share;
  return departures::with_law(std::move(model), "viscous_saturating",
                              {{"coefficient", share * base.c()}, {"saturation_velocity", share * V / p[0]}});
}

/// Half of the friction acts directly, the other half behind free play.
sim::Model partial_play(const departures::RigBase& base, departures::DepartureValues p) {
  constexpr double share = 0.5;
  departures::RigBase rigid = base;
  rigid.F0 *= 1.0 - share;
  return departures::with_law(departures::with_coulomb(rigid), "free_play",
                              {{"kinetic", share * base.F0}, {"play", p[0]}});
}

/// Friction falls from F0 (1 + s) at rest to F0 at the peak speed, and further beyond.
sim::Model wide_stribeck(const departures::RigBase& base, departures::DepartureValues p) {
  const double fallen = 1.0 - std::exp(-1.0);
  return departures::with_law(base.model, "stribeck",
                              {{"kinetic", (1.0 + p[0] - p[0] / fallen) * base.F0},
                               {"static", (1.0 + p[0]) * base.F0},
                               {"stribeck_velocity", base.reference.speed()}});
}

/// Laws of the library that are not in the stress test.
const std::vector<departures::Departure>& further_laws() {
  static const std::vector<departures::Departure> list = {
      {.name = "film_beside_damper",
       .meaning = "a film that thins under shear, or a drag, beside the damper",
       .parameters = {},
       .build = film_beside_damper,
       .severity = "fall of the viscous force at the peak speed, of the first order",
       .largest = 10.0,
       .values_at = [](const departures::RigBase&, double s) { return std::vector{s}; },
       .family = departures::Family::velocity,
       .largest_below = 10.0},
      {.name = "partial_play",
       .meaning = "half of the friction lies behind free play",
       .parameters = {},
       .build = partial_play,
       .severity = "half of the free play over the amplitude X",
       .largest = 0.5,
       .values_at = [](const departures::RigBase& base,
                       double s) { return std::vector{2.0 * s * base.reference.amplitude}; },
       .family = departures::Family::presliding},
      {.name = "wide_stribeck",
       .meaning = "friction falls over the whole range of speeds",
       .parameters = {},
       .build = wide_stribeck,
       .severity = "excess of friction at rest over F0, that of the peak speed",
       .largest = 1.0,
       .values_at = [](const departures::RigBase&, double s) { return std::vector{s}; },
       .family = departures::Family::velocity}};
  return list;
}

/// All laws that the library can hold, sorted by name. Errors of the laboratory (`mislead`) are not laws.
const std::vector<departures::Departure>& all_laws() {
  static const std::vector<departures::Departure> list = [] {
    std::vector<departures::Departure> all = departures::departures();
    all.insert(all.end(), further_laws().begin(), further_laws().end());
    [[maybe_unused]] const auto has_twin = [&](const departures::Departure& departure) {
      const auto twin = std::ranges::find(all, departure.twin_of, &departures::Departure::name);
      return departure.twin_of.empty() || (twin != all.end() && twin->largest_below == departure.largest);
    };
    assert(std::ranges::all_of(all, has_twin));
    std::erase_if(all, [](const departures::Departure& departure) {
      return departure.outside_library || !departure.twin_of.empty() || departure.mislead != nullptr;
    });
    std::ranges::sort(all, {}, &departures::Departure::name);
    return all;
  }();
  return list;
}

LawFits fits_of(const ReadingModel& model, const LibraryLaw& law, const PlainFit& plain) {
  LawProfile positive = law_profile(model, *law.departure, law.largest, plain.noise, plain.fit, law.furthest);
  LawFits all{law, std::move(positive.fits), positive.cut_short};
  if (law.largest_below == 0.0) return all;
  LawProfile below =
      law_profile(model, *law.departure, law.largest_below, plain.noise, plain.fit, law.furthest_below);
  std::vector<SeverityFit>& negative = below.fits;
  std::ranges::reverse(negative);
  negative.pop_back();
  all.fits.insert(all.fits.begin(), negative.begin(), negative.end());
  all.cut_short = all.cut_short || below.cut_short;
  return all;
}

}  // namespace

std::vector<std::string> library_names() {
  std::vector<std::string> list;
  for (const departures::Departure& departure : all_laws()) list.emplace_back(departure.name);
  return list;
}

bool has_free_spring(const ReadingModel& model) {
  return std::ranges::find(model.nuisances(), "stiffness", &Nuisance::name) != model.nuisances().end();
}

bool is_of_spring(const departures::Departure& departure) { return departure.spring_limit > 0.0; }

std::vector<LibraryLaw> law_library(const ReadingModel& model, const LawIntervalOptions& options) {
  std::vector<LibraryLaw> laws;
  for (const departures::Departure& departure : all_laws()) {
    if (std::ranges::find(options.without, departure.name) != options.without.end()) continue;
    if (departure.forced_only && !model.is_driven()) continue;
    LibraryLaw law{.departure = &departure,
                   .largest = std::min(options.largest_severity, departure.largest),
                   .deviation = options.severity_deviation};
    const bool of_spring = is_of_spring(departure);
    // If the readings determine spring and frequency, these are free under every law instead.
    if (of_spring && !model.nuisances().empty()) continue;
    if (of_spring) {
      law.largest = departure.spring_limit;
      law.deviation = 0.5 * departure.spring_limit;
    }
    const bool two_sided = departure.largest_below > 0.0;
    if (two_sided) law.largest_below = -std::min(law.largest, departure.largest_below);
    // A larger error of spring or frequency is found by the ledger.
    if (options.further && !of_spring) {
      law.furthest = departure.largest;
      if (two_sided) law.furthest_below = -departure.largest_below;
    }
    laws.push_back(law);
  }
  return laws;
}

const SeverityFit& LawFits::best() const { return *std::ranges::min_element(fits, {}, &SeverityFit::chi2); }

std::vector<LawFits> fit_library(const ReadingModel& model, const LawIntervalOptions& options,
                                 const PlainFit& plain) {
  const std::vector<LibraryLaw> laws = law_library(model, options);
  std::vector<LawFits> all(laws.size() + 1);
  all[0].fits = {plain.fit};
  // Where one law is cut short there is no range, and the laws behind it need no fits. The first law that is cut
  // short is fitted whatever the order of the threads.
  std::atomic<std::size_t> cut_short = laws.size();
  sim::in_parts(laws.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      const bool behind = cut_short < i;
      all[i + 1] = behind ? LawFits{laws[i], {plain.fit}, true} : fits_of(model, laws[i], plain);
      std::size_t seen = cut_short;
      while (all[i + 1].cut_short && i < seen && !cut_short.compare_exchange_weak(seen, i)) {
      }
    }
  });
  return all;
}

}  // namespace dualdamp::identify
