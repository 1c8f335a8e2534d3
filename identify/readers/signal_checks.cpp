#include "identify/readers/signal_checks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

constexpr double least_height = 0.01;

/// The smallest step between two samples, as an estimate of the resolution.
double resolution_of(std::span<const double> signal, double range) {
  double smallest = range;
  for (std::size_t i = 1; i < signal.size(); ++i)
    if (const double step = std::abs(signal[i] - signal[i - 1]); step > 0.0) smallest = std::min(smallest, step);
  return smallest;
}

/// The height that a signal would still gain beyond a plateau, and how well the samples beside it tell this.
struct Gain {
  double height = 0.0;
  double error = 0.0;  ///< of one that follows from the slope
  double most = 0.0;   ///< with errors of slope and curvature of two deviations each
};

/// The gain beyond the place where a signal reaches a plateau of `length` samples. `depths`: how far the samples
/// before the plateau are below it, from the nearest on. A parabola through them gives the slope v at the plateau
/// and the curvature c: v^2/(2 c), and v length/4 if it leaves as it came. `noise`: of the depths.
Gain gain_by_parabola(std::span<const double> depths, std::size_t length, double noise) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(depths.size()), 3);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const auto d = static_cast<double>(i + 1);
    columns.row(i) << 1.0, d, d * d;
  }
  const Eigen::VectorXd found =
      pivoted_least_squares(columns, Eigen::Map<const Eigen::VectorXd>(depths.data(), columns.rows()));
  const Eigen::Matrix3d inverse = (columns.transpose() * columns).inverse();
  const double by_slope = 0.25 * static_cast<double>(length);
  const double slope_error = noise * std::sqrt(inverse(1, 1));
  const double curvature_error = 2.0 * noise * std::sqrt(inverse(2, 2));
  const auto height = [by_slope](double slope, double curvature) {
    if (!(slope > 0.0)) return 0.0;
    return curvature > 0.0 ? std::min(by_slope * slope, 0.5 * slope * slope / curvature) : by_slope * slope;
  };
  const double slope = found[1];
  const double curvature = 2.0 * found[2];
  constexpr double deviations = 2.0;
  return {height(slope, curvature), by_slope * slope_error,
          height(slope + deviations * slope_error, curvature - deviations * curvature_error)};
}

/// The least gain by parabolas through all `depths` and through the nearest ones alone, as few as tell it to
/// an eighth of `least` under this noise, or that it is at most `least`. A mass under a fast drive may turn around
/// within the length of a long stick, and no parabola follows that; the last samples before the stick show that it
/// arrives without speed.
double lost_height(const std::vector<double>& depths, std::size_t length, double noise, double least) {
  constexpr double known = 0.125;
  constexpr std::size_t fewest = 3;
  if (depths.size() < fewest) return 0.0;
  double height = gain_by_parabola(depths, length, noise).height;
  for (std::size_t count = fewest; count < depths.size(); count += count / 2) {
    const Gain near = gain_by_parabola(std::span(depths).first(count), length, noise);
    if (near.error <= known * least || near.most <= least) height = std::min(height, near.height);
  }
  return height;
}

/// What counts as a plateau at the end of the range, and as clipped.
struct PlateauRule {
  double band = 0.0;         ///< width of the values that count as equal
  std::size_t fewest = 1;    ///< samples of a plateau
  double least = 0.0;        ///< height that the signal would gain beyond it
  double noise = 0.0;        ///< of the samples
  bool ends_within = false;  ///< the record neither begins nor ends with it
};

/// Plateaus at the largest value of `sign` times a signal. A mass that comes to rest at its turning point is no
/// such plateau: it comes without speed.
class Top {
 public:
  Top(std::span<const double> signal, double sign, double range, const PlateauRule& rule)
      : signal_(signal), sign_(sign), range_(range), rule_(rule) {
    for (const double value : signal) top_ = std::max(top_, sign * value);
  }

