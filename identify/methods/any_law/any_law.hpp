#pragma once
/// zeta and F0 when the friction law is unknown: ranges over all laws that the record allows.
///
/// Steady states, with or without phases, or the extremes of a free vibration are fitted under every law of the
/// library, each over its severity (law_intervals.hpp). The 95 % interval of the estimate is the hull; its value is
/// the mean of the average over laws, moved into the hull if it lies outside. Assumptions: friction is one law of
/// the library, or acts on the readings like one, with a severity below `largest_severity` if that is stated; the
/// sensors are right; the constants lie within the priors of docs/methods/any_law.md. Uncertainty: estimated from
/// what a smooth curve leaves of the residuals, or from `sigma_x` and `sigma_Y`. Errors: `outcome`. Cost: seconds.

#include <string>
#include <vector>

#include "identify/method.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/library.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify {

inline constexpr Option largest_severity_option{
    .name = "largest_severity",
    .kind = OptionKind::number,
    .unit = "1",
    .range = {.low = 0.0, .high = 1.0, .low_open = true},
    .otherwise = "0.3, or more if a law fits best there",
    .meaning = "largest severity to which any_law follows each law; it bounds the departure from Coulomb's law"};
inline constexpr Option severity_deviation_option{
    .name = "severity_deviation",
    .kind = OptionKind::number,
    .unit = "1",
    .range = {.low = 0.0, .high = 1.0, .low_open = true},
    .otherwise = "0.1",
    .meaning = "standard deviation of the prior of the severity in any_law's average over laws"};

inline constexpr Option law_error_option{
    .name = "law_error",
    .kind = OptionKind::number,
    .unit = "1",
    .range = {.low = 0.0, .high = 1.0},
    .otherwise = "0.25",
    .meaning =
        "error of a law of any_law for a departure similar to it, as a share of the departure's effect on the "
        "readings"};

/// Names of the laws that the library can hold.
[[nodiscard]] std::vector<std::string> library_names();

inline constexpr Option without_option{.name = "without",
                                       .kind = OptionKind::names,
                                       .most_items = 64,
                                       .otherwise = "all laws",
                                       .meaning = "laws that are left out of the library of any_law",
                                       .words = library_names};

struct AnyLawOptions : KnownDeviations {
  double largest_severity = unknown;  ///< unknown: as `otherwise` says
  double severity_deviation = 0.1;
  double law_error = 0.25;
  std::vector<std::string> without{};

  static constexpr auto declared() {
    return std::tuple_cat(KnownDeviations::declared(),
                          std::tuple{Use{&largest_severity_option, &AnyLawOptions::largest_severity},
                                     Use{&severity_deviation_option, &AnyLawOptions::severity_deviation},
                                     Use{&law_error_option, &AnyLawOptions::law_error},
                                     Use{&without_option, &AnyLawOptions::without}});
  }
};

/// The options of the library and of its intervals.
[[nodiscard]] LawIntervalOptions interval_options(const AnyLawOptions& options);

/// What limits these intervals: a noise that was raised, laws without a motion, laws at the end of their
/// severities.
[[nodiscard]] std::vector<std::string> warnings_about(const LawIntervals& laws, const AnyLawOptions& options);

[[nodiscard]] Estimate any_law(const Record& record, const KnownConstants& constants,
                               const AnyLawOptions& options = {});

/// Standard deviations of zeta, c, x_f and F0 by uncertain constants: `std` of the result. They are those of
/// Coulomb and viscous friction, fitted to the same readings in milliseconds where any_law takes seconds.
/// `warnings` name the constants whose uncertainty is not contained.
[[nodiscard]] Estimate moved_by_constants(const Record& record, const KnownConstants& constants,
                                          const ConstantUncertainties& uncertainties,
                                          const AnyLawOptions& options = {});

/// Adds the standard deviations `by` such causes to the ranges.
void widen(const ParameterSet& by, LawIntervals& laws);
void widen(const ParameterSet& by, Estimate& estimate);

extern const MethodEntry any_law_method;

}  // namespace dualdamp::identify
