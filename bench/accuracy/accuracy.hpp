#pragma once
/// Bias, spread and coverage of every identification method on synthetic records whose truth is known.
///
/// Each method meets the first of the `experiments()` that it can use, a measurement of Coulomb and viscous
/// friction, which all of them assume, and the harder variants of that one. The motion is computed once, and every
/// seed is another reading of it; where the motion itself is random every seed has its own. Coverage counts the 95
/// % intervals that hold the truth, of all estimates that have one, whether usable or not: a count of the usable
/// ones alone would be biased. Results do not depend on the number of threads.

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
  /// For a noise of one metre in x: readings are linear in it.
  identify::Sensors sensors;
  std::string variant_of;  ///< name of the experiment whose methods meet this one too; empty: one in its own right
};

[[nodiscard]] const std::vector<Experiment>& experiments();

/// The friction of all of them.
struct TrueFriction {
  double zeta = 0.0;
  double F0 = 0.0;  ///< N
};
[[nodiscard]] TrueFriction truth();

/// What the seeds made of one parameter.
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
  int estimates = 0;  ///< of them gave numbers
  int usable = 0;
  ErrorSummary zeta;
  ErrorSummary F0;
};

/// Seeds 0, 1, ... A cell for each experiment that the method meets, and each noise.
[[nodiscard]] std::vector<Cell> accuracy(const std::vector<const identify::MethodEntry*>& methods,
                                         const std::vector<double>& noises, int seeds);

/// Share in which 1,000 seeds of a 95 % interval should lie.
inline constexpr double least_coverage = 0.93;
inline constexpr double most_coverage = 0.97;

/// Coverages of the cells whose method gives intervals, of zeta and F0 together, and those that lie outside.
struct Coverage {
  int claimed = 0;
  std::vector<std::string> outside;  ///< "resonance_deming, one sweep, 20 um, zeta: 91.2 %"
};
[[nodiscard]] Coverage coverage(const std::vector<Cell>& cells);

/// One line of the page's table.
[[nodiscard]] std::string accuracy_row(const Cell& cell);

/// docs/methods/accuracy.md
[[nodiscard]] std::string accuracy_page(const std::vector<Cell>& cells);

}  // namespace dualdamp::bench
