/// The laws that take part in continued records, and the severity at which each is the truth.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "identify/design/continued_record.hpp"
#include "identify/methods/any_law/severity_curve.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

/// The most probable severity: the misfit and the prior of the severity together. A record often says little about
/// the severity, so that its best fit alone is too severe about as often as it is too mild, and by far.
double probable_severity(const ReadingModel& model, const LawFits& fitted) {
  const LibraryLaw& law = fitted.law;
  const std::vector<SeverityPoint> points = severity_curve(model, SeverityScale(law.departure), fitted.fits);
  const double severe = std::abs(best_of(points).severity);
  const double deviation = severe > law.largest ? std::max(law.deviation, severe) : law.deviation;
  return std::ranges::min_element(points, {},
                                  [deviation](const SeverityPoint& point) {
                                    return point.chi2 + std::pow(point.severity / deviation, 2);
                                  })
      ->severity;
}

/// The fits within reach of the best one, and its neighbours: without them a region would end where the fits do.
/// Also the fit of severity zero: plain friction is the same for every law.
std::vector<SeverityFit> within_reach(const LawFits& law) {
  constexpr double reach = 12.0;
  const double most = law.best().chi2 + reach;
  const auto best = std::distance(law.fits.data(), &law.best());
  std::vector<SeverityFit> fits;
  for (std::ptrdiff_t i = 0; i < std::ssize(law.fits); ++i) {
    const SeverityFit& fit = law.fits[static_cast<std::size_t>(i)];
    if (fit.severity == 0.0 || fit.chi2 < most || std::abs(i - best) == 1) fits.push_back(fit);
  }
  return fits;
}

/// Adds the fit at the most probable severity, unless there is one nearby, and notes which it is.
void find_probable(const StudiedRecord& record, Rival& rival) {
  const double severity = probable_severity(record.model, *rival.law);
  const auto apart = [severity](const SeverityFit& fit) { return std::abs(fit.severity - severity); };
  constexpr double same = 0.05;  // of the severity
  auto nearest = std::ranges::min_element(rival.fits, {}, apart);
  if (apart(*nearest) > same * std::abs(severity)) {
    const std::unique_ptr<NearbyOrbits> near = record.model.no_orbits(record.study.plain.noise.deviations);
    std::optional<SeverityFit> fit =
        fit_law(record.model, {rival.law->law.departure, severity}, record.study.plain.noise,
                {.unknowns = nearest->unknowns, .slopes = nearest->slopes}, *near);
    if (fit)
      nearest = rival.fits.insert(std::ranges::lower_bound(rival.fits, severity, {}, &SeverityFit::severity),
                                  *std::move(fit));
  }
  rival.probable = static_cast<std::size_t>(std::distance(rival.fits.begin(), nearest));
}

}  // namespace

std::vector<Rival> rivals_of(const StudiedRecord& record) {
  std::vector<Rival> rivals;
  for (const LawFits& law : record.study.laws) {
    const auto answer = std::ranges::find(record.study.intervals.laws, law.law.name(), &LawAnswer::name);
    const bool plain = law.law.departure == nullptr;
    if (answer->rejected && !plain) continue;
    rivals.push_back({.law = &law, .allowed = !answer->rejected, .fits = within_reach(law)});
  }
  sim::in_parts(rivals.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i)
      if (rivals[i].law->law.departure != nullptr) find_probable(record, rivals[i]);
  });
  return rivals;
}

}  // namespace dualdamp::identify