  [[nodiscard]] Clipping clipping() const {
    Clipping found;
    const std::size_t count = signal_.size();
    for (std::size_t i = 0; i < count;) {
      std::size_t end = i;
      while (end < count && depth(end) <= 0.5 * rule_.band) ++end;
      const std::size_t length = end - i;
      const bool counts =
          length >= rule_.fewest && length < count && !(rule_.ends_within && (i == 0 || end == count));
      if (counts && height(i, end) > rule_.least) {
        if (found.places == 0) found.first = i;
        ++found.places;
        found.samples += length;
        found.stretches.emplace_back(i, end);
        found.value = sign_ * (top_ - 0.5 * rule_.band);
      }
      i = end + 1;
    }
    return found;
  }

 private:
  /// Below the middle of the band.
  [[nodiscard]] double depth(std::size_t i) const { return top_ - 0.5 * rule_.band - sign_ * signal_[i]; }

  /// The smaller one of both sides. A record may begin or end on a plateau.
  [[nodiscard]] double height(std::size_t first, std::size_t end) const {
    const std::size_t length = end - first;
    const auto beside = [&](std::size_t from, bool forwards) {
      return lost_height(depths(from, forwards, length), length, rule_.noise, rule_.least);
    };
    double least = range_;
    if (first > 0) least = std::min(least, beside(first, false));
    if (end < signal_.size()) least = std::min(least, beside(end - 1, true));
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

  std::span<const double> signal_;
  double sign_;
  double range_;
  PlateauRule rule_;
  double top_ = -core::infinity;
};

/// At both ends of the range.
Clipping both_ends(std::span<const double> signal, double range, const PlateauRule& rule) {
  const Clipping top = Top(signal, 1.0, range, rule).clipping();
  const Clipping bottom = Top(signal, -1.0, range, rule).clipping();
  Clipping all = top.places > 0 ? top : bottom;
  if (top.places > 0 && bottom.places > 0) all.first = std::min(top.first, bottom.first);
  all.samples = top.samples + bottom.samples;
  all.places = top.places + bottom.places;
  all.stretches = top.stretches;
  all.stretches.insert(all.stretches.end(), bottom.stretches.begin(), bottom.stretches.end());
  return all;
}

/// Slope of a line through samples [begin, end) of a signal, per sample.
double slope_of(std::span<const double> signal, std::size_t begin, std::size_t end) {
  const double middle = 0.5 * static_cast<double>(begin + end - 1);
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const double d = static_cast<double>(i) - middle;
    products += d * signal[i];
    squares += d * d;
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/// The speed that a drive reaches or exceeds for a tenth of the time, from lines through `width` samples.
double usual_speed(std::span<const double> drive, std::size_t width) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i + width <= drive.size(); i += width)
    speeds.push_back(std::abs(slope_of(drive, i, i + width)));
  if (speeds.empty()) return 0.0;
  const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(9 * (speeds.size() - 1) / 10);
  std::ranges::nth_element(speeds, at);
  return *at;
}

/// Whether a mass slows down between a corner of its drive and a later plateau: a mass that glides into its stop
/// covers two thirds of the way that it covers without one.
bool slows_down(std::span<const double> x, double sign, std::size_t width, std::size_t corner,
                std::size_t plateau) {
  const double speed = sign * slope_of(x, corner - width, corner);
  if (!(speed > 0.0)) return false;
  if (corner >= plateau) return true;
  constexpr double share = 0.75;
  constexpr double slack = 2.0;
  return sign * (x[plateau] - x[corner]) <= speed * (share * static_cast<double>(plateau - corner) + slack);
}

/// Whether a drive that moves outwards has a corner where a plateau of x begins, and goes no further from there.
bool stops_at(std::span<const double> drive, std::span<const double> x, double sign,
              const std::pair<std::size_t, std::size_t>& plateau) {
  constexpr std::size_t widths = 8;
  constexpr std::size_t narrowest = 4;
  constexpr std::size_t places = 40;
  constexpr std::size_t late = 20;
  const std::size_t begin = plateau.first;
  const std::size_t length = plateau.second - begin;
  const std::size_t width = std::max(narrowest, length / widths);
  const std::size_t last = begin + std::max<std::size_t>(2, length / late);
  const double least = 0.5 * usual_speed(drive, width);
  constexpr double stopped = 0.1;
  for (std::size_t corner = std::max(width, begin - std::min(begin, length));
       corner <= last && corner + width <= drive.size(); corner += std::max<std::size_t>(1, length / places)) {
    const double before = sign * slope_of(drive, corner - width, corner);
    const double after = sign * slope_of(drive, corner, corner + width);
    const bool is_corner = before > 0.0 && before >= least && after <= stopped * before;
    if (is_corner && slows_down(x, sign, width, corner, begin)) return true;
  }
  return false;
}

}  // namespace

