#include <Eigen/QR>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/validate.hpp"

namespace dualdamp::identify {

namespace {

/// A turning point of the samples, before the fit.
struct Turn {
  std::size_t index = 0;
  bool at_rest = false;  ///< the mass is held or stays there
};

/// Alternating extremes that are farther apart than `band`. The signal has not yet turned back from the last one.
std::vector<std::size_t> zigzag(std::span<const double> x, double band) {
  std::vector<std::size_t> turns;
  std::size_t low = 0;
  std::size_t high = 0;
  int direction = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[high]) high = i;
    if (x[i] < x[low]) low = i;
    if (direction >= 0 && x[i] < x[high] - band) {
      turns.push_back(high);
      direction = -1;
      low = i;
    } else if (direction <= 0 && x[i] > x[low] + band) {
      turns.push_back(low);
      direction = 1;
      high = i;
    }
  }
  turns.push_back(direction > 0 ? high : low);
  return turns;
}

struct LocalFit {
  double value = 0.0;
  double std = 0.0;
  double sum_of_squares = 0.0;
  double slope = 0.0;
};

/// Least squares on samples [first, last) over u = (i - centre)/width. `fill(u, row)` writes the columns; the first
/// column must be 1.
template <typename Fill>
LocalFit local_fit(std::span<const double> x, std::size_t first, std::size_t last, double centre, double width,
                   Eigen::Index columns, Fill fill) {
  const auto n = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXd design(n, columns);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t sample = first + static_cast<std::size_t>(i);
    fill((static_cast<double>(sample) - centre) / width, design.row(i));
    values(i) = x[sample];
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::VectorXd solution = qr.solve(values);
  LocalFit fit;
  fit.value = solution(0);
  fit.slope = solution(1);
  fit.sum_of_squares = (values - design * solution).squaredNorm();
  const Eigen::MatrixXd R = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  // The first row of the inverse of R gives the variance of the first coefficient.
  const Eigen::VectorXd row = R.transpose().triangularView<Eigen::Lower>().solve(Eigen::VectorXd::Unit(columns, 0));
  const double variance = fit.sum_of_squares / static_cast<double>(std::max<Eigen::Index>(n - columns - 1, 1));
  fit.std = std::sqrt(variance) * row.norm();
  return fit;
}

class DecayReader {
 public:
  explicit DecayReader(const History& history) : history_(history), x_(history.x) {}

  DerivedDecay run() {
    DerivedDecay result;
    result.last = x_.size();
    constexpr std::size_t fewest = 16;
    if (x_.size() < fewest || !shape_fault(history_).empty()) return result;
    const auto [low, high] = std::minmax_element(x_.begin(), x_.end());
    constexpr double noises = 8.0;
    constexpr double rounding = 1e-9;
    // While the mass sticks, the reading of a converter hardly changes, and the noise over all samples is below its
    // step.
    constexpr double steps = 2.5;
    constexpr std::size_t fewest_levels = 6;
    band_ = std::max({noises * noise_level(x_, 2), steps * converter_step(history_.x, fewest_levels),
                      rounding * (*high - *low)});
    const std::vector<std::size_t> turns = zigzag(x_, band_);
    if (turns.size() < 3) return result;
    // The median of the swings between two turning points, whose ends are known best.
    std::vector<double> swings;
    for (std::size_t i = 2; i + 1 < turns.size(); ++i)
      swings.push_back(static_cast<double>(turns[i] - turns[i - 1]));
    const std::size_t begin = is_held(turns[0]) ? held_until() : turns[0];
    if (swings.empty()) swings.push_back(static_cast<double>(turns[1]) - static_cast<double>(begin));
    half_period_ = upper_median(std::move(swings));
    width_ = half_period_ / 4.0;
    constexpr double fewest_in_width = 8.0;
    if (width_ < fewest_in_width) return result;

    add_first(result, turns.front());
    for (std::size_t i = 0; i + 1 < turns.size(); ++i)
      if (turns[i] > 0 && !is_held(turns[i])) add(result, turns[i]);
    add_last(result, turns.back());
    if (!keep_decay(result)) return {};
    return result;
  }

