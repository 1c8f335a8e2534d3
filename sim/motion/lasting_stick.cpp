#include "sim/motion/lasting_stick.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "sim/engine/eigenvalues.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;

/// A change of forces by this part of the static limits is none.
constexpr double negligible = 1e-9;
/// A swing has died out if it changes the forces and the limits by at most this part of what would release the
/// mass.
constexpr double died_out = 1e-4;

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
    return !law_.has_rates() || states_stay();
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

  /// The derivative of the rates by the states.
  [[nodiscard]] Eigen::MatrixXd jacobian(const std::vector<double>& rate) const {
    constexpr double part = 1e-6;
    const auto n = static_cast<Eigen::Index>(rate.size());
    std::vector<double> scales(rate.size());
    law_.scales(memory_, scales);
    Eigen::MatrixXd result(n, n);
    for (std::size_t k = 0; k < rate.size(); ++k) {
      // The size of a position or a velocity is that of the motion. Rates are linear in it: any step will do.
      const bool has_size = scales[k] > 0.0 && std::isfinite(scales[k]);
      const double size = has_size ? scales[k] : std::max(std::abs(memory_.state[k]), period_ * std::abs(rate[k]));
      const double step = part * (size > 0.0 ? size : 1.0);
      Memory moved = memory_;
      moved.state[k] += step;
      const std::vector<double> then = rates(moved);
      for (std::size_t i = 0; i < rate.size(); ++i)
        result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            (then[i] - rate[i]) / (moved.state[k] - memory_.state[k]);
    }
    return result;
  }

  /// Whether the states move by themselves towards where they stay, and nothing is weaker on the way. A mode that
  /// swings must have died out: the force limit that it changes may be at its largest now.
  [[nodiscard]] bool states_stay() const {
    constexpr double no_growth = 1e-9;  // of a swing that nothing damps
    std::vector<double> rate = rates(memory_);
    const std::optional<Modes> modes = modes_of(
        jacobian(rate), Eigen::Map<const Eigen::VectorXd>(rate.data(), static_cast<Eigen::Index>(rate.size())));
    if (!modes) return false;
    const double fastest = modes->exponents.cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < modes->exponents.size(); ++k) {
      const std::complex<double> exponent = modes->exponents[k];
      if (std::abs(exponent) <= negligible * fastest) continue;  // it stands
      if (exponent.real() > no_growth * std::abs(exponent)) return false;
      const Eigen::VectorXcd way = modes->ways.col(k);
      if (!(exponent.imag() == 0.0 ? leads_to_strength(way.real()) : has_died_out(way.cwiseAbs()))) return false;
    }
    return true;
  }

  /// Calls `holds` with the memory at places on the way of the states; whether it holds at all of them.
  [[nodiscard]] bool all_along(const Eigen::VectorXd& way, const auto& holds) const {
    return std::ranges::all_of(std::array{0.25, 0.5, 0.75, 1.0}, [&](double part) {
      Memory moved = memory_;
      for (std::size_t k = 0; k < moved.state.size(); ++k)
        moved.state[k] += part * way[static_cast<Eigen::Index>(k)];
      return holds(moved);
    });
  }

  [[nodiscard]] bool leads_to_strength(const Eigen::VectorXd& way) const {
    return all_along(way, [&](const Memory& moved) { return is_as_strong(moved, now_, small_); });
  }

  /// `swing`: from the mean; a pair of modes swings by twice that, and from one end to the other. A limit that
  /// grows towards one end falls towards the other.
  [[nodiscard]] bool has_died_out(const Eigen::VectorXd& swing) const {
    const auto is_same = [&](const Memory& moved) {
      return is_as_strong(moved, now_, small_) && law_.static_limit(moved, now_) <= limit_ + small_;
    };
    for (Eigen::Index i = 0; i < swing.size(); ++i) {
      const Eigen::VectorXd way = 4.0 * swing[i] * Eigen::VectorXd::Unit(swing.size(), i);
      if (!all_along(way, is_same) || !all_along(-way, is_same)) return false;
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

bool rests_for_good(const Model& model, const Engine& engine, double held) {
  const bool is_held = engine.direction() == Direction::none;
  if (!is_held && engine.velocity() != 0.0) return false;
  const State state = engine.state();
  const Instant now{.t = engine.time(), .x = state.x};
  double limit = 0.0;
  double pull = spring_force(model.oscillator, -state.x);
  for (std::size_t i = 0; i < model.friction.size(); ++i) {
    limit += model.friction[i].static_limit(state.memories[i], now);
    pull -= model.friction[i].force(state.memories[i], now, Direction::none);
  }
  // Where no law can hold the mass, the smooth engine counts it as slipping.
  if (!is_held && (limit > 0.0 || pull != 0.0)) return false;
  const double period = natural_period(model.oscillator);
  for (std::size_t i = 0; i < model.friction.size(); ++i) {
    const HeldLaw law(model.friction[i], state.memories[i], now, limit, limit - std::abs(pull), period);
    if (!law.stays(held)) return false;
  }
  return true;
}

}  // namespace dualdamp::sim
