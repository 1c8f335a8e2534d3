#pragma once
/// The data of a motion for a comparison: its events, equally spaced samples, its energy account.

#include <limits>
#include <string>
#include <vector>

#include "core/outcome.hpp"
#include "sim/motion/simulate.hpp"

namespace dualdamp::crosscheck {

struct WalkOptions {
  double duration = 0.0;                                   ///< s
  double until = std::numeric_limits<double>::infinity();  ///< no sample after this time is needed [s]
  /// A walk that takes more work (`sim::Engine::work`) ends early. So a stiff motion has a bounded cost, and ends
  /// at the same time on every machine.
  long most_work = 150'000;
  bool with_energy = false;
};

/// Samples of a whole walk, the first one at t = 0 left out.
inline constexpr int walk_samples = 200;

/// A part of an interval.
struct Piece {
  double end = 0.0;    ///< s
  double speed = 0.0;  ///< the largest |v| at its start, middle and end [m/s]
};

struct Walk {
  core::Outcome outcome;
  bool ended_early = false;  ///< by `most_work`
  double end = 0.0;          ///< where it ends [s]
  std::vector<sim::Event> events;
  std::vector<sim::Sample> samples;  ///< at duration/walk_samples, ...
  std::vector<Piece> pieces;         ///< without gaps from t = 0 on
  sim::Energy energy;
  double energy_scale = 0.0;  ///< sum of the moduli of all that was exchanged [J]
  double drive_energy = 0.0;  ///< what the largest force of the drive would store in the spring [J]
  bool finite = true;         ///< every event and sample is
  double slowest = 0.0;       ///< resolution of speeds over the size of x [1/s]; 0: rounding
};

/// Whether |v| <= `speed` in all pieces between the two times.
[[nodiscard]] bool is_slow(const Walk& walk, double from, double to, double speed);

/// The way of the mass between the two times, at the largest speed of each piece [m]; infinite beyond the last
/// piece.
[[nodiscard]] double way(const Walk& walk, double from, double to);

/// What is wrong with the order of the events: the mass stops or turns while it is held, or is released while it
/// slips. Empty: nothing. At the start it may be held.
[[nodiscard]] std::string fault_of_sticks(const std::vector<sim::Event>& events);

[[nodiscard]] Walk walk(const sim::Model& model, const WalkOptions& options);

}  // namespace dualdamp::crosscheck
