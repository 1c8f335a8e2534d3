#pragma once
/// Bias, spread and coverage of every identification method on synthetic records whose truth is known.
///
/// Each method is tested with the first of the `experiments()` that it can use, and with the harder variants of it.
/// All are measurements of Coulomb and viscous friction, which all methods assume. The motion is computed once, and
/// every seed is another reading of it; if the motion itself is random, every seed has its own motion. Coverage is
/// the share of 95 % intervals that hold the truth, over all estimates that have one, usable or not: the usable
/// ones alone would give a biased share. Results do not depend on the number of threads.

#include <string>
#include <vector>

#include "identify/method.hpp"
#include "scenarios/measurements/measure.hpp"

namespace dualdamp::bench {

struct Experiment {
  std::string name;
  std::string meaning;
  sim::Model model;
  scenarios::Measurement measurement;
  /// Sensors for a noise of one metre in x; their noise is proportional to it.
  identify::Sensors sensors;
  std::string variant_of;  ///< name of the experiment whose methods are tested with this one too; empty: no variant
};

[[nodiscard]] const std::vector<Experiment>& experiments();

/// The friction of all experiments.
struct TrueFriction {
  double zeta = 0.0;
  double F0 = 0.0;  ///< N
};
[[nodiscard]] TrueFriction truth();

/// Errors of one parameter over the seeds.
struct ErrorSummary {
  double bias = 0.0;    ///< mean minus truth, relative to the truth
  double spread = 0.0;  ///< standard deviation, likewise
  int intervals = 0;
  int covered = 0;

  [[nodiscard]] double coverage() const { return static_cast<double>(covered) / intervals; }
};

/// One method at one noise.
struct Cell {
  std::string method;
  std::string experiment;
  double noise = 0.0;  ///< standard deviation of a reading of x [m]
  int seeds = 0;
  int estimates = 0;  ///< seeds that gave numbers
  int usable = 0;
  ErrorSummary zeta;
  ErrorSummary F0;
};

/// A cell for each experiment of a method, and each noise, with the seeds 0, 1, ...
[[nodiscard]] std::vector<Cell> accuracy(const std::vector<const identify::MethodEntry*>& methods,
                                         const std::vector<double>& noises, int seeds);

/// Range in which the coverage of 95 % intervals over 1,000 seeds should lie.
inline constexpr double least_coverage = 0.93;
inline constexpr double most_coverage = 0.97;

/// Coverages of the cells whose method gives intervals, zeta and F0 counted separately, and those outside the
/// range.
struct Coverage {
  int claimed = 0;
  std::vector<std::string> outside;  ///< "resonance_deming, one sweep, 20 um, zeta: 91.2 %"
};
[[nodiscard]] Coverage coverage(const std::vector<Cell>& cells);

/// One line of the page's table.
[[nodiscard]] std::string accuracy_row(const Cell& cell);

/// The text of docs/methods/accuracy.md.
[[nodiscard]] std::string accuracy_page(const std::vector<Cell>& cells);

}  // namespace dualdamp::bench
