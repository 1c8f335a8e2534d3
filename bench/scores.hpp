#pragma once
/// Scores of a stress test: how wrong each method is under each law, and whether its diagnostics say so.
///
/// Per law, severity, range, sensors and method, over the seeds, with errors relative to the truth:
///
///   bias = mean error, spread = standard deviation, coverage = share of 95 % intervals that hold the truth,
///   wrong = share of estimates off by more than 5 % in zeta or F0, or absent,
///   knew = share of the wrong ones with a diagnostic: not usable, or its lack-of-fit test fired, or absent,
///   false_alarm = share of the right ones with a diagnostic.
///
/// A missed detection is a wrong estimate without a diagnostic.
///
/// Ranking: a right estimate without a diagnostic helps, a missed detection harms. A method that has a diagnostic
/// against every estimate does neither, and is worth nothing.
///
/// Breakdown: the severity at which the median |error| first exceeds 5 or 20 %, between two severities of the grid
/// by a straight line in the logarithms.

#include <string>
#include <vector>

#include "bench/grid.hpp"

namespace dualdamp::bench {

struct ParameterScore {
  double bias = 0.0;
  double spread = 0.0;
  double median_error = 0.0;  ///< of |error|
  double coverage = 0.0;      ///< NaN where there are no intervals
};

/// One method on one motion seen by one set of sensors.
struct Score {
  std::size_t motion = 0;
  std::size_t sensors = 0;
  std::size_t method = 0;
  int cases = 0;
  int estimates = 0;  ///< cases with a number
  ParameterScore zeta, F0;
  double wrong = 0.0;
  double knew = 0.0;         ///< NaN where none is wrong
  double false_alarm = 0.0;  ///< NaN where all are wrong
};

/// A law and a method, over all severities of one range and one set of sensors.
struct Breakdown {
  std::string law;
  std::size_t range = 0;
  std::size_t sensors = 0;
  std::size_t method = 0;
  double zeta_5 = 0.0, zeta_20 = 0.0, F0_5 = 0.0, F0_20 = 0.0;  ///< severities; infinite: never on the grid
  double wrong = 0.0;                                           ///< share of all its cases
  double knew = 0.0;                                            ///< of the wrong ones
};

/// One method over all laws.
struct Ranking {
  std::size_t method = 0;
  double wrong = 0.0;
  double knew = 0.0;
  double false_alarm = 0.0;  ///< where friction is Coulomb + viscous
  double coverage = 0.0;     ///< of F0, likewise
  double trusted = 0.0;      ///< share of all cases that are right, without a diagnostic
  double unwarned = 0.0;     ///< share of all cases that are missed detections
  double worth = 0.0;        ///< trusted less unwarned: what the ranking goes by
};

struct Scores {
  std::vector<Score> scores;          ///< by motion, sensors, method
  std::vector<Breakdown> breakdowns;  ///< by law, range, sensors, method
  std::vector<Ranking> ranking;       ///< best first
  std::size_t failed_cases = 0;       ///< without an estimate by any method
};

/// Reads `cases.jsonl` in order; memory is that of the scores.
[[nodiscard]] Scores score(const std::string& path, const Grid& grid, double zeta, double F0);

}  // namespace dualdamp::bench
