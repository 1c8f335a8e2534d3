#pragma once
/// Steady states: the periodic orbit approached from the model's initial state.

#include <complex>
#include <string>
#include <vector>

#include "core/outcome.hpp"
#include "core/search_result.hpp"
#include "sim/engine/interval.hpp"
#include "sim/engine/state.hpp"
#include "sim/model.hpp"
#include "sim/motion/energy.hpp"

namespace dualdamp::sim {

struct Stick {
  double start = 0.0;     ///< s, modulo one forcing period
  double duration = 0.0;  ///< s
  double position = 0.0;  ///< m
};

struct SteadyState {
  core::Outcome outcome;              ///< when not ok() the numbers below mean nothing
  std::vector<std::string> warnings;  ///< e.g. other orbits exist

  double peak = 0.0;               ///< max x [m]
  double trough = 0.0;             ///< min x [m]
  double amplitude = 0.0;          ///< (peak - trough)/2 [m]
  double phase = 0.0;              ///< lag of x's fundamental behind the excitation's [rad], in [0, 2 pi)
  double fundamental = 0.0;        ///< amplitude of x's fundamental [m]
  double period = 0.0;             ///< s
  double max_speed = 0.0;          ///< m/s
  double mean_square_speed = 0.0;  ///< m^2/s^2
  int stops_per_cycle = 0;         ///< stops per forcing period
  std::vector<Stick> sticks;
  std::vector<EventKind> sequence;                ///< events of one period in order
  std::vector<std::complex<double>> multipliers;  ///< Floquet multipliers of the full period
  Energy energy;                                  ///< J per period

  State start;  ///< of the orbit, at t = 0
  int newton_steps = 0;
  int transient_periods = 0;
  core::SearchCount certificate;  ///< of all searches for events on the way to the orbit and on it

  /// No Floquet multiplier outside the unit circle; one on it is a mass that never moves, or a continuum (see
  /// `warnings`).
  [[nodiscard]] bool stable() const;
};

/// Floquet multipliers this close to the unit circle do not attract within any laboratory's patience; and Newton's
/// method meets them at the end of a continuum, whose double root it knows to half the digits only.
inline constexpr double neutral_margin = 1e-6;

struct SteadyStateOptions {
  double tolerance = 1e-14;  ///< closure of the orbit relative to its size
  int max_periods = 20'000;  ///< of transient integrated before giving up
  /// Phase, fundamental, speeds and energy cost more than the orbit itself; without this they stay zero.
  bool full_account = true;
};

/// Needs a harmonic excitation.
[[nodiscard]] SteadyState steady_state(const Model& model, const SteadyStateOptions& options = {});

/// One period of a steady state: `count` + 1 samples equally spaced in time, both ends included.
[[nodiscard]] std::vector<Sample> one_period(const Model& model, const SteadyState& state, int count);

}  // namespace dualdamp::sim
