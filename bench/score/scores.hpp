#pragma once
/// Scores of a stress test: metrics of each method in each cell, in each family of departures, and over all.
///
/// A cell is a departure at one severity, a range and a set of sensors; its cases differ by rig and noise. A
/// family's metric is the mean over its departures of the means over their cells; the metric over all is the mean
/// over families. So a family counts once, however many departures it has. The area of selective risk is that of
/// all cases together, with the same weights. Standard errors: `resample.hpp`. A method ranks before another only
/// where the difference of their interval scores exceeds twice its standard error.

#include <cstddef>
#include <string>
#include <vector>

#include "bench/grid.hpp"
#include "bench/prediction.hpp"
#include "bench/score/metrics.hpp"

namespace dualdamp::bench {

/// Metrics with their standard errors.
struct Scored {
  Metrics value;
  Metrics se;
};

/// One method in one cell.
struct CellScore : Scored {
  std::size_t cell = 0;
  std::size_t entrant = 0;
  int cases = 0;
  int estimates = 0;                                      ///< cases with a number
  double zeta_bias = not_stated, F0_bias = not_stated;    ///< mean relative error
  double zeta_error = not_stated, F0_error = not_stated;  ///< median of its modulus
  double distance = not_stated, harm = not_stated;        ///< means over the rigs
};

/// One method in one family.
struct FamilyScore : Scored {
  Family family = Family::none;
  std::size_t entrant = 0;
};

/// One method over all families.
struct Rank : Scored {
  std::size_t entrant = 0;
  double interval_score = not_stated, interval_score_se = not_stated;
  int from = 1;  ///< 1 + methods that are better by more than twice the standard error
  int to = 1;    ///< methods that are not worse by more
};

/// The difference of two methods.
struct Difference {
  std::size_t better = 0, worse = 0;
  double value = 0.0, se = 0.0;
  bool is_significant = false;
};

/// One method over the cases whose distance, or harm, lies in one interval. Distance and harm can be compared
/// between departures, severities cannot. The truth is not among the cases.
struct ConsequenceScore : Scored {
  std::size_t entrant = 0;
  std::string axis;                    ///< distance or harm
  double from = 0.0, to = not_stated;  ///< NaN: open
  int departures = 0;                  ///< those that have such cases
  int cases = 0;
};

struct Scores {
  std::vector<CellScore> cells;       ///< by cell, method
  std::vector<FamilyScore> families;  ///< by family, method
  std::vector<Rank> ranking;          ///< best first
  std::vector<Difference> differences;
  std::vector<ConsequenceScore> by_consequence;  ///< by axis, interval, method; those with cases
  std::size_t failed_cases = 0;                  ///< without an estimate by any method
};

/// The consequence of a departure on one rig with one set of sensors (bench/consequence.hpp).
struct CaseConsequence {
  double distance = not_stated, harm = not_stated, harm_zeta = not_stated, harm_F0 = not_stated;
  double attainable_power = not_stated;
  double cramer_rao_zeta = not_stated, cramer_rao_F0 = not_stated;
  UnmeasuredAmplitudes unmeasured = {not_stated, not_stated};
};

/// The scores of all answers to a stress test. Memory: 40 bytes an estimate.
struct MarkedCases {
  std::vector<std::vector<Mark>> marks;       ///< by entrant, case
  std::vector<CaseConsequence> consequences;  ///< by motion, sensors
  std::size_t failed_cases = 0;
};

/// Reads `cases.jsonl` in order, and the entries of the question. Errors: `core::InputError` for a file that is not
/// complete.
[[nodiscard]] MarkedCases read_cases(const std::string& path, const Grid& grid);

[[nodiscard]] Scores score(const MarkedCases& cases, const Grid& grid);

}  // namespace dualdamp::bench
