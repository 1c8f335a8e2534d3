#include "sim/motion/event_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"

namespace dualdamp::sim {

namespace {

/// Events before the first forecast: enough for a density, and few beside the most.
constexpr long first_count = 8192;
/// The forecast must exceed the most by this factor.
constexpr double certain = 1.5;
/// Friction may become larger than so far by this factor.
constexpr double stronger = 1.5;
/// Densities of two parts of the motion agree if they differ by less than this factor.
constexpr double alike = 1.5;

}  // namespace

EventForecast::EventForecast(const Model& model, double duration, long most_events)
    : rig_(model.oscillator),
      drive_(model.excitation),
      duration_(duration),
      most_(static_cast<double>(most_events)),
      // Friction that grows with time may end a motion that it lets go today.
      possible_(is_linear(rig_) && std::ranges::none_of(model.friction, &friction::Law::drifts) &&
                rig_.stiffness > 0.0 &&
                (drive_.type == ExcitationType::none || drive_.is_ramp() || drive_.is_harmonic())),
      next_(first_count),
      x_(model.initial.position) {}

void EventForecast::observe(const Sample& now, long count) {
  if (!possible_) return;
  way_ += std::abs(now.x - x_);
  x_ = now.x;
  friction_ = std::max(friction_, std::abs(now.force));
  if (count < next_) return;
  examine(now, count);
  marks_ = {marks_[1], {way_, count}};
  next_ = 2 * count;
}

/// Compares the last two parts; each has as many events as all before it.
void EventForecast::examine(const Sample& now, long count) {
  const auto density = [](const Mark& from, const Mark& to) {
    return to.way > from.way ? static_cast<double>(to.count - from.count) / (to.way - from.way) : 0.0;
  };
  const double before = density(marks_[0], marks_[1]);
  const double last = density(marks_[1], {way_, count});
  if (!(last < alike * before && before < alike * last)) return;
  hopeless_ = static_cast<double>(count) + std::min(before, last) * way_left(now) > certain * most_;
}

double EventForecast::way_left(const Sample& now) const {
  const double left = duration_ - now.t;
  const double k = rig_.stiffness;
  const double c = std::abs(rig_.damping);
  const double held = stronger * friction_;
  if (drive_.is_harmonic()) {
    constexpr double square_wave = 4.0 / std::numbers::pi;  // fundamental of the friction
    const double w = drive_.frequency;
    const double force = drive_.moves_base() ? k * drive_.amplitude : drive_.amplitude;
    const double amplitude = (force - square_wave * held) / (k + c * w + rig_.mass * w * w);
    // The transient of the first periods adds to the way.
    return 2.0 * std::max(0.0, amplitude) * std::floor(2.0 * left * w / core::two_pi);
  }
  const double settled = 10.0 * (std::sqrt(rig_.mass / k) + c / k);
  if (left < settled) return 0.0;
  if (!drive_.is_ramp()) return std::max(0.0, std::abs(now.x) - held / k);
  const double speed = drive_.moves_base() ? std::abs(drive_.slope) : std::abs(drive_.slope) / k;
  const double from = drive_.moves_base() ? now.y : now.external / k;
  const double lag = std::abs(now.x - from) + held / k + speed * settled;
  return std::max(0.0, speed * left - lag);
}

}  // namespace dualdamp::sim