Clipping clipping_of(std::span<const double> signal) {
  if (signal.empty()) return {};
  const auto [low, high] = std::ranges::minmax(signal);
  const double range = high - low;
  constexpr double steps = 3.0;
  const double resolution = resolution_of(signal, range);
  constexpr double rounding = 0.29;  // deviation of a rounded value, in steps
  const PlateauRule rule{.fewest = 3,
                         .least = std::max(least_height * range, steps * resolution),
                         .noise = std::max(robust_noise_level(signal), rounding * resolution),
                         .ends_within = true};
  const Clipping all = both_ends(signal, range, rule);
  return all.places < 2 ? Clipping{} : all;
}

Clipping noisy_clipping_of(std::span<const double> signal) {
  constexpr std::size_t fewest_samples = 64;
  if (signal.size() < fewest_samples) return {};
  const auto [low, high] = std::ranges::minmax(signal);
  constexpr double deviations = 8.0;
  constexpr double steps = 2.0;
  constexpr double widest = 0.015;
  constexpr double bands = 3.0;
  const double range = high - low;
  const double band = std::max(deviations * robust_noise_level(signal), steps * resolution_of(signal, range));
  if (!(band <= widest * range)) return {};
  return both_ends(
      signal, range,
      {.band = band, .fewest = 4, .least = least_height * range + bands * band, .noise = band / deviations});
}

bool is_still_at(const Clipping& clipping, std::span<const double> v) {
  std::vector<double> inside;
  std::vector<double> beside;
  for (const auto& [begin, end] : clipping.stretches) {
    const std::size_t length = end - begin;
    for (std::size_t i = begin; i < end; ++i) inside.push_back(std::abs(v[i]));
    for (std::size_t i = begin - std::min(begin, length); i < begin; ++i) beside.push_back(std::abs(v[i]));
    for (std::size_t i = end; i < std::min(v.size(), end + length); ++i) beside.push_back(std::abs(v[i]));
  }
  constexpr double share = 0.1;
  return upper_median(std::move(inside)) < share * upper_median(std::move(beside));
}

Clipping without_sticks(const Clipping& clipping, std::span<const double> x, std::span<const double> drive,
                        std::size_t fewest_places) {
  const auto [low, high] = std::ranges::minmax(x);
  Clipping left{.value = clipping.value};
  for (const auto& stretch : clipping.stretches) {
    const double sign = x[stretch.first] > 0.5 * (low + high) ? 1.0 : -1.0;
    if (stops_at(drive, x, sign, stretch)) continue;
    left.first = left.places == 0 ? stretch.first : std::min(left.first, stretch.first);
    ++left.places;
    left.samples += stretch.second - stretch.first;
    left.stretches.push_back(stretch);
  }
  return left.places < fewest_places ? Clipping{} : left;
}

std::vector<std::size_t> placeholders_in(std::span<const double> signal) {
  constexpr std::size_t fewest = 16;
  constexpr double most = 0.1;
  constexpr double far = 5.0;
  if (signal.size() < fewest) return {};
  const auto [lowest, highest] = std::ranges::minmax(signal);
  double low = highest;
  double high = lowest;
  for (const double value : signal) {
    if (value == lowest || value == highest) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  for (const double value : {lowest, highest}) {
    const double distance = value == lowest ? low - value : value - high;
    if (!(high > low && distance > far * (high - low))) continue;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < signal.size(); ++i)
      if (signal[i] == value) rows.push_back(i);
    if (rows.size() > 1 && static_cast<double>(rows.size()) < most * static_cast<double>(signal.size()))
      return rows;
  }
  return {};
}

bool is_constant(std::span<const double> signal) {
  return std::ranges::adjacent_find(signal, std::ranges::not_equal_to{}) == signal.end();
}

}  // namespace dualdamp::identify
