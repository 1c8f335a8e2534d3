#include "sim/orbits/transient.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/orbits/structural_damping.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

/// Decides by the closure of the last periods whether the transient has ended.
class Closing {
 public:
  Closing(double rounding, double settled) : rounding_(rounding), settled_(settled) {}

  /// Whether the transient has ended.
  bool add(double closure) {
    closures_.push_back(closure);
    if (closures_.size() <= back) return false;
    const double largest = largest_between(back, 0).value;
    if (largest <= rounding_) return true;
    const double rate = std::max(
        std::pow(closure / closures_[closures_.size() - 1 - back], 1.0 / static_cast<double>(back)), late_rate());
    if (!(rate < 1.0 && largest < settled_ && closure * rate / (1.0 - rate) < settled_)) return false;
    const auto now = static_cast<double>(closures_.size());
    if (sure_from_ == 0.0 && has_settled(largest)) {
      // A fast decay may hide a slow one of far larger rest. It shows when the fast one has gone on by two digits.
      constexpr double most = 16.0;
      sure_from_ = now + std::min({most, 0.5 * now, std::ceil(std::log(0.01) / std::log(rate))});
    }
    return sure_from_ > 0.0 && now >= sure_from_;
  }

 private:
  static constexpr std::size_t back = 8;  // a motion that winds closes better and worse in turn
  struct Largest {
    double value = 0.0;
    std::size_t ago = 0;  ///< periods
  };

  /// The largest closure of the periods from `from` ago to `to` ago.
  [[nodiscard]] Largest largest_between(std::size_t from, std::size_t to) const {
    const auto place = [&](std::size_t ago) { return closures_.end() - static_cast<std::ptrdiff_t>(ago); };
    const auto largest = std::max_element(place(from), place(to));
    return {*largest, static_cast<std::size_t>(closures_.end() - largest) - 1};
  }

  /// The factor by which closures fall in the second half of the last periods: a fast decay that is over hides a
  /// slow one in the first half.
  [[nodiscard]] double late_rate() const {
    constexpr std::size_t half = back / 2;
    return std::pow(largest_between(half, 0).value / largest_between(back, half).value,
                    1.0 / static_cast<double>(half));
  }

  /// A motion that winds slowly closes well for many periods where it turns. So the test is repeated with the
  /// envelope over longer and longer times, as far back as the present closure can belong to the same decay.
  [[nodiscard]] bool has_settled(double now) const {
    constexpr double deepest = 1e5;
    for (std::size_t span = 2 * back; 2 * span <= closures_.size(); span *= 2) {
      const Largest recent = largest_between(span, 0);
      const double before = largest_between(2 * span, span).value;
      if (before > deepest * now) break;
      const double rate = std::pow(recent.value / before, 1.0 / static_cast<double>(span));
      const double envelope = recent.value * std::pow(rate, static_cast<double>(recent.ago));
      if (!(rate < 1.0) || !(envelope * rate / (1.0 - rate) < settled_)) return false;
    }
    return true;
  }

  double rounding_;
  double settled_;
  double sure_from_ = 0.0;  ///< periods; 0: the transient has not seemed to have settled yet
  std::vector<double> closures_;
};

}  // namespace

Transient follow_transient(const Model& model, const TransientOptions& options) {
  if (model.oscillator.loss_factor != 0.0) return follow_transient(with_viscous_equivalent(model), options);
  constexpr double rounding = 4e-15;
  Transient result;
  PeriodMap map(valid_harmonic(model, "follow_transient"), options.period_ratio);
  map.limit(options.most_work);
  PeriodEvents events;
  ForcingPeriod period = map.from_start(model.initial.position, model.initial.velocity, Monodromy::without);
  Closing closing(std::max(rounding, map.engine().accuracy()), options.settled);
  result.periods = options.period_ratio;
  while (result.periods < options.max_periods && map.outcome().ok()) {
    period = map.from(period.end, Monodromy::without, &events);
    result.periods += options.period_ratio;
    result.closure = period.closure(model.excitation.frequency);
    result.settled = closing.add(result.closure);
    if (result.settled || (options.give_up && options.give_up())) break;
  }
  result.outcome = map.outcome();
  result.peak = events.peak();
  result.trough = events.trough();
  result.stops = events.stops();
  return result;
}

void PeriodEvents::begin(const State& start) {
  sequence_.clear();
  peak_ = trough_ = start.x;
  stops_ = 0;
}

void PeriodEvents::observe(const Interval& interval, double x) {
  peak_ = std::max(peak_, x);
  trough_ = std::min(trough_, x);
  if (!interval.ending) return;
  if (*interval.ending == EventKind::stop) ++stops_;
  sequence_ += static_cast<char>('a' + static_cast<int>(*interval.ending));
  sequence_ += interval.direction == friction::Direction::none      ? '0'
               : interval.direction == friction::Direction::forward ? '+'
                                                                    : '-';
}

}  // namespace dualdamp::sim
