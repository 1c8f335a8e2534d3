#pragma once
/// Evenly spaced samples of a smooth drive that are too far apart for a cubic spline.
///
/// A spline makes a sine of n samples in a period smaller by the fraction (2 pi/n)^4/720: 0.09 % at seven samples,
/// 0.001 % at 20. Half way between samples it misses the sine by (2 pi/n)^4/384. A polynomial through the 12
/// nearest samples misses it there by 0.000055 (2 sin(pi/n))^12: 1e-5 at seven samples. So the difference of the
/// two tells the error of the spline, and the polynomials give the values between the samples. The difference to
/// polynomials of eight samples tells whether they converge: they do from five samples in a period on, and neither
/// for noise, nor at jumps.

#include <optional>
#include <vector>

namespace dualdamp::identify {

/// Half way between samples: rms of a difference over that of the drive about its mean.
struct SplineError {
  double miss = 0.0;          ///< of the cubic spline and polynomials of 12 samples
  double disagreement = 0.0;  ///< of polynomials of 8 and of 12 samples

  /// The samples show the drive between them: polynomials of more samples miss it by less.
  [[nodiscard]] bool is_resolved() const { return disagreement < 0.5 * miss; }
};

/// 0 for fewer than 24 samples and for a constant drive. Cost: linear.
[[nodiscard]] SplineError spline_error(const std::vector<double>& samples);

struct FinerSamples {
  int factor = 1;  ///< samples in place of one
  std::vector<double> values;
};

/// Two or four times as many samples, if the samples show the drive between them and their spline misses it by more
/// than 4e-6 (32 samples in a period of a sine). Beside the ends, the values are those of the spline. Cost: linear.
[[nodiscard]] std::optional<FinerSamples> finer_samples(const std::vector<double>& samples);

}  // namespace dualdamp::identify
