#pragma once
/// Size, number and frequency of the swings of samples about their mean, from where they cross it.
///
/// A crossing counts once the samples are a tenth of the largest swing beyond the mean, so that noise makes none.
/// This serves any motion, for the size of a scale: a record of few swings gives the frequency to half a swing.
/// `guess_frequency` (`sine_fit.hpp`) interpolates the crossings, for the start of the fit of a sine; it needs
/// three crossings from below, and has no value without. `cutoffs_for` (`signals.hpp`) needs the mean frequency of
/// a motion with many harmonics, in which the fast ones count: it is that of a sine with the same rms of x and v.
///
/// Cost: two passes over the samples.

#include <vector>

namespace dualdamp::identify {

/// Largest distance of a value from the mean.
[[nodiscard]] double largest_swing(const std::vector<double>& values);

/// Number of swings about the mean: half that of the crossings, and at least one half.
[[nodiscard]] double swings_of(const std::vector<double>& values);

/// Angular frequency of samples over a duration [s], from the crossings of their mean [rad/s].
[[nodiscard]] double crossing_frequency(const std::vector<double>& samples, double duration);

}  // namespace dualdamp::identify
