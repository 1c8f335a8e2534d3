#pragma once
/// What to measure next: by how much each of some measurements would narrow the ranges over laws, and whether it
/// would tell apart the laws that a record allows.
///
/// Each law that the record allows is taken as the truth, at its most probable severity. Its readings of a
/// candidate, with noise, continue the record (continued_record.hpp), and any_law's own rules answer to both
/// together: hull, average, and which of the other laws are rejected. The advice is the mean over the truths. The
/// noise has a fixed seed.
///
/// Cost: some seconds for eight states.

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

/// What a measurement would do if this law is the true one.
struct LawOutcome {
  std::string law;
  Shrinkage hull;
};

struct MeasurementAdvice {
  CandidateMeasurement candidate;
  Shrinkage hull;                      ///< expected width of the hull: the mean of the outcomes
  std::vector<LawOutcome> outcomes{};  ///< of each law that the record allows
  Shrinkage average;                   ///< expected standard deviation of the average over laws
  double power =
      0.0;  ///< mean share of the wrong laws which the record allows that are rejected; NaN: there is none
  std::string text;
};

struct Design {
  LawIntervals now;
  std::vector<MeasurementAdvice> advice;  ///< the best first: by the hull of zeta and F0 together
  std::vector<std::string> left_out{};    ///< names of measurements that the drive cannot do
};

/// The advice after a record of steady states, or why there is none. `moved`: standard deviations of zeta and F0 by
/// uncertain constants. They stay the same after each candidate, because none of them measures a constant. The
/// order of the states has no effect. `limits`: of the drive.
[[nodiscard]] std::variant<Design, std::string> design_after(
    const Record& measured, const KnownConstants& constants, const KnownDeviations& known,
    const LawIntervalOptions& options, const ParameterSet& moved = {}, const DriveLimits& limits = {});

}  // namespace dualdamp::identify
