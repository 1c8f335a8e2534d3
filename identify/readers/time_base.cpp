#include "identify/readers/time_base.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/readers/polynomial.hpp"
#include "identify/readers/problems.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t fewest_samples = 16;
/// Least share of the rows that a part without a gap must have.
constexpr double least_share = 0.1;
/// Steps longer than this many usual ones are gaps.
constexpr double gap = 1.5;
constexpr std::size_t most_lone_gaps = 2;
/// The same for a clock with jitter.
constexpr double jittered_gap = 4.0;
/// Jitter that is ignored, as a share of a step.
constexpr double clock_jitter = 0.01;
/// Largest distance of stamps in bursts (in bursts), or of late stamps (in steps), from the line.
constexpr double most_delay = 1.5;

constexpr int digits_shown = 4;

std::string seconds(double time) { return core::format_number(time, digits_shown) + " s"; }

/// Of the line of least squares.
double slope(std::span<const std::size_t> places, std::span<const double> t) {
  const double middle = std::accumulate(places.begin(), places.end(), 0.0) / static_cast<double>(places.size());
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double place = static_cast<double>(places[i]) - middle;
    products += place * (t[i] - t[0]);
    squares += place * place;
  }
  return products / squares;
}

class StampReader {
 public:
  explicit StampReader(const TimeStamps& stamps) : stamps_(stamps), t_(stamps.t), all_{0, stamps.t.size()} {}

  TimeBase run() {
    if (all_.size() < fewest_samples)
      return fault(0, "a history of " + std::to_string(all_.size()) + " rows is too short",
                   "at least " + std::to_string(fewest_samples) + " rows; or extremes, each row turning back");
    if (std::ranges::any_of(t_, [](double t) { return std::isnan(t); })) return {};  // already reported
    const auto back = first_step_back();
    if (back < t_.size())
      return fault(back, std::string(no_increase),
                   "a time after the row above; several tests need labels in a column sweep");
    const bool even = is_even(all_);
    if (even && holds_few_doubles()) return with_few_doubles();
    if (even && !has_long_step()) return rows(all_, {});
    // A few long steps are missing samples. Many long steps come from times that are rounded to about a step, if a
    // line explains them.
    const double step = median_step(all_);
    if (even && long_steps(step) > most_lone_gaps) return rows(all_, {});
    if (first_double() < t_.size()) return bursts();
    if (std::optional<TimeBase> base = with_lost_samples(step)) return *std::move(base);
    const Part part = most_moving_without(gap * step);
    if (part.size() < all_.size() && is_even(part)) return without_gaps(part);
    return jitter(step);
  }

 private:
  struct Part {
    std::size_t first = 0;
    std::size_t last = 0;
    [[nodiscard]] std::size_t size() const { return last - first; }
  };

  [[nodiscard]] const std::span<const double>& leading() const { return stamps_.signals.front(); }

  static TimeBase fault(std::size_t row, std::string message, std::string allowed) {
    TimeBase base;
    base.fault = TimeFault{row, std::move(message), std::move(allowed)};
    return base;
  }

  [[nodiscard]] TimeBase rows(Part part, std::string warning) const {
    TimeBase base;
    base.first = part.first;
    base.last = part.last;
    base.step = even_step(part);
    base.warning = std::move(warning);
    return base;
  }

  [[nodiscard]] std::size_t first_step_back() const {
    std::size_t row = 1;
    while (row < t_.size() && t_[row] >= t_[row - 1]) ++row;
    return row;
  }

  [[nodiscard]] std::size_t first_double() const {
    std::size_t row = 1;
    while (row < t_.size() && t_[row] > t_[row - 1]) ++row;
    return row;
  }

  /// Largest rounding error of a printed time [s].
  [[nodiscard]] double rounding_of(double t) const {
    if (t == 0.0) return stamps_.quantum;
    const double last_digit = std::pow(10.0, std::floor(std::log10(std::abs(t))) + 1.0 - stamps_.digits);
    return std::max(stamps_.quantum, last_digit);
  }

  /// The line through two times is off by up to half a unit of the last digit, like each of them. The time that is
  /// compared with the line has the same error: together one unit.
  [[nodiscard]] double largest_rounding(Part part) const {
    return std::max(rounding_of(t_[part.first]), rounding_of(t_[part.last - 1]));
  }

  [[nodiscard]] double mean_step(Part part) const {
    return (t_[part.last - 1] - t_[part.first]) / static_cast<double>(part.size() - 1);
  }