 private:
  void put(DerivedDecay& result, double index, double value, double std) const {
    result.record.times.push_back(history_.start + index / history_.sample_rate);
    result.record.extremes.push_back(value);
    result.standard_errors.push_back(std);
  }

  void put_mean(DerivedDecay& result, std::size_t first, std::size_t last, std::size_t index) const {
    const auto n = static_cast<double>(last - first);
    const double mean = std::reduce(x_.begin() + static_cast<std::ptrdiff_t>(first),
                                    x_.begin() + static_cast<std::ptrdiff_t>(last)) /
                        n;
    double square = 0.0;
    for (std::size_t i = first; i < last; ++i) square += (x_[i] - mean) * (x_[i] - mean);
    put(result, static_cast<double>(index), mean, std::sqrt(square / n / std::max(n - 1.0, 1.0)));
  }

  /// Number of samples at the beginning that are equal to the first one within the noise: the mass is held.
  [[nodiscard]] std::size_t held_until() const {
    std::size_t i = 0;
    while (i < x_.size() && std::abs(x_[i] - x_[0]) < band_) ++i;
    return i;
  }

  /// Whether a turning point is noise while the mass is held.
  [[nodiscard]] bool is_held(std::size_t turn) const { return turn < held_until(); }

  /// Adds the position of release: where the mass is held, or the first sample if the velocity is zero there.
  void add_first(DerivedDecay& result, std::size_t first_turn) const {
    const std::size_t held = held_until();
    if (static_cast<double>(held) > 2.0 * width_) {
      put_mean(result, 0, held, held - 1);
      result.first = held;
      return;
    }
    if (static_cast<double>(first_turn) < 2.0 * width_ && first_turn > held) return;  // added as a turning point
    const auto last = static_cast<std::size_t>(width_) + 1;
    if (last < 2 * std::size_t{start_columns} || x_.size() < 2 * last) return;
    const LocalFit fit = local_fit(x_, 0, last, 0.0, width_, start_columns, [](double u, auto row) {
      for (Eigen::Index k = 0; k < row.size(); ++k) row(k) = std::pow(u, static_cast<double>(k));
    });
    // A slope of 1 % of the largest one changes the amplitude by 5e-5.
    constexpr double least_slope = 0.01;
    const double swing = std::abs(x_[static_cast<std::size_t>(half_period_)] - x_[0]);
    if (std::abs(fit.slope) < least_slope * 0.5 * swing * std::numbers::pi / 4.0)
      put(result, 0.0, fit.value, fit.std);
  }

  /// Adds the value of the fit where its slope is zero. The powers 2, 3 and 4 have a coefficient on each side.
  void add(DerivedDecay& result, std::size_t turn) const {
    const auto reach = static_cast<std::size_t>(width_);
    const std::size_t first = turn > reach ? turn - reach : 0;
    const std::size_t last = std::min(turn + reach + 1, x_.size());
    if (last - first < 2 * std::size_t{turn_columns}) return;
    const auto at = [&](double centre) {
      return local_fit(x_, first, last, centre, width_, turn_columns, [](double u, auto row) {
        const Eigen::Index side = u < 0.0 ? 0 : 1;
        row.setZero();
        row(0) = 1.0;
        for (Eigen::Index k = 0; k < 3; ++k) row(1 + 2 * k + side) = std::pow(u, static_cast<double>(k + 2));
      });
    };
    const auto middle = static_cast<double>(turn);
    constexpr int bits = 26;
    const double centre = boost::math::tools::brent_find_minima([&](double c) { return at(c).sum_of_squares; },
                                                                middle - 0.3 * width_, middle + 0.3 * width_, bits)
                              .first;
    const LocalFit fit = at(centre);
    put(result, centre, fit.value, fit.std);
  }

