#pragma once
/// What to measure next: by how much each of some measurements would narrow the ranges over laws, and whether it
/// would tell apart the laws that a record allows.
///
/// Each law that the record allows is taken as the truth once, at its best fit, with its weight in the average over
/// laws. The measurement would give readings y; law i at severity s, fitted to the record with covariance C,
/// predicts y_i with slopes J. After the measurement
///
///   chi2_i(s) grows by (y - y_i)' (S + J C J')^-1 (y - y_i),   C becomes (C^-1 + J' S^-1 J)^-1
///
/// with the variances S of the readings: linear in the unknowns, exact in the severity. The hull, the average and
/// the power follow from these. The power is the mean over pairs of laws of that of a test of level 5 % of law i
/// against the truth j, a noncentral chi square with one degree of freedom (hunter1965, box1967). Nothing random is
/// drawn.
///
/// Cost: readings of each allowed law at its severities within reach, and their slopes; some seconds a candidate.

#include <string>
#include <variant>
#include <vector>

#include "identify/design/candidate.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Width of a range after a measurement over its width before; smaller is better.
struct Shrinkage {
  double zeta = 1.0;
  double F0 = 1.0;
};

struct Advice {
  CandidateMeasurement candidate;
  Shrinkage hull;      ///< expected width of the hull
  Shrinkage average;   ///< expected standard deviation of the average over laws
  double power = 0.0;  ///< mean probability to reject a wrong law that the record allows
  std::string text;
};

struct Design {
  LawIntervals now;
  double power_now = 0.0;
  std::vector<Advice> advice;  ///< the best first: by the hull of zeta and F0 together
};

/// The advice after a record of steady states, or why there is none. `moved`: standard deviations of zeta and F0 by
/// uncertain constants. They stay the same after each candidate, because none of them measures a constant.
[[nodiscard]] std::variant<Design, std::string> design_after(const Record& record, const KnownConstants& constants,
                                                             const KnownDeviations& known,
                                                             const LawIntervalOptions& options,
                                                             const ParameterSet& moved = {});

}  // namespace dualdamp::identify