  /// The step from all stamps; from the first and the last one, if the stamps are even to the last bits.
  [[nodiscard]] double even_step(Part part) const {
    const double step = mean_step(part);
    constexpr double last_bits = 1e-9;
    if (part.size() < 3 || distance(part, worst_row(part)) <= last_bits * step) return step;
    return first_double() < t_.size() ? step_of_strip(part) : step_of_least_squares(part);
  }

  [[nodiscard]] double step_of_least_squares(Part part) const {
    std::vector<std::size_t> places(part.size());
    std::iota(places.begin(), places.end(), 0);
    return slope(places, t_.subspan(part.first, part.size()));
  }

  /// Slope of the narrowest strip that holds all stamps. The stamps of a coarse clock are stairs along a line.
  /// Least squares would change the slope by the square of the share of a stair in the record.
  [[nodiscard]] double step_of_strip(Part part) const {
    const auto width = [&](double step) {
      double low = 0.0;
      double high = 0.0;
      for (std::size_t row = part.first; row < part.last; ++row) {
        const double beside = t_[row] - t_[part.first] - static_cast<double>(row - part.first) * step;
        low = std::min(low, beside);
        high = std::max(high, beside);
      }
      return high - low;
    };
    // The width is a convex function of the slope. The range covers every slope that the two ends allow.
    const double step = mean_step(part);
    const double reach = 4.0 * distance(part, worst_row(part)) / static_cast<double>(part.size() - 1);
    constexpr int bits = 40;
    return boost::math::tools::brent_find_minima(width, step - reach, step + reach, bits).first;
  }

  /// Distance of a time from the line through the first and the last time.
  [[nodiscard]] double distance(Part part, std::size_t row) const {
    const double line = t_[part.first] + static_cast<double>(row - part.first) * mean_step(part);
    return std::abs(t_[row] - line);
  }

  [[nodiscard]] std::size_t worst_row(Part part) const {
    std::size_t worst = part.first;
    for (std::size_t row = part.first; row < part.last; ++row)
      if (distance(part, row) > distance(part, worst)) worst = row;
    return worst;
  }

  [[nodiscard]] bool is_even(Part part) const {
    return part.size() > 1 && mean_step(part) > 0.0 &&
           distance(part, worst_row(part)) - largest_rounding(part) <= clock_jitter * mean_step(part);
  }

  [[nodiscard]] std::size_t long_steps(double step) const {
    std::size_t count = 0;
    for (std::size_t row = 1; row < t_.size(); ++row) count += t_[row] - t_[row - 1] > gap * step ? 1 : 0;
    return count;
  }

  [[nodiscard]] bool has_long_step() const { return long_steps(mean_step(all_)) > 0; }

