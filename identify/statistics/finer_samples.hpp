#pragma once
/// Evenly spaced samples of a smooth signal that are too far apart for a cubic spline.
///
/// A spline makes a sine of n samples in a period smaller by the fraction (2 pi/n)^4/720: 0.09 % at seven samples,
/// 0.001 % at 20. Half way between samples it misses the sine by (2 pi/n)^4/384. A polynomial through the 12
/// nearest samples misses it there by 0.000055 (2 sin(pi/n))^12: 1e-5 at seven samples. So the difference of the
/// two tells the error of the spline, and the polynomials give the values between the samples. The difference to
/// polynomials of eight samples tells whether they converge: they do from five samples in a period on, and neither
/// for noise, nor at jumps.

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace dualdamp::identify {

/// Value of a polynomial through `Nodes` neighbouring samples, at a share of the interval in their middle.
template <std::size_t Nodes>
class MiddlePolynomial {
 public:
  static constexpr std::size_t count = Nodes;
  static constexpr std::size_t before = Nodes / 2 - 1;  ///< samples before the first one of the interval
  static constexpr std::size_t after = Nodes / 2;

  explicit MiddlePolynomial(double share) {
    const double at = static_cast<double>(before) + share;
    for (std::size_t i = 0; i < Nodes; ++i) {
      weights_[i] = 1.0;
      const auto own = static_cast<double>(i);
      for (std::size_t j = 0; j < Nodes; ++j)
        if (j != i) weights_[i] *= (at - static_cast<double>(j)) / (own - static_cast<double>(j));
    }
  }

  /// Of the samples.
  [[nodiscard]] const std::array<double, Nodes>& weights() const { return weights_; }
  /// Between samples `i` and `i` + 1. i >= before, and i + after is a sample.
  [[nodiscard]] double between(const std::vector<double>& samples, std::size_t i) const {
    const double* first = samples.data() + (i - before);
    return std::inner_product(weights_.begin(), weights_.end(), first, 0.0);
  }

 private:
  std::array<double, Nodes> weights_{};
};

/// Of more samples than these, polynomials are not better where samples are noisy or few.
using WidePolynomial = MiddlePolynomial<12>;

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
