#pragma once
/// Steady states: the periodic orbit that the motion from the model's initial state, or from another state,
/// approaches. Its period is the forcing period or up to 64 of them (subharmonic motion).

#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "core/outcome.hpp"
#include "sim/engine/interval.hpp"
#include "sim/engine/state.hpp"
#include "sim/model.hpp"
#include "sim/motion/energy.hpp"

namespace dualdamp::sim {

struct Stick {
  double start = 0.0;     ///< s, modulo one period
  double duration = 0.0;  ///< s
  double position = 0.0;  ///< m
};

/// Another steady state of the same model.
struct OtherState {
  double peak = 0.0;     ///< max x [m]
  double trough = 0.0;   ///< min x [m]
  int period_ratio = 1;  ///< forcing periods in its period

  [[nodiscard]] bool never_moves() const { return peak == trough; }
};

struct SteadyState {
  core::Outcome outcome;              ///< if not ok(), the numbers below mean nothing
  std::vector<std::string> warnings;  ///< e.g. other orbits exist

  double peak = 0.0;       ///< max x [m]
  double trough = 0.0;     ///< min x [m]
  double amplitude = 0.0;  ///< (peak - trough)/2 [m]
  double phase = 0.0;  ///< lag of x's fundamental behind the excitation's [rad], in [0, 2 pi); NaN: one has none
  double fundamental = 0.0;        ///< amplitude of x's fundamental [m]
  double period = 0.0;             ///< of the motion [s]
  int period_ratio = 1;            ///< forcing periods in it
  double max_speed = 0.0;          ///< m/s
  double mean_square_speed = 0.0;  ///< m^2/s^2
  int stops_per_cycle = 0;         ///< stops in one period
  std::vector<Stick> sticks;
  int stick_count = 0;              ///< of `sticks`; by speed if `sticks_by_speed` is set and no law holds the mass
  std::vector<EventKind> sequence;  ///< events of one period in order
  std::vector<std::complex<double>> multipliers;  ///< Floquet multipliers over one period
  Energy energy;                                  ///< J in one period

  /// Steady states that attract other motions, as far as `coexistence.hpp` finds them; their period may begin in
  /// any forcing period. An empty list proves nothing.
  std::vector<OtherState> others;

  State start;  ///< of the orbit, at t = 0
  int newton_steps = 0;
  int transient_periods = 0;
  core::SearchCount certificate;  ///< of all searches for events on the way to the orbit and on it
  long work = 0;                  ///< `Engine::work` of all motions that were computed for it

  /// Whether the mass stands still all the time. Slips below rounding are no motion (orbit_account.cpp).
  [[nodiscard]] bool never_moves() const { return peak == trough; }
  /// Whether no Floquet multiplier is outside the unit circle. One on the circle belongs to a mass that never
  /// moves, or to a continuum of orbits (see `warnings`).
  [[nodiscard]] bool stable() const;
};

/// What is computed along an orbit. Each costs more than the one before; what is left out stays zero.
enum class OrbitDetail {
  extremes,  ///< of x, stops and sticks
  phase,     ///< and the fundamental
  full,      ///< speeds and energy too, which cost more than the orbit itself
};

struct SteadyStateOptions {
  double tolerance = 1e-14;  ///< closure of the orbit relative to its size
  int max_periods = 20'000;  ///< of transient integrated before giving up
  /// Work (`Engine::work`) of the motion before giving up, if less than that of `patience_with`; attempts to find
  /// an orbit near the motion may take as much again.
  long most_work = std::numeric_limits<long>::max();
  OrbitDetail detail = OrbitDetail::full;
  /// Whether to look for other steady states of the model, which costs several times the orbit itself where motions
  /// may part; else `others` is empty, and no warning tells of them.
  bool others = true;
  /// If no law holds the mass (smooth laws, compliant contacts), the mass never quite sticks. With this a stick
  /// is a time longer than `shortest_stick` of a forcing period at a speed below `stick_speed` times the largest.
  bool sticks_by_speed = false;
  /// The state at t = 0 with the memories of the laws: the `start` of a steady state of a model with the same laws.
  /// Nothing: the model's initial state, with the laws at their start.
  std::optional<State> from = {};
};

inline constexpr double stick_speed = 1e-3;
inline constexpr double shortest_stick = 0.02;

/// The steady state of the model. Needs a harmonic excitation.
[[nodiscard]] SteadyState steady_state(const Model& model, const SteadyStateOptions& options = {});

/// One period of a steady state: `count` + 1 samples equally spaced in time, both ends included.
[[nodiscard]] std::vector<Sample> one_period(const Model& model, const SteadyState& state, int count);

}  // namespace dualdamp::sim