  [[nodiscard]] std::vector<double> steps(Part part) const {
    std::vector<double> steps(part.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = t_[part.first + i + 1] - t_[part.first + i];
    return steps;
  }

  [[nodiscard]] double median_step(Part part) const { return upper_median(steps(part)); }

  [[nodiscard]] bool is_too_short(Part part) const {
    return part.size() < fewest_samples ||
           static_cast<double>(part.size()) < least_share * static_cast<double>(all_.size());
  }

  /// Of the parts without a longer step and with rows enough, the one with the largest sum of squares of the
  /// motion: behind a lost stretch of a decay the mass may be at rest. The longest one, if none has rows enough.
  [[nodiscard]] Part most_moving_without(double longest_step) const {
    const double middle = upper_median({leading().begin(), leading().end()});
    Part longest;
    Part best;
    double most = -1.0;
    Part part;
    double squares = 0.0;
    for (std::size_t row = 0; row <= all_.last; ++row) {
      if (row == all_.last || (row > 0 && t_[row] - t_[row - 1] > longest_step)) {
        part.last = row;
        if (part.size() > longest.size()) longest = part;
        if (!is_too_short(part) && squares > most) best = part, most = squares;
        part.first = row;
        squares = 0.0;
      }
      if (row < leading().size()) squares += (leading()[row] - middle) * (leading()[row] - middle);
    }
    return most < 0.0 ? longest : best;
  }

  [[nodiscard]] TimeBase torn(Part longest) const {
    return fault(longest.last < all_.last ? longest.last : longest.first,
                 "the times have gaps, and no stretch between them is long enough",
                 "an uninterrupted stretch of " + std::to_string(fewest_samples) + " rows and a tenth of all");
  }

  [[nodiscard]] std::string span_text(Part part) const {
    constexpr int shown = 6;
    return std::to_string(part.size()) + " rows from t = " + core::format_number(t_[part.first], shown) + " s to " +
           core::format_number(t_[part.last - 1], shown) + " s";
  }

  /// The stretches before and after the one that is used, and what to do with them.
  [[nodiscard]] std::string gap_warning(Part used) const {
    std::vector<std::string> others;
    if (used.first > 0) others.push_back(span_text({0, used.first}));
    if (used.last < all_.last) others.push_back(span_text({used.last, all_.last}));
    return "the times have gaps: of " + std::to_string(all_.size()) +
           " rows only the uninterrupted stretch with the most motion is used, " + span_text(used) +
           "; left out are " + core::joined(others, " and ") +
           ": a label in a column sweep for each stretch, the same in all its rows, makes it a test of its own";
  }

  [[nodiscard]] TimeBase without_gaps(Part part) const {
    return is_too_short(part) ? torn(part) : rows(part, gap_warning(part));
  }

  /// Nothing, unless a few samples are lost among even ones and all signals are smooth across them.
  [[nodiscard]] std::optional<TimeBase> with_lost_samples(double usual_step) const {
    std::optional<RowPlaces> places = row_places(t_, usual_step);
    if (!places || places->lost == 0) return std::nullopt;
    const auto place = [&](std::size_t row) { return static_cast<double>(places->of_row[row]); };
    const double step = (t_.back() - t_.front()) / place(all_.last - 1);
    for (std::size_t row = 0; row < all_.last; ++row)
      if (std::abs(t_[row] - t_.front() - place(row) * step) > clock_jitter * step + largest_rounding(all_))
        return std::nullopt;
    if (!std::ranges::all_of(stamps_.signals, [&](const auto& one) { return can_be_filled(*places, one); }))
      return std::nullopt;
    const bool is_one = places->lost == 1;
    TimeBase base =
        rows(all_, (is_one ? "1 sample is" : std::to_string(places->lost) + " samples are") +
                       " missing between the times, at most " + std::to_string(places->lost_in_a_row) +
                       " in a row: filled by polynomials through the samples beside " + (is_one ? "it" : "them"));
    base.step = slope(places->of_row, t_);
    base.places = std::move(places);
    return base;
  }

  /// A coarse clock repeats a stamp where two samples fall into one of its steps. A row that does not belong there
  /// repeats it too, but with it the samples beside are not even.
  [[nodiscard]] bool holds_few_doubles() const {
    constexpr double most = 0.1;
    const auto doubles = std::ranges::count(steps(all_), 0.0);
    return doubles > 0 && static_cast<double>(doubles) < most * static_cast<double>(all_.size() - 1);
  }

  [[nodiscard]] TimeBase with_few_doubles() const {
    double with = 0.0;
    double without = 0.0;
    std::size_t doubles = 0;
    for (std::size_t row = 1; row < t_.size(); ++row) {
      if (t_[row] != t_[row - 1]) continue;
      ++doubles;
      with += roughness_beside(row, t_.size());
      without += roughness_beside(row, row);
    }
    constexpr double clearly = 10.0;
    if (with > clearly * without)
      return fault(first_double(), std::string(no_increase_twice) + ", with other values",
                   "one row for each time; several tests need labels in a column sweep");
    if (without > clearly * with) return rows(all_, {});
    return rows(all_, std::to_string(doubles) + (doubles == 1 ? " time appears" : " times appear") +
                          " twice with other values: the samples are taken as evenly spaced, " +
                          seconds(even_step(all_)) + " apart");
  }

  /// Mean square distance of the samples beside a row from cubics through their neighbours, without row `left_out`.
  [[nodiscard]] double roughness_beside(std::size_t row, std::size_t left_out) const {
    constexpr std::size_t reach = 4;
    std::vector<double> near;
    for (std::size_t i = row < reach ? 0 : row - reach; i < std::min(row + reach, leading().size()); ++i)
      if (i != left_out) near.push_back(leading()[i]);
    double sum = 0.0;
    for (std::size_t i = 2; i + 2 < near.size(); ++i)
      sum += std::pow((4.0 * (near[i - 1] + near[i + 1]) - near[i - 2] - near[i + 2]) / 6.0 - near[i], 2);
    return near.size() > 4 ? sum / static_cast<double>(near.size() - 4) : 0.0;
  }

  /// Number of stamps that appear several times.
  [[nodiscard]] TimeBase bursts() const {
    std::vector<double> between = steps(all_);
    const auto doubles = std::erase(between, 0.0);
    constexpr double fewest = 0.1;
    if (static_cast<double>(doubles) < fewest * static_cast<double>(all_.size() - 1))
      return fault(first_double(), std::string(no_increase_twice),
                   "a time after the row above; several tests need labels in a column sweep");
    const std::size_t worst = worst_row(all_);
    if (between.empty()) return fault(worst, "all times are equal", "times that increase");
    std::ranges::sort(between);
    constexpr double most = 0.95;
    const double burst = between[static_cast<std::size_t>(most * static_cast<double>(between.size() - 1))];
    const std::string found = "the time stamps come in bursts (" + std::to_string(between.size() + 1) +
                              " different stamps, 95 % of them at most " + seconds(burst) + " apart)";
    if (distance(all_, worst) > most_delay * burst)
      return fault(
          worst, found + ", and samples are missing between them",
          "stamps within one and a half bursts of a constant sample rate; or times of the instrument's own clock");
    return rows(all_, found + ": the samples are taken as evenly spaced, " + seconds(even_step(all_)) + " apart");
  }

  [[nodiscard]] TimeBase jitter(double step) const {
    const Part part = most_moving_without(jittered_gap * step);
    if (is_too_short(part)) return torn(part);
    const std::vector<double> all_steps = steps(part);
    const auto [low, high] = std::ranges::minmax(all_steps);
    const std::string range = "(steps from " + seconds(low) + " to " + seconds(high) + ")";
    const std::string gaps = part.size() < all_.size() ? gap_warning(part) + "; " : "";
    const std::size_t worst = worst_row(part);
    const Roughness rough = roughness(part);
    const bool is_late = distance(part, worst) <= most_delay * step;
    // Where noise hides what is smoother, steps that vary slowly are no delays.
    constexpr double alike = 1.2;
    if (rough.at_stamps <= (is_late ? 1.0 : alike) * rough.at_even) {
      TimeBase base =
          rows(part, gaps + "the samples are not evenly spaced " + range +
                         ": they are interpolated at even times, " + seconds(mean_step(part)) + " apart");
      base.step = mean_step(part);
      base.is_interpolated = true;
      return base;
    }
    if (!is_late)
      return fault(worst,
                   "the time steps are not constant " + range +
                       ", and the signal fits neither them nor a constant sample rate",
                   "a constant sample rate; here a step of about " + seconds(step));
    return rows(part, gaps + "the time stamps jitter " + range +
                          ": the samples, smoother without the jitter, are taken " + "as evenly spaced, " +
                          seconds(even_step(part)) + " apart");
  }

  /// Mean square distance of the samples from cubics through their four neighbours, over what noise makes of it: of
  /// uneven neighbours it makes more.
  struct Roughness {
    double at_stamps = 0.0;
    double at_even = 0.0;
  };

  [[nodiscard]] Roughness roughness(Part part) const {
    Roughness sums;
    const auto& x = leading();
    const auto add = [&](double& sum, std::size_t i, const std::array<double, 4>& times, double at) {
      const std::array<double, 4> near = {x[i - 2], x[i - 1], x[i + 1], x[i + 2]};
      double noise = 1.0;
      for (std::size_t k = 0; k < near.size(); ++k) {
        std::array<double, 4> unit = {};
        unit[k] = 1.0;
        noise += std::pow(polynomial(times, unit, at), 2);
      }
      sum += std::pow(polynomial(times, near, at) - x[i], 2) / noise;
    };
    for (std::size_t i = part.first + 2; i + 2 < part.last && i + 2 < x.size(); ++i) {
      add(sums.at_stamps, i, {t_[i - 2], t_[i - 1], t_[i + 1], t_[i + 2]}, t_[i]);
      add(sums.at_even, i, {-2.0, -1.0, 1.0, 2.0}, 0.0);
    }
    return sums;
  }

  const TimeStamps& stamps_;
  std::span<const double> t_;
  Part all_;
};

/// The signal at as many even times from the first stamp to the last, by cubics through four neighbours. Stamps
/// must increase.
std::vector<double> interpolated_evenly(std::span<const double> t, std::span<const double> values) {
  const std::size_t n = t.size();
  std::vector<double> result(n);
  std::size_t next = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = t[0] + (t[n - 1] - t[0]) * static_cast<double>(i) / static_cast<double>(n - 1);
    while (next + 1 < n && t[next] < at) ++next;
    const std::size_t first = std::min(next < 2 ? 0 : next - 2, n - 4);
    const std::array<double, 4> near = {t[first], t[first + 1], t[first + 2], t[first + 3]};
    result[i] = polynomial(near, {values[first], values[first + 1], values[first + 2], values[first + 3]}, at);
  }
  return result;
}

}  // namespace

TimeBase time_base_of(const TimeStamps& stamps) { return StampReader(stamps).run(); }

std::vector<double> even_samples(const TimeBase& base, std::span<const double> t, std::span<const double> values) {
  if (base.is_interpolated) return interpolated_evenly(t, values);
  if (base.places) return filled(*base.places, values);
  return {values.begin(), values.end()};
}

}  // namespace dualdamp::identify
