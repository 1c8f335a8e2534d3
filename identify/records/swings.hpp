#pragma once
/// Size, number and frequency of the swings of samples about their mean, from where they cross it.
///
/// A crossing counts once the samples are a tenth of the largest swing beyond the mean, so that noise makes none.
/// This serves any motion, for the size of a scale: a record of few swings gives the frequency to half a swing.
/// `guess_frequency` (`sine_fit.hpp`) interpolates the crossings, for the start of the fit of a sine; it needs
/// three crossings from below, and has no value without. `cutoffs_for` (`signals.hpp`) needs the mean frequency of
/// a motion with many harmonics, in which the fast ones count: it is that of a sine with the same rms of x and v.
///
/// And what swings between the extremes of a motion without a measured drive say of one: whether they shrink, where
/// the largest ones begin, and how many are equal before they shrink.
///
/// Cost: two passes over the samples.

#include <cstddef>
#include <span>
#include <vector>

namespace dualdamp::identify {

/// Largest distance of a value from the mean.
[[nodiscard]] double largest_swing(const std::vector<double>& values);

/// Number of swings about the mean: half that of the crossings, and at least one half.
[[nodiscard]] double swings_of(const std::vector<double>& values);

/// Angular frequency of samples over a duration [s], from the crossings of their mean [rad/s].
[[nodiscard]] double crossing_frequency(const std::vector<double>& samples, double duration);

/// Whether a line through the swings between extremes falls, beyond the errors of the extremes and the scatter
/// about the line; true of fewer than eight swings. Those of a motion that something drives need not.
[[nodiscard]] bool swings_shrink(std::span<const double> extremes, std::span<const double> standard_errors);

/// The extreme, from `first` > 0 on, at which the first swing ends that the largest one does not exceed by more
/// than the errors of both (four deviations).
[[nodiscard]] std::size_t first_of_largest(std::span<const double> extremes,
                                           std::span<const double> standard_errors, std::size_t first);

/// Number of swings at the beginning that are equal, where those behind them shrink: a drive was taken away. A free
/// vibration shrinks from its beginning on. At least six swings, equal within 1 % or their errors, before six that
/// shrink more than eight times as fast, and two more, in which the drive may end; else 0.
[[nodiscard]] std::size_t steady_swings(std::span<const double> extremes, std::span<const double> standard_errors);

}  // namespace dualdamp::identify
