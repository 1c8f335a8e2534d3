#pragma once
/// The histories of a record that a method can use, and how it filters them. Others are left out with the reason.

#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

/// Mean frequency of a motion [Hz]: that of a sine with the same rms of x and v; 0 if x is constant. The
/// differences use long steps, because noise dominates short ones.
[[nodiscard]] double mean_frequency(const History& history);

/// Cut-offs to use [Hz]: those of the options; else, if velocity and acceleration were measured, the single cut-off
/// 0 (no filter); else f, 0.6 f and 0.4 f. f is a twentieth of the sample rate or eight times the mean frequency of
/// the motion, whichever is larger, but at most a fifth of the sample rate.
[[nodiscard]] std::vector<double> cutoffs_for(const History& history, const FilterOptions& options);

/// Why a history cannot be used: no x, signals of different lengths or not finite, no sample rate. Empty: no fault.
[[nodiscard]] std::string fault_of(const History& history);

/// Why a method that takes a motion without a measured drive for free cannot use a history; empty: no fault.
[[nodiscard]] std::string fault_of_drive(const History& history);

/// Why a history cannot be filtered with this cut-off. Empty: no fault.
[[nodiscard]] std::string fault_of_cutoff(const History& history, double cutoff);

/// The histories that can be used with these options, numbered from 1. Others are added to the exclusions of the
/// estimate. If there is none, the estimate is refused.
struct NumberedHistory {
  int number = 0;
  const History* history = nullptr;
};
/// A drive that was not measured: none is there, or noise that a method of random responses takes for unknown.
enum class UnmeasuredDrive { none, noise };
[[nodiscard]] std::vector<NumberedHistory> usable_histories(const Record& record, const FilterOptions& options,
                                                            Estimate& estimate,
                                                            UnmeasuredDrive drive = UnmeasuredDrive::none);

/// The longest usable history, for methods that use a single history and need mass and stiffness. Others are added
/// to the exclusions. Nothing: the estimate is refused.
[[nodiscard]] std::optional<NumberedHistory> longest_history(const Record& record, const KnownConstants& constants,
                                                             Estimate& estimate,
                                                             UnmeasuredDrive drive = UnmeasuredDrive::none);

/// m/s
[[nodiscard]] double largest_speed(const PreparedHistory& motion);

/// Least speed of the samples in a regression [m/s]: the option, or a share of the largest speed of the record. The
/// sign of a slower sample is that of its noise.
[[nodiscard]] double least_speed_for(double largest_speed, double share, const RegressionOptions& options);

/// `lacks` of the methods that need histories: "the record holds no time histories", or empty.
[[nodiscard]] std::string lacks_histories(const Record& record);

}  // namespace dualdamp::identify
