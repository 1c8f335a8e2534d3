#pragma once
/// The library of friction laws that any_law fits: the departures of identify/departures/ with the severities that
/// a real rig may have, and the fits of each law to a record.

#include <string>
#include <vector>

#include "identify/methods/any_law/law_profile.hpp"
#include "identify/methods/any_law/reading_model.hpp"

namespace dualdamp::identify {

struct LawIntervalOptions {
  double largest_severity = 0.3;
  bool further = true;              ///< whether a law that fits best there is followed on
  double severity_deviation = 0.1;  ///< of the prior of a severity, about zero
  /// Error of a law like the departure, over the effect of the departure on the readings; a standard deviation.
  double law_error = 0.25;
  /// Departures that stay out of the library.
  std::vector<std::string> without{};
};

struct LibraryLaw {
  const departures::Departure* departure = nullptr;  ///< nullptr: Coulomb + viscous friction
  double largest = 0.0;                              ///< severity up to which it is fitted
  double largest_below = 0.0;   ///< the same for negative severities, negative; zero: of one sign
  double furthest = 0.0;        ///< severity to which it is followed on if it fits best at `largest`
  double furthest_below = 0.0;  ///< the same for negative severities, negative; zero: not followed on
  double deviation = 0.0;       ///< of the prior of its severity

  [[nodiscard]] std::string name() const {
    return std::string(departure == nullptr ? departures::plain_name : departure->name);
  }
};

/// Whether the readings determine the spring, so that it is free under every law.
[[nodiscard]] bool has_free_spring(const ReadingModel& model);

/// Whether a law is another spring or frequency. Where the spring is free, these laws are left out.
[[nodiscard]] bool is_of_spring(const departures::Departure& departure);

/// The laws for readings of this kind, sorted by name, without plain friction. Friction that varies at random along
/// the path and friction that warms are not among them: they have no F0 but that of their history.
[[nodiscard]] std::vector<LibraryLaw> law_library(const ReadingModel& model, const LawIntervalOptions& options);

/// Fits of one law over its severity, negative ones first. A law without steady states has only the fit of severity
/// zero.
struct LawFits {
  LibraryLaw law{};
  std::vector<SeverityFit> fits{};
  bool cut_short = false;  ///< the search ended before all fits were made, or one for a law before it did

  [[nodiscard]] bool solved() const { return law.departure == nullptr || fits.size() > 1; }
  [[nodiscard]] const SeverityFit& best() const;
};

/// Fits of plain friction first, then of the library; computed on all cores.
[[nodiscard]] std::vector<LawFits> fit_library(const ReadingModel& model, const LawIntervalOptions& options,
                                               const PlainFit& plain);

}  // namespace dualdamp::identify
