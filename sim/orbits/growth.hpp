#pragma once
/// Judges of a motion that does not become periodic: growth without end, and creep.
///
/// Growth without end differs from growth that slows down and from beats.
///
/// It decides after 500, 1000, 2000, ... periods. An amplitude grows without end if it gained 1.7 times as much
/// over the last doubling of time, n to 2 n, as over the doubling before; growth in proportion to time gains 2
/// times as much. An amplitude that tends to a limit as 1 - exp(-n/tau) or as tanh(n/tau) gains 1.7 times as much
/// only for n below tau/4.5 or tau/3.4, and would then not settle within 20,000 periods. A beating amplitude has
/// been larger before. A motion that is followed no longer is judged by the same rule over its last two doublings.
///
/// How long such a motion is integrated: a limit of forcing periods, and a limit of work (`Engine::work`), which is
/// the same on every machine. After some five seconds the program gives up, and the message states the number of
/// forcing periods.

#include <algorithm>
#include <limits>
#include <vector>

namespace dualdamp::sim {

struct Patience {
  long periods;  ///< a motion that has not come back after this many is tested for being aperiodic
  long work;     ///< of the motion; all attempts to find an orbit near it may take as much again
};

/// `accuracy`: Engine::accuracy(), 0 for the exact engine; `most_work`: a smaller limit of work.
constexpr Patience patience_with(double accuracy, long most_work = std::numeric_limits<long>::max()) {
  return accuracy > 0.0 ? Patience{1000, std::min(3'000'000L, most_work)}
                        : Patience{8000, std::min(2'000'000L, most_work)};
}

class Growth {
 public:
  /// Takes the largest |x| of the next period [m].
  void observe(double amplitude) {
    const int period = period_++;
    (period < half_ ? first_half_ : second_half_) =
        std::max(period < half_ ? first_half_ : second_half_, amplitude);
    if (period == 0) early_ = amplitude;
    runs_away_ = early_ > 0.0 && amplitude > runaway * early_;
    last_seen_ = amplitude;
    largest_ = std::max(largest_, amplitude);
    seen_.push_back(amplitude);
    if (period != next_) return;
    next_ *= 2;
    const double gain = amplitude < beating * largest_ ? 0.0 : amplitude - last_;
    goes_on_ = is_growth(gain_, gain, amplitude);
    gain_ = last_ > 0.0 ? gain : 0.0;
    last_ = amplitude;
  }

  /// `periods`: largest number of periods.
  explicit Growth(int periods) : half_(periods / 2) {}

  /// Whether growth does not slow down, or the amplitude is beyond all bounds.
  [[nodiscard]] bool is_endless() const { return goes_on_ || runs_away_; }
  /// Whether growth did not slow down up to now, of a motion that is followed no longer.
  [[nodiscard]] bool goes_on_now() const {
    constexpr std::size_t fewest = 32;  // periods
    if (seen_.size() < fewest) return is_endless();
    const double now = seen_.back();
    const double half = seen_[seen_.size() / 2 - 1];
    const double quarter = seen_[seen_.size() / 4 - 1];
    return is_endless() || (now >= beating * largest_ && is_growth(half - quarter, now - half, now));
  }
  /// The largest amplitude so far [m].
  [[nodiscard]] double largest() const { return largest_; }
  /// Whether the motion grew up to the end.
  [[nodiscard]] bool has_grown() const {
    return is_endless() || second_half_ > 1.5 * first_half_ || last_seen_ > 1.5 * first_half_;
  }

 private:
  /// An amplitude that is this many times that of the first period is beyond all bounds.
  static constexpr double runaway = 1e9;
  static constexpr double beating = 0.9;  ///< of the largest amplitude: one below it has been larger before

  /// `before`, `gain`: over the last two doublings of time, up to `amplitude`.
  static bool is_growth(double before, double gain, double amplitude) {
    constexpr double gained_more = 1.7;
    constexpr double at_least = 0.1;  // of the amplitude; growth in proportion to time gains 1/2
    return before > 0.0 && gain > gained_more * before && gain > at_least * amplitude;
  }

  int half_;
  int period_ = 0;
  int next_ = 500;
  double early_ = 0.0;
  double largest_ = 0.0;
  double last_ = 0.0;
  double last_seen_ = 0.0;
  double gain_ = 0.0;
  double first_half_ = 0.0;
  double second_half_ = 0.0;
  bool goes_on_ = false;
  bool runs_away_ = false;
  std::vector<double> seen_;  ///< the amplitude of each period
};

/// Tells a motion that creeps from one that approaches an orbit.
///
/// Near an orbit that attracts, the motion comes back better by the same factor in each forcing period: over
/// doublings of time, n to 2 n, the closure falls by r, then r^2, then r^4. Where contacts age, or a mass creeps
/// below the force that would break it away, the closure falls like a power of time instead: by much the same
/// factor over each doubling, 1/2 for a state that grows like ln t. Such a motion becomes periodic within no time
/// that anybody waits.
///
/// It decides at 32, 64, ... forcing periods by the two doublings before. A factor r in [0.2, 0.7] followed by one
/// that is not smaller than 0.85 r is no r^2. The closure has to fall in each period of the last doubling, or the
/// motion winds or beats, and the amplitude must neither grow nor decay: that of a vibration under quadratic drag
/// decays like a power of time too. Sums of decays can look like this for a while: the
/// caller looks for an orbit first, which Newton's method finds in such a case.
class Creep {
 public:
  /// Takes the closure of the next forcing period, and the largest |x| in it [m].
  void observe(double closure, double amplitude) {
    falls_ = falls_ && closure < previous_;
    previous_ = closure;
    if (++period_ != next_) return;
    next_ *= 2;
    const double before = factor_;
    factor_ = last_ > 0.0 ? closure / last_ : 0.0;
    constexpr double as_before = 0.85;
    constexpr double growing = 1.05;
    constexpr double decaying = 1.4;  // one that falls like 1/n halves; contacts that age take up to a third
    goes_on_ = period_ >= earliest && falls_ && amplitude < growing * amplitude_ &&
               amplitude_ < decaying * amplitude && is_in_band(before) && is_in_band(factor_) &&
               factor_ >= as_before * before;
    last_ = closure;
    amplitude_ = amplitude;
    falls_ = true;
  }

  /// Whether the closure falls like a power of time.
  [[nodiscard]] bool goes_on() const { return goes_on_; }

 private:
  static constexpr long earliest = 32;

  static bool is_in_band(double factor) { return factor >= 0.2 && factor <= 0.7; }

  long period_ = 0;
  long next_ = 1;
  double last_ = 0.0;       ///< closure at the last decision
  double amplitude_ = 0.0;  ///< then
  double previous_ = 0.0;   ///< closure one period ago
  bool falls_ = true;       ///< in each period since the last decision
  double factor_ = 0.0;
  bool goes_on_ = false;
};

}  // namespace dualdamp::sim
