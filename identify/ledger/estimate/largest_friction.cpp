#include "identify/ledger/estimate/largest_friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/ledger/histories/history_rows.hpp"

namespace dualdamp::identify {

namespace {

double largest_of(const std::vector<double>& signal) {
  double most = 0.0;
  for (const double value : signal) most = std::max(most, std::abs(value));
  return most;
}

/// The largest mean speed over any interval, less what noise may add: the largest speed is no smaller.
double least_top_speed(const std::vector<double>& x, double rate) {
  constexpr double deviations = 6.0;  // of the difference of two readings
  const double noise = deviations * std::numbers::sqrt2 * sensor_noise_of(x);
  double speed = 0.0;
  for (std::size_t lag = 1; lag < x.size(); lag *= 2) {
    double most = 0.0;
    for (std::size_t i = lag; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - x[i - lag]));
    speed = std::max(speed, (most - noise) * rate / static_cast<double>(lag));
  }
  return speed;
}

/// The bounds from parts of a record: the largest, since the others may have moved less.
class Bounds {
 public:
  void add(double force, double speed) {
    if (!(speed > 0.0)) return;
    F0_ = std::max(F0_, force);
    c_ = std::max(c_, force / speed);
  }
  [[nodiscard]] LargestFriction largest() const { return F0_ > 0.0 ? LargestFriction{c_, F0_} : LargestFriction{}; }

 private:
  double c_ = 0.0;
  double F0_ = 0.0;
};

void add_history(const History& history, const KnownConstants& constants, Bounds& bounds) {
  if (history.x.empty()) return;
  const auto [low, high] = std::ranges::minmax(history.x);
  const double speed = least_top_speed(history.x, history.sample_rate);
  bounds.add(constants.stiffness * (largest_of(history.x) + largest_of(history.y)) + largest_of(history.force) +
                 constants.mass * speed * speed / (high - low),
             speed);
}

void add_pairs(const std::vector<Pair>& pairs, const KnownConstants& constants, Bounds& bounds) {
  for (const Pair& pair : pairs)
    bounds.add(constants.stiffness * (pair.x + pair.Y),
               4.0 * pair.x * frequency_of(pair, constants) / core::two_pi);
}

/// A half swing of a damped mass lasts longer than one without damping.
void add_extremes(const DecayRecord& decay, const KnownConstants& constants, Bounds& bounds) {
  const std::vector<double>& x = decay.extremes;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double duration =
        decay.times.empty() ? core::two_pi / constants.natural_frequency() : decay.times[i] - decay.times[i - 1];
    bounds.add(constants.stiffness * std::max(std::abs(x[i]), std::abs(x[i - 1])),
               std::abs(x[i] - x[i - 1]) / duration);
  }
}

}  // namespace

LargestFriction largest_friction(const Record& record, const KnownConstants& constants) {
  Bounds bounds;
  if (std::isnan(constants.stiffness) || std::isnan(constants.mass)) return {};
  for (const History& history : record.histories) add_history(history, constants, bounds);
  if (record.histories.empty() && record.pairs) add_pairs(record.pairs->pairs, constants, bounds);
  if (record.histories.empty() && record.decay) add_extremes(*record.decay, constants, bounds);
  return bounds.largest();
}

std::string beyond_motion(const Estimate& estimate, const LargestFriction& largest, core::Coordinate coordinate) {
  constexpr int digits = 2;
  const auto reach = [&](const char* name, double value, std::optional<Interval> interval, double most,
                         const char* unit) {
    const double end = std::max(value, interval ? (*interval)[1] : value);
    if (!(end > most)) return std::string();
    const std::string in_unit = " " + core::unit_for(coordinate, unit);
    return std::string(name) + " reaches to " + core::format_number(end, digits) + in_unit +
           ", and with more than " + core::format_number(most, digits) + in_unit +
           " the mass could not move as recorded: these data do not determine it";
  };
  const auto& at = estimate.interval95;
  std::string text = reach("F0", estimate.value.F0, at ? std::optional(at->F0) : std::nullopt, largest.F0, "N");
  if (text.empty())
    text = reach("c", estimate.value.c, at ? std::optional(at->c) : std::nullopt, largest.c, "N.s/m");
  return text;
}

}  // namespace dualdamp::identify