  /// Adds the position in which the mass sticks to the end of the record.
  void add_last(DerivedDecay& result, std::size_t turn) const {
    std::size_t first = x_.size();
    while (first > 0 && std::abs(x_[first - 1] - x_.back()) < band_) --first;
    const bool rests = static_cast<double>(x_.size() - first) > half_period_;
    if (!rests || first == 0 || turn + 1 < first) return;
    put_mean(result, first, x_.size(), first);
    // A hundred samples at one position would repeat the error of the sensor there a hundred times.
    result.last = std::min(x_.size(), first + 2 * static_cast<std::size_t>(half_period_));
    // The noise hides the moment of the stop, which is half a period after the last turning point.
    std::vector<double>& times = result.record.times;
    if (times.size() < 3) return;
    const std::size_t turned = times.size() - 2;
    const std::size_t from = turned > 1 ? 1 : 0;  // the noise hides the moment of release as well
    times.back() = times[turned] + (times[turned] - times[from]) / static_cast<double>(turned - from);
  }

  /// The swings of a free decay shrink. They may grow before the release, while a blow pushes the mass, and in the
  /// noise at the end; these parts are cut off. False if the growth has another cause.
  bool keep_decay(DerivedDecay& result) const {
    const std::vector<double>& extremes = result.record.extremes;
    if (extremes.size() < 3) return false;
    const auto swing = [&extremes](std::size_t i) { return std::abs(extremes[i] - extremes[i - 1]); };
    std::size_t largest = 1;
    for (std::size_t i = 2; i < extremes.size(); ++i)
      if (swing(i) > swing(largest)) largest = i;
    std::size_t end = largest + 1;
    while (end < extremes.size() && swing(end) < swing(end - 1)) ++end;
    const bool grows = end < extremes.size();
    // The cause of the growth may have acted already in the swings before; these last too long.
    constexpr double too_long = 1.4;
    while (grows && end > largest + 1 && lasting(result, end - 1) > too_long * half_period_) --end;
    // Largest share of the swings that may be left where they grow again. Above it, there is another release or a
    // drive.
    constexpr double most_left = 0.25;
    if (grows && swing(end) > most_left * swing(largest)) return false;
    // A blow may last to the begin of the largest swing. It is over at the end of this swing.
    constexpr std::size_t longest_start = 3;
    const std::size_t begin = largest > 1 ? largest : 0;
    if (end < begin + 3 || begin > longest_start + 1) return false;
    if (grows) {
      result.warnings.push_back(
          "the swings of the free vibration grow again at t = " + core::format_number(result.record.times[end], 4) +
          " s, where " + core::format_number(100.0 * swing(end - 1) / swing(largest), 2) +
          " % of the largest is left: the extremes before are used");
      result.last = sample_of(result, end - 1) + 1;
    }
    if (begin > 0) {
      result.warnings.push_back("the free vibration is taken from the end of its largest swing on, t = " +
                                core::format_number(result.record.times[begin], 4) + " s");
      result.first = sample_of(result, begin);
    }
    cut(result, begin, end);
    return true;
  }

  [[nodiscard]] std::size_t sample_of(const DerivedDecay& result, std::size_t extreme) const {
    return static_cast<std::size_t>((result.record.times[extreme] - history_.start) * history_.sample_rate);
  }

  /// Number of samples from the previous extreme to this one.
  [[nodiscard]] double lasting(const DerivedDecay& result, std::size_t extreme) const {
    return (result.record.times[extreme] - result.record.times[extreme - 1]) * history_.sample_rate;
  }

  static void cut(DerivedDecay& result, std::size_t first, std::size_t last) {
    for (std::vector<double>* list : {&result.record.extremes, &result.record.times, &result.standard_errors}) {
      list->erase(list->begin() + static_cast<std::ptrdiff_t>(last), list->end());
      list->erase(list->begin(), list->begin() + static_cast<std::ptrdiff_t>(first));
    }
  }

  static constexpr Eigen::Index start_columns = 5;
  static constexpr Eigen::Index turn_columns = 7;

  const History& history_;
  std::span<const double> x_;
  double band_ = 0.0;         ///< differences below it are noise [m]
  double half_period_ = 0.0;  ///< in samples
  double width_ = 0.0;        ///< half the number of samples of a local fit
};

}  // namespace

DerivedDecay decay_of(const History& history) { return DecayReader(history).run(); }

}  // namespace dualdamp::identify
