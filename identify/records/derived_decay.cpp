#include <Eigen/Core>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/local_fit.hpp"
#include "identify/records/swings.hpp"
#include "identify/records/turning_points.hpp"
#include "identify/statistics/lasting_mean.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/validate.hpp"

namespace dualdamp::identify {

namespace {

class DecayReader {
 public:
  explicit DecayReader(const History& history) : history_(history), x_(history.x) {}

  DerivedDecay run() {
    DerivedDecay result = read();
    result.held = held_until();
    result.half_period = half_period_;
    return result;
  }

 private:
  DerivedDecay read() {
    DerivedDecay result;
    result.last = x_.size();
    constexpr std::size_t fewest = 16;
    result.fault = shape_fault(history_);
    if (result.fault.empty() && x_.size() < fewest)
      result.fault = "x has fewer than " + std::to_string(fewest) + " samples";
    if (!result.fault.empty()) return result;
    std::vector<std::size_t> turns = read_turns(noise_level(x_, 2));
    // If a period has few samples, differences of second order take the motion for noise.
    constexpr double many = 32.0;
    if (half_period_ < many) turns = read_turns(robust_noise_level(history_.x));
    if (const double resting = noise_at_rest(); turns.size() >= 3 && resting > noise_) turns = read_turns(resting);
    if (turns.size() < 3) return refused(no_turns(), range_of(x_) > 2.0 * band_);
    if (half_period_ < fewest_in_half_period) {
      DerivedDecay slow = refused(turns.size() > 3 ? too_slow() : "x turns back once" + duration(), true);
      slow.warnings.push_back("no extremes are read: " + slow.fault);
      return slow;
    }
    leave_out_overshoot(x_, turns, begin_of_rest(x_, band_), half_period_);
    leave_out_rest(turns);
    width_ = std::max(half_period_ / 4.0, narrowest);

    const std::size_t held = held_until();
    bool has_first = false;
    for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
      const bool is_added = turns[i] > 0 && turns[i] >= held && add(result, turns[i]);  // before, it is noise
      has_first = has_first || (is_added && i == 0);
    }
    if (!has_first || static_cast<double>(turns.front()) >= 2.0 * width_) add_first(result, held);
    add_last(result, turns.back());
    const std::string fault = keep_decay(result);
    return fault.empty() ? result : refused(fault, result.is_coarse, result.is_driven);
  }

  static DerivedDecay refused(std::string fault, bool is_coarse = false, bool is_driven = false) {
    DerivedDecay result;
    result.fault = std::move(fault);
    result.is_coarse = is_coarse;
    result.is_driven = is_driven;
    return result;
  }

  /// Sets the band and the half period. Returns the turning points.
  std::vector<std::size_t> read_turns(double noise) {
    noise_ = noise;
    band_ = band_of(noise);
    half_period_ = 0.0;
    std::vector<std::size_t> turns = zigzag(x_, band_);
    if (turns.size() >= 3) turns = without_ripple(x_, turns, half_period_of(turns));
    if (turns.size() >= 3) half_period_ = half_period_of(turns);
    return turns;
  }

  /// The scatter at the end of the record, if it is noise. Errors that last over some samples differ little from
  /// one to the next, so that differences show less than they are. 0: the end is no rest, or rings.
  [[nodiscard]] double noise_at_rest() const {
    const auto count = std::min(x_.size(), static_cast<std::size_t>(2.0 * half_period_));
    const LastingMean mean = mean_of(x_.size() - count, x_.size());
    int crossings = 0;
    for (std::size_t i = x_.size() - count + 1; i < x_.size(); ++i)
      crossings += (x_[i] > mean.value) != (x_[i - 1] > mean.value) ? 1 : 0;
    constexpr int fewest = 6;     // a motion of the rig has two
    constexpr double most = 8.0;  // of the noise by differences: with correlations of 0.98 from sample to sample
    return crossings >= fewest && mean.scatter < most * noise_ ? mean.scatter : 0.0;
  }

  /// Ripple and noise together may turn back by more than the band about the position of rest.
  void leave_out_rest(std::vector<std::size_t>& turns) {
    const std::size_t rest = begin_of_rest(x_, 2.0 * band_);
    const bool is_short = static_cast<double>(x_.size() - rest) < 2.0 * half_period_;
    if (!is_short && leave_out_irregular(x_, turns, rest, too_short * half_period_, too_long * half_period_))
      rest_ = rest;
  }

