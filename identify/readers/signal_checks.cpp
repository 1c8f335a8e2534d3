#include "identify/readers/signal_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t fewest_at_end = 3;
constexpr double least_height = 0.01;
constexpr double resolutions = 3.0;

/// The smallest step between two samples, as an estimate of the resolution.
double resolution_of(std::span<const double> signal, double range) {
  double smallest = range;
  for (std::size_t i = 1; i < signal.size(); ++i)
    if (const double step = std::abs(signal[i] - signal[i - 1]); step > 0.0) smallest = std::min(smallest, step);
  return smallest;
}

Clipping clipping_at(std::span<const double> signal, double value, double range) {
  const double least = std::max(least_height * range, resolutions * resolution_of(signal, range));
  Clipping found;
  for (std::size_t i = 1; i < signal.size();) {
    std::size_t end = i;
    while (end < signal.size() && signal[end] == value) ++end;
    const std::size_t length = end - i;
    if (length >= fewest_at_end && end < signal.size()) {
      // A parabola that enters with this slope and leaves after this length is higher by slope length/4. The slope
      // is taken over half the length, in which a rounded top falls by at most three steps of the resolution.
      const std::size_t reach = std::max<std::size_t>(length / 2, 1);
      const double before = std::abs(value - signal[i > reach ? i - reach : 0]);
      const double after = std::abs(value - signal[std::min(end + reach - 1, signal.size() - 1)]);
      const double slope = std::min(before, after) / static_cast<double>(reach);
      if (0.25 * slope * static_cast<double>(length) > least) {
        if (found.places == 0) found.first = i;
        ++found.places;
        found.samples += length;
        found.value = value;
      }
    }
    i = end + 1;
  }
  return found;
}

/// The height that a signal would still gain beyond the place where it reaches a plateau of `length` samples.
/// `depths`: how far the samples before the plateau are below it, from the nearest on. A parabola through them
/// gives the slope v at the plateau and the curvature c: v^2/(2 c), and v length/4 if it leaves as it came.
double lost_height(const std::vector<double>& depths, std::size_t length) {
  if (depths.size() < 3) return 0.0;
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(depths.size()), 3);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const auto d = static_cast<double>(i + 1);
    columns.row(i) << 1.0, d, d * d;
  }
  const Eigen::VectorXd found =
      pivoted_least_squares(columns, Eigen::Map<const Eigen::VectorXd>(depths.data(), columns.rows()));
  const double slope = found[1];
  const double curvature = 2.0 * found[2];
  if (!(slope > 0.0)) return 0.0;
  const double height = 0.25 * slope * static_cast<double>(length);
  return curvature > 0.0 ? std::min(height, 0.5 * slope * slope / curvature) : height;
}

/// Plateaus at the largest value of `sign` times a signal, within a band of its noise.
class NoisyTop {
 public:
  NoisyTop(std::span<const double> signal, double sign, double range, double band)
      : signal_(signal), sign_(sign), range_(range), band_(band) {
    for (const double value : signal) top_ = std::max(top_, sign * value);
  }

  [[nodiscard]] Clipping clipping() const {
    Clipping found;
    const std::size_t count = signal_.size();
    for (std::size_t i = 0; i < count;) {
      std::size_t end = i;
      while (end < count && depth(end) <= 0.5 * band_) ++end;
      const std::size_t length = end - i;
      if (length >= fewest && length < count && height(i, end) > least_height * range_ + bands * band_) {
        if (found.places == 0) found.first = i;
        ++found.places;
        found.samples += length;
        found.value = sign_ * (top_ - 0.5 * band_);
      }
      i = end + 1;
    }
    return found;
  }

 private:
  /// Below the middle of the band.
  [[nodiscard]] double depth(std::size_t i) const { return top_ - 0.5 * band_ - sign_ * signal_[i]; }

  /// The smaller one of both sides. A record may begin or end on a plateau.
  [[nodiscard]] double height(std::size_t first, std::size_t end) const {
    double least = range_;
    if (first > 0) least = std::min(least, lost_height(depths(first, false, end - first), end - first));
    if (end < signal_.size()) least = std::min(least, lost_height(depths(end - 1, true, end - first), end - first));
    return least;
  }

  /// From the plateau as far as it is long and a quarter of the range deep, at least three samples.
  [[nodiscard]] std::vector<double> depths(std::size_t from, bool forwards, std::size_t length) const {
    constexpr double deepest = 0.25;
    std::vector<double> list;
    for (std::size_t d = 1; forwards ? from + d < signal_.size() : d <= from; ++d) {
      list.push_back(depth(forwards ? from + d : from - d));
      const bool is_far = list.back() > deepest * range_ || list.size() >= length;
      if (list.size() >= 3 && is_far) break;
    }
    return list;
  }

  static constexpr std::size_t fewest = 4;
  static constexpr double bands = 3.0;
  std::span<const double> signal_;
  double sign_;
  double range_;
  double band_;
  double top_ = -std::numeric_limits<double>::infinity();
};

/// Both ends of the range together.
Clipping both(const Clipping& top, const Clipping& bottom) {
  Clipping all = top.places > 0 ? top : bottom;
  if (top.places > 0 && bottom.places > 0) all.first = std::min(top.first, bottom.first);
  all.samples = top.samples + bottom.samples;
  all.places = top.places + bottom.places;
  return all;
}

}  // namespace

Clipping clipping_of(std::span<const double> signal) {
  if (signal.empty()) return {};
  const auto [low, high] = std::ranges::minmax(signal);
  const Clipping top = clipping_at(signal, high, high - low);
  const Clipping bottom = clipping_at(signal, low, high - low);
  return top.places + bottom.places < 2 ? Clipping{} : both(top, bottom);
}

Clipping noisy_clipping_of(std::span<const double> signal) {
  constexpr std::size_t fewest_samples = 64;
  if (signal.size() < fewest_samples) return {};
  const auto [low, high] = std::ranges::minmax(signal);
  RobustNoiseLevel noise;
  noise.add({signal.begin(), signal.end()});
  constexpr double deviations = 8.0;
  constexpr double steps = 2.0;
  constexpr double widest = 0.015;
  const double range = high - low;
  const double band = std::max(deviations * noise.deviation(), steps * resolution_of(signal, range));
  if (!(band <= widest * range)) return {};
  return both(NoisyTop(signal, 1.0, range, band).clipping(), NoisyTop(signal, -1.0, range, band).clipping());
}

bool is_constant(std::span<const double> signal) {
  return std::ranges::adjacent_find(signal, std::ranges::not_equal_to{}) == signal.end();
}

}  // namespace dualdamp::identify
