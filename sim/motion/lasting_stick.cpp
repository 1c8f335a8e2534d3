#include "sim/motion/lasting_stick.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;

/// A change of forces by this part of the static limits is none.
constexpr double negligible = 1e-9;
/// A swing has died out if it changes the forces by this part of what would release the mass, in this part of a
/// natural period. A swing that could still release it would then last for thousands of natural periods.
constexpr double died_out = 1e-4;
constexpr double part_of_period = 0.1;

/// One law while the mass is held.
class HeldLaw {
 public:
  /// `limit`: of all laws [N]; `margin`: what is missing for a release [N]; `period`: the natural period [s].
  HeldLaw(const Law& law, const Memory& memory, const Instant& now, double limit, double margin, double period)
      : law_(law),
        memory_(memory),
        now_(now),
        tolerance_(negligible * limit),
        small_(std::max(tolerance_, died_out * margin)),
        period_(period),
        force_(law.force(memory, now, Direction::none)),
        limit_(law.static_limit(memory, now)) {}

  [[nodiscard]] bool stays(double held) const {
    if (std::isfinite(law_.next_change(memory_)) || law_.delay() > held) return false;
    // Between changes of mode limits are linear in time, and the terms of an affine law exponential.
    for (const double part : {0.01, 1.0, 100.0}) {
      Instant later = now_;
      later.t += part * period_;
      Memory memory = memory_;
      if (law_.advances()) law_.advance(memory, now_, later, part * period_, Direction::none);
      if (!is_as_strong(memory, later, tolerance_)) return false;
    }
    return !law_.has_rates() || has_settled() || relaxes();
  }

 private:
  [[nodiscard]] bool is_as_strong(const Memory& memory, const Instant& at, double tolerance) const {
    return std::abs(law_.force(memory, at, Direction::none) - force_) <= tolerance &&
           law_.static_limit(memory, at) >= limit_ - tolerance;
  }

  [[nodiscard]] std::vector<double> rates(const Memory& memory) const {
    std::vector<double> rates(memory.state.size());
    law_.rates(memory, now_, Direction::none, rates);
    return rates;
  }

  /// At a turning point of a swing its velocity is zero, so the second step is needed: it shows the acceleration.
  [[nodiscard]] bool has_settled() const {
    Memory memory = memory_;
    for (int step = 0; step < 2; ++step) {
      const std::vector<double> rate = rates(memory);
      for (std::size_t k = 0; k < rate.size(); ++k) memory.state[k] += part_of_period * period_ * rate[k];
      if (!is_as_strong(memory, now_, small_)) return false;
    }
    return true;
  }

  /// Whether each state moves by itself towards where it stays, at a rate that is linear in it, and nothing is
  /// weaker on the way.
  [[nodiscard]] bool relaxes() const {
    const std::vector<double> rate = rates(memory_);
    std::vector<double> way(rate.size());
    for (std::size_t k = 0; k < rate.size(); ++k) {
      if (rate[k] == 0.0) continue;
      Memory moved = memory_;
      const double step = 1e-3 * period_ * rate[k];
      moved.state[k] += step;
      std::vector<double> then = rates(moved);
      if (!((then[k] - rate[k]) * step < 0.0)) return false;
      way[k] = step * rate[k] / (rate[k] - then[k]);
      then[k] = rate[k];
      if (then != rate) return false;
    }
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
      Memory later = memory_;
      for (std::size_t k = 0; k < way.size(); ++k) later.state[k] += part * way[k];
      if (!is_as_strong(later, now_, tolerance_)) return false;
    }
    return true;
  }

  const Law& law_;
  const Memory& memory_;
  const Instant& now_;
  double tolerance_;  ///< N
  double small_;      ///< N
  double period_;     ///< s
  double force_;
  double limit_;
};

}  // namespace

bool sticks_for_good(const Model& model, const Engine& engine, double held) {
  if (engine.direction() != Direction::none) return false;
  const State state = engine.state();
  const Instant now{.t = engine.time(), .x = state.x};
  double limit = 0.0;
  double pull = spring_force(model.oscillator, -state.x);
  for (std::size_t i = 0; i < model.friction.size(); ++i) {
    limit += model.friction[i].static_limit(state.memories[i], now);
    pull -= model.friction[i].force(state.memories[i], now, Direction::none);
  }
  const double period = 2.0 * std::numbers::pi / natural_frequency(model.oscillator);
  for (std::size_t i = 0; i < model.friction.size(); ++i) {
    const HeldLaw law(model.friction[i], state.memories[i], now, limit, limit - std::abs(pull), period);
    if (!law.stays(held)) return false;
  }
  return true;
}

}  // namespace dualdamp::sim
