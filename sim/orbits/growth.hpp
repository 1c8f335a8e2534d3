#pragma once
/// Distinguishes growth without end from growth that slows down and from beats.
///
/// It decides after 500, 1000, 2000, ... periods. An amplitude grows without end if it gained 1.7 times as much
/// over the last doubling of time, n to 2 n, as over the doubling before; growth in proportion to time gains 2
/// times as much. An amplitude that tends to a limit as 1 - exp(-n/tau) or as tanh(n/tau) gains 1.7 times as much
/// only for n below tau/4.5 or tau/3.4, and would then not settle within 20,000 periods. A beating amplitude has
/// been larger before.

#include <algorithm>

namespace dualdamp::sim {

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
    if (period != next_) return;
    next_ *= 2;
    constexpr double gained_more = 1.7;
    constexpr double beating = 0.9;
    constexpr double at_least = 0.1;  // of the amplitude; growth in proportion to time gains 1/2
    const double gain = amplitude < beating * largest_ ? 0.0 : amplitude - last_;
    goes_on_ = gain_ > 0.0 && gain > gained_more * gain_ && gain > at_least * amplitude;
    gain_ = last_ > 0.0 ? gain : 0.0;
    last_ = amplitude;
  }

  /// `periods`: largest number of periods.
  explicit Growth(int periods) : half_(periods / 2) {}

  /// Whether growth does not slow down, or the amplitude is beyond all bounds.
  [[nodiscard]] bool is_endless() const { return goes_on_ || runs_away_; }
  /// Whether the motion grew up to the end.
  [[nodiscard]] bool has_grown() const {
    return is_endless() || second_half_ > 1.5 * first_half_ || last_seen_ > 1.5 * first_half_;
  }

 private:
  /// An amplitude that is this many times that of the first period is beyond all bounds.
  static constexpr double runaway = 1e9;

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
};

}  // namespace dualdamp::sim
