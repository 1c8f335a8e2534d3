#include "sim/orbits/coexistence.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "sim/batch/batch.hpp"
#include "sim/engine/drive.hpp"

namespace dualdamp::sim {

using friction::Direction;
using Complex = std::complex<double>;

namespace {

State state_at(double x, double v, const Model& model) {
  State state{.x = x, .v = v, .direction = v < 0.0 ? Direction::backward : Direction::forward};
  for (const friction::Law& law : model.friction) state.memories.push_back(law.start({.x = x, .v = v}));
  return state;
}

/// Harmonic balance of an oscillator with a cubic spring, for the elongation x - y of the spring.
class HarmonicBalance {
 public:
  explicit HarmonicBalance(const Model& model) : o_(model.oscillator), omega_(model.excitation.frequency) {
    const Drive drive(o_, model.excitation);
    base_ = model.excitation.moves_base() ? drive.phasor(0) : Complex(0.0);
    const Complex damper = o_.damper_to == DamperTo::base ? Complex(0.0) : Complex(0.0, o_.damping * omega_);
    force_ = model.excitation.moves_base() ? (o_.mass * omega_ * omega_ - damper) * base_ : drive.phasor(0);
    const double slow = 1e-3 * omega_ * driven_displacement(o_, model.excitation);
    for (const friction::Law& law : model.friction) {
      const friction::Memory memory = law.start({});
      if (law.has_memory()) continue;
      friction_ += 0.5 * (law.force(memory, {.v = slow}, Direction::forward) -
                          law.force(memory, {.v = -slow}, Direction::backward));
    }
  }

  /// States at the amplitudes, the largest first, at which the balance holds or nearly holds: near a fold it is not
  /// an exact condition.
  [[nodiscard]] std::vector<State> states(const Model& model) const {
    constexpr int cells = 2000;
    constexpr double nearly = 0.2;
    const double linear = std::abs(force_) / o_.stiffness;
    const double cubic = std::cbrt(std::abs(force_ / o_.cubic_stiffness));
    const double largest = 1e3 * std::min(linear, cubic);
    const double ratio = std::pow(1e-8, 1.0 / cells);
    std::vector<State> list;
    double before = excess(largest);
    double here = excess(largest * ratio);
    for (double amplitude = largest * ratio; amplitude > 1e-8 * largest; amplitude *= ratio) {
      const double after = excess(amplitude * ratio);
      const bool dips = here > 0.0 && here < before && here <= after && here < nearly * std::abs(force_);
      if (here * after < 0.0) list.push_back(at(root(amplitude * ratio, amplitude), model));
      if (dips) list.push_back(at(amplitude, model));
      before = here;
      here = after;
    }
    return list;
  }

 private:
  [[nodiscard]] Complex impedance(double amplitude) const {
    const double stiffness = o_.stiffness + 0.75 * o_.cubic_stiffness * amplitude * amplitude;
    return {(stiffness - o_.mass * omega_ * omega_) * amplitude,
            o_.damping * omega_ * amplitude + 4.0 / std::numbers::pi * friction_};
  }
  [[nodiscard]] double excess(double amplitude) const { return std::abs(impedance(amplitude)) - std::abs(force_); }
  [[nodiscard]] double root(double low, double high) const {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (excess(middle) * excess(high) > 0.0 ? high : low) = middle;
    }
    return low;
  }
  [[nodiscard]] State at(double amplitude, const Model& model) const {
    const Complex x = base_ + amplitude * std::polar(1.0, std::arg(force_) - std::arg(impedance(amplitude)));
    return state_at(x.real(), -omega_ * x.imag(), model);
  }

  Oscillator o_;
  double omega_;
  Complex base_;
  Complex force_;
  double friction_ = 0.0;  ///< N
};

/// A guess for the orbit that never sticks: the one with the static limits lowered to the kinetic ones. For both
/// engines.
std::optional<State> sliding_start(Model model) {
  model.solver.kind = SolverKind::automatic;
  std::optional<OscillatorBatch> batch = batch_of(model, 1);
  if (!batch || batch->static_level == batch->kinetic) return std::nullopt;
  batch->static_level = batch->kinetic;
  const std::optional<SlidingOrbit> orbit = sliding_orbits(*batch).front();
  return orbit ? start_of(*orbit, model) : std::nullopt;
}

}  // namespace

std::vector<Orbit> other_orbits(const Model& model, const Orbit& orbit, std::vector<Orbit> met,
                                OrbitSolver& solver) {
  std::vector<State> guesses;
  if (model.oscillator.cubic_stiffness != 0.0 && model.excitation.amplitude > 0.0) {
    guesses = HarmonicBalance(model).states(model);
    if (guesses.size() < 2) guesses.clear();
  }
  if (const std::optional<State> sliding = sliding_start(model)) guesses.push_back(*sliding);
  for (const State& guess : guesses) {
    if (std::optional<Orbit> found = solver.near_motion_from(guess)) met.push_back(std::move(*found));
  }
  std::vector<Orbit> others;
  for (Orbit& found : met) {
    Orbit candidate = solver.with_shortest_period(std::move(found));
    const auto is_it = [&](const Orbit& known) { return solver.coincide(known, candidate); };
    if (!is_it(orbit) && std::ranges::none_of(others, is_it)) others.push_back(std::move(candidate));
  }
  return others;
}

}  // namespace dualdamp::sim