  /// Swings below this are noise.
  [[nodiscard]] double band_of(double noise) const {
    // Of n normal samples the extremes lie 2 sqrt(2 ln n) deviations apart, or less.
    const double noises = std::max(8.0, 2.0 * std::sqrt(2.0 * std::log(static_cast<double>(x_.size()))) + 1.0);
    constexpr double rounding = 1e-9;
    // While the mass sticks, the reading of a converter hardly changes, and the noise over all samples is below its
    // step.
    constexpr double steps = 2.5;
    constexpr std::size_t fewest_levels = 6;
    return std::max({noises * noise, steps * converter_step(history_.x, fewest_levels), rounding * range_of(x_)});
  }

  /// The median of the swings that are not much smaller than the largest one; ripple, and the motion of a mass that
  /// sticks to a contact that gives, are smaller. The ends of the first and the last swing are known less well.
  [[nodiscard]] double half_period_of(const std::vector<std::size_t>& turns) const {
    constexpr double least_share = 0.25;
    const auto swing = [&](std::size_t i) { return std::abs(x_[turns[i]] - x_[turns[i - 1]]); };
    double largest = 0.0;
    for (std::size_t i = 2; i + 1 < turns.size(); ++i) largest = std::max(largest, swing(i));
    std::vector<double> lengths;
    for (std::size_t i = 2; i + 1 < turns.size(); ++i)
      if (swing(i) >= least_share * largest) lengths.push_back(static_cast<double>(turns[i] - turns[i - 1]));
    const std::size_t begin = std::max(turns[0], held_until());
    if (lengths.empty()) return static_cast<double>(turns[1]) - static_cast<double>(begin);
    // The lower one of the middle two: a rest that wanders makes the last swing longer.
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>((lengths.size() - 1) / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
  }

  [[nodiscard]] std::string duration() const {
    const double lasts = static_cast<double>(x_.size() - 1) / history_.sample_rate;
    return " in " + core::format_number(lasts, 4) + " s";
  }

  /// The first and the last of two turning points of a zigzag are its ends.
  [[nodiscard]] std::string no_turns() const {
    const double range = range_of(x_);
    if (!(range > 0.0)) return "x does not move" + duration();
    const auto share = [range](double length) { return core::percent(length / range, 3); };
    return "x does not turn back" + duration() + ", where swings count above " + share(band_) +
           " of its range and its noise is " + share(noise_);
  }

  [[nodiscard]] std::string too_slow() const {
    const double rate = history_.sample_rate * fewest_in_half_period / half_period_;
    return "a half swing lasts " + core::format_number(half_period_, 3) + " samples, and its extremes need " +
           core::format_number(fewest_in_half_period, 2) + ": a sample rate of about " +
           core::format_number(rate, 3) + " Hz or more";
  }

  void put(DerivedDecay& result, double index, double value, double std) const {
    result.record.times.push_back(history_.start + index / history_.sample_rate);
    result.record.extremes.push_back(value);
    result.standard_errors.push_back(std);
  }

  void put_first(DerivedDecay& result, std::size_t index, double value, double std) const {
    put(result, static_cast<double>(index), value, std);
    for (std::vector<double>* list : {&result.record.extremes, &result.record.times, &result.standard_errors})
      std::rotate(list->begin(), list->end() - 1, list->end());
  }

  /// Of the samples [first, last).
  [[nodiscard]] LastingMean mean_of(std::size_t first, std::size_t last) const {
    return lasting_mean(x_.subspan(first, last - first));
  }

  /// Number of samples at the beginning that are equal to the first one within the noise: the mass is held.
  [[nodiscard]] std::size_t held_until() const {
    std::size_t i = 0;
    while (i < x_.size() && std::abs(x_[i] - x_[0]) < band_) ++i;
    return i;
  }

  /// Adds the position of release: where the mass is held, or the first sample if the velocity is zero there.
  void add_first(DerivedDecay& result, std::size_t held) const {
    if (static_cast<double>(held) > 2.0 * width_) {
      const LastingMean mean = mean_of(0, held);
      put_first(result, held - 1, mean.value, mean.std);
      result.first = held;
      return;
    }
    // Ten samples average noise well enough. They may reach over half of the swing; the fit has to have one more
    // than its unknowns.
    const auto reach = static_cast<std::size_t>(std::max(width_, std::min(9.0, half_period_ / 2.0)));
    const std::size_t last = std::max(reach + 1, std::size_t{start_columns} + 1);
    if (x_.size() < 2 * last) return;
    const LocalFit fit = local_fit(x_, 0, last, 0.0, width_, start_columns, [](double u, auto row) {
      for (Eigen::Index k = 0; k < row.size(); ++k) row(k) = std::pow(u, static_cast<double>(k));
    });
    // A slope of 1 % of the largest one changes the amplitude by 5e-5. Noise makes a slope where there is none; 5 %
    // would change the amplitude by 1e-3, which is less than such noise.
    constexpr double least_slope = 0.01;
    constexpr double most_slope = 0.05;
    constexpr double errors = 3.0;
    const double swing = std::abs(x_[static_cast<std::size_t>(half_period_)] - x_[0]);
    const double largest_slope = 0.5 * swing * std::numbers::pi * width_ / half_period_;
    const double hidden = errors * fit.slope_std;
    if (std::abs(fit.slope) < std::clamp(hidden, least_slope * largest_slope, most_slope * largest_slope)) {
      put_first(result, 0, fit.value, fit.std);
      return;
    }
    if (std::abs(fit.slope) >= hidden || !turns_at_first(result, fit.std / (0.5 * swing), swing)) return;
    const LocalFit level = local_fit(x_, 0, last, 0.0, width_, start_columns - 1, [](double u, auto row) {
      for (Eigen::Index k = 0; k < row.size(); ++k) row(k) = std::pow(u, static_cast<double>(k > 0 ? k + 1 : 0));
    });
    put_first(result, 0, level.value, level.std);
  }

  /// Where noise hides the first slope, the time of the first turning point tells whether the mass began at rest:
  /// one half swing, `swing` long, later. A phase that changes the amplitude by less than `share`
  /// counts as zero.
  [[nodiscard]] bool turns_at_first(const DerivedDecay& result, double share, double swing) const {
    const std::vector<double>& e = result.record.extremes;
    constexpr double least_share = 0.25;  // the times of smaller swings are uncertain
    std::size_t count = 0;
    while (count + 1 < e.size() && std::abs(e[count + 1] - e[count]) >= least_share * swing) ++count;
    if (count == 0) return false;
    const auto n = static_cast<double>(count);
    const std::vector<double>& times = result.record.times;
    const double half_swing = (times[count] - times[0]) / n;
    const double phase = std::numbers::pi * ((times[0] - history_.start) / half_swing - 1.0);
    // The noise moves a fitted turning point by about one and a half of its error over the amplitude.
    const auto error = [&](std::size_t i) {
      return 1.5 * result.standard_errors[i] / std::abs(0.5 * (e[i] - e[i > 0 ? i - 1 : 1]));
    };
    return std::abs(phase) <
           std::sqrt(2.0 * share) + 2.0 * std::hypot((1.0 + 1.0 / n) * error(0), error(count) / n);
  }

  /// Adds the value of the fit where its slope is zero. The powers 2, 3 and 4 have a coefficient on each side.
  /// False: the record has too few samples on one side.
  bool add(DerivedDecay& result, std::size_t turn) const {
    const auto reach = static_cast<std::size_t>(width_);
    const std::size_t first = turn > reach ? turn - reach : 0;
    const std::size_t last = std::min(turn + reach + 1, x_.size());
    if (last - first < std::min(2 * std::size_t{turn_columns}, 2 * reach + 1)) return false;
    const auto has_sides = [&](double centre) {
      constexpr double fewest = 2.5;  // samples, of three unknowns
      return std::min(centre - static_cast<double>(first), static_cast<double>(last - 1) - centre) >= fewest;
    };
    if (!has_sides(static_cast<double>(turn))) return false;
    const auto at = [&](double centre) {
      return local_fit(x_, first, last, centre, width_, turn_columns, [](double u, auto row) {
        const Eigen::Index side = u < 0.0 ? 0 : 1;
        row.setZero();
        row(0) = 1.0;
        for (Eigen::Index k = 0; k < 3; ++k) row(1 + 2 * k + side) = std::pow(u, static_cast<double>(k + 2));
      });
    };
    // With few samples, there are several minima. An extreme is not inside of the largest sample, but for noise and
    // the error of the fit.
    const double height = x_[turn] - 0.5 * (x_[first] + x_[last - 1]);
    const double inside = std::max(0.5 * band_, 0.01 * std::abs(height));
    constexpr double none = std::numeric_limits<double>::max();
    const auto squares = [&](double centre) {
      if (!has_sides(centre)) return none;
      const LocalFit trial = at(centre);
      const bool is_extreme = std::copysign(1.0, height) * (x_[turn] - trial.value) <= inside;
      return is_extreme ? trial.sum_of_squares : none;
    };
    constexpr int trials = 12;
    const double step = 2.0 * 0.3 * width_ / trials;
    double best = static_cast<double>(turn);
    double least = none;
    for (int k = 0; k <= trials; ++k) {
      const double trial = static_cast<double>(turn) + (k - 0.5 * trials) * step;
      const double sum = squares(trial);
      if (sum < least) best = trial;
      least = std::min(sum, least);
    }
    constexpr int bits = 26;
    const double centre = boost::math::tools::brent_find_minima(squares, best - step, best + step, bits).first;
    const LocalFit fit = at(centre);
    put(result, centre, fit.value, fit.std);
    return true;
  }

  /// Adds the position in which the mass sticks to the end of the record.
  void add_last(DerivedDecay& result, std::size_t turn) const {
    std::size_t first = x_.size();
    while (first > 0 && std::abs(x_[first - 1] - x_.back()) < band_) --first;
    first = std::min(first, rest_);
    const bool rests = static_cast<double>(x_.size() - first) > half_period_;
    if (!rests || first == 0 || turn + 1 < first) return;
    const LastingMean mean = mean_of(first, x_.size());
    put(result, static_cast<double>(first), mean.value, mean.std);
    result.rests = true;
    // A hundred samples at one position would repeat the error of the sensor there a hundred times.
    result.last = std::min(x_.size(), first + 2 * static_cast<std::size_t>(half_period_));
    // The noise hides the moment of the stop, which is half a period after the last turning point.
    std::vector<double>& times = result.record.times;
    if (times.size() < 3) return;
    const std::size_t turned = times.size() - 2;
    const std::size_t from = turned > 1 ? 1 : 0;  // the noise hides the moment of release as well
    const double half_swing = (times[turned] - times[from]) / static_cast<double>(turned - from);
    times.back() = times[turned] + half_swing;
    add_small_swing(result, half_swing * history_.sample_rate);
  }

  /// A mass that turns just outside of the band in which it sticks moves once more, by less than `band_`: the rest
  /// is not the last turning point but the next. Between them it follows (1 + cos)/2.
  void add_small_swing(DerivedDecay& result, double half_swing) const {
    std::vector<double>& extremes = result.record.extremes;
    const double turned = (result.record.times.back() - history_.start) * history_.sample_rate;
    const auto begin = static_cast<std::size_t>(std::max(0.0, std::ceil(turned)));
    const auto stop = static_cast<std::size_t>(std::ceil(turned + half_swing));
    if (stop <= begin || 2 * stop > begin + x_.size()) return;  // the rest is shorter than the swing
    const LastingMean rest = mean_of(stop, x_.size());
    Eigen::ArrayXd path(static_cast<Eigen::Index>(stop - begin));
    for (Eigen::Index i = 0; i < path.size(); ++i)
      path[i] = 0.5 + 0.5 * std::cos(std::numbers::pi * (std::ceil(turned) + static_cast<double>(i) - turned) /
                                     half_swing);
    const Eigen::ArrayXd moved = Eigen::Map<const Eigen::ArrayXd>(&x_[begin], path.size()) - rest.value;
    const double swing = (path * moved).sum() / path.square().sum();
    // The band is at least eight deviations of the noise, or as wide for the steps of a converter.
    const double noise = std::max(rest.scatter, band_ / 9.0);
    const double std = std::hypot(rest.longer * noise / std::sqrt(path.square().sum()), rest.std);
    const double onwards = std::copysign(1.0, extremes.back() - extremes[extremes.size() - 2]);
    constexpr double deviations = 3.0;
    constexpr double most_left = 1.5;  // a contact that gives moves otherwise
    const double left = std::sqrt((moved - swing * path).square().mean());
    if (swing * onwards < deviations * std || left > most_left * noise) return;
    extremes.back() = rest.value + swing;
    result.standard_errors.back() = std;
    put(result, turned + half_swing, rest.value, rest.std);
    result.last = std::min(x_.size(), result.last + static_cast<std::size_t>(half_swing));
  }

  /// The swings of a free decay shrink and last equally long. They may be equal until a drive stops, grow while a
  /// blow pushes the mass, and in the noise at the end; a mass that sticks to a contact that gives moves faster.
  /// These parts are cut off. Returns why the history is no free decay; empty if it is one.
  [[nodiscard]] std::string keep_decay(DerivedDecay& result) const {
    const std::vector<double>& extremes = result.record.extremes;
    if (extremes.size() < 3) return too_few(result, " extremes" + duration(), extremes.size());
    const auto swing = [&extremes](std::size_t i) { return std::abs(extremes[i] - extremes[i - 1]); };
    const std::size_t steady = steady_swings(extremes, result.standard_errors);
    const std::size_t largest = first_of_largest(extremes, result.standard_errors, steady + 1);
    const auto is_fast = [&](std::size_t i) { return lasting(result, i) < too_short * half_period_; };
    // Largest share of the swings that may be left where they grow again. Above it, there is another release or a
    // drive.
    constexpr double most_left = 0.25;
    const double usual = upper_median(result.standard_errors);
    const auto is_growing = [&](std::size_t i) {
      const double error = swing(i) > most_left * swing(largest) ? error_of_growth(result, i, usual) : 0.0;
      return swing(i) - swing(i - 1) >= error;
    };
    std::size_t end = largest + 1;
    while (end < extremes.size() && !is_growing(end) && !is_fast(end)) ++end;
    const bool fails = end < extremes.size();
    const bool grows = fails && is_growing(end);
    // The cause of the growth may have acted already in the swings before; these last too long.
    while (grows && end > largest + 1 && lasting(result, end - 1) > too_long * half_period_) --end;
    if (fails && swing(end) > most_left * swing(largest))
      return driven(result, "the swings do not shrink as in a free vibration");
    // A blow may last to the start of the largest swing. It is over at the end of this swing.
    constexpr std::size_t longest_start = 3;
    const std::size_t begin = largest > 1 ? largest : 0;
    if (begin > steady + longest_start + 1) return driven(result, "the swings grow at the beginning");
    if (end < begin + 3) return too_few(result, " extremes from its largest swing on", end - begin);
    const std::span<const double> errors = result.standard_errors;
    if (!swings_shrink(std::span(extremes).subspan(begin, end - begin), errors.subspan(begin, end - begin)))
      return driven(result, std::to_string(end - begin - 1) + " swings do not shrink beyond their noise");
    if (fails) {
      const std::string where = " at t = " + core::format_number(result.record.times[end], 4) + " s, where " +
                                core::percent(swing(end - 1) / swing(largest), 2) +
                                " of the largest is left: the extremes before are used";
      result.warnings.push_back((grows ? "the swings of the free vibration grow again"
                                       : "the swings of the free vibration become faster") +
                                where);
      result.last = sample_of(result, end - 1) + 1;
      result.rests = false;
    }
    if (begin > 0)
      result.warnings.push_back("the free vibration is taken from the end of its largest swing on, t = " +
                                core::format_number(result.record.times[begin], 4) + " s");
    // A blow that was not measured may push the mass until the first extreme.
    if (begin > 0 || !history_.begins_free) result.first = std::max(result.first, sample_of(result, begin));
    cut(result, begin, end);
    return {};
  }

  static std::string driven(DerivedDecay& result, const std::string& what) {
    result.is_driven = true;
    return what + ": the drive of the motion was not recorded";
  }

  static std::string too_few(DerivedDecay& result, const std::string& extremes, std::size_t count) {
    result.is_coarse = true;
    return "x has " + std::to_string(count) + extremes;
  }

  /// Between two swings that shrink hardly, the noise of their extremes may show a growth up to this. `extreme`,
  /// the last of the three, is the third or a later one. Few samples tell each error: none is below the usual one.
  static double error_of_growth(const DerivedDecay& result, std::size_t extreme, double usual) {
    constexpr double deviations = 5.0;
    const auto error = [&](std::size_t i) { return std::max(result.standard_errors[i], usual); };
    return deviations * std::hypot(error(extreme - 2), 2.0 * error(extreme - 1), error(extreme));
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

  // The error of an extreme is 4e-6 of the swing down to 32 samples a period, 1e-4 at 20 and 2e-4 at 16. Below, a
  // fit has too few samples.
  static constexpr double fewest_in_half_period = 8.0;
  static constexpr double too_short = 0.7, too_long = 1.4;  ///< for a swing, in half periods
  static constexpr double narrowest = 4.0;  ///< a side of a fit has three unknowns and its share of the place
  static constexpr Eigen::Index start_columns = 5;
  static constexpr Eigen::Index turn_columns = 7;

  const History& history_;
  std::span<const double> x_;
  double band_ = 0.0;                                           ///< differences below it are noise [m]
  double noise_ = 0.0;                                          ///< deviation [m]
  double half_period_ = 0.0;                                    ///< in samples
  std::size_t rest_ = std::numeric_limits<std::size_t>::max();  ///< sample at which a rest with ripple begins
  double width_ = 0.0;                                          ///< half the number of samples of a local fit
};

}  // namespace

DerivedDecay decay_of(const History& history) { return DecayReader(history).run(); }

}  // namespace dualdamp::identify
