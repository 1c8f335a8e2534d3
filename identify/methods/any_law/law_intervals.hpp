#pragma once
/// zeta and F0 of a record when the friction law is unknown: every law of the library is fitted over its severity,
/// and two ranges follow.
///
///   hull      the union of the 95 % regions of all laws that the record does not reject at 5 %
///   average   the 2.5 and 97.5 % points of the mixture of the same laws, all with the same weight; within a law,
///             severities are weighted by their likelihood and by a prior of standard deviation
///             `severity_deviation` about zero
///
/// No law is exactly that of the rig: beside the noise, each has an error of `law_error` times the effect of the
/// departure on the readings. Plain friction has no such error, nor has a law whose chi2 is more than half that of
/// plain friction.
/// zeta and F0 of a law are those of the Coulomb + viscous friction that it departs from
/// (identify/departures/departures.hpp): what remains as its severity goes to zero. If every law is rejected, the
/// noise is raised until the best one is not, and `inflation` states the factor (birge1932). Source:
/// brynjarsdottir2014, pasquier2015. Docs: docs/methods/any_law.md. Cost: one record of eight states with phases
/// takes seconds; laws are shared out to all cores.

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/methods/any_law/library.hpp"
#include "identify/methods/any_law/severity_curve.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The result of one law for the record.
struct LawAnswer {
  std::string name;
  double p_value = 0.0;
  bool rejected = false;
  double severity = 0.0;  ///< of the best fit
  double largest = 0.0;   ///< last severity that was fitted on the side of the best fit; signed
  ParameterSet value;     ///< of the best fit
  Interval zeta_interval95{};
  Interval F0_interval95{};
  double weight = 0.0;  ///< in the average
};

struct LawIntervals {
  std::string data;
  std::vector<LawAnswer> laws;  ///< the best first
  Interval zeta_hull{}, F0_hull{};
  Interval zeta_average{}, F0_average{};
  ParameterSet mean;  ///< of the average
  ParameterSet std;
  double inflation = 1.0;
  /// Laws that the record does not reject and cannot tell apart: a test of level 5 % between their best fits has a
  /// power below 1/6.
  std::vector<std::vector<std::string>> aliases;
  /// The laws at the lower and the upper end of the hull.
  std::array<std::string, 2> zeta_ends, F0_ends;
  std::vector<std::string> unsolved;  ///< laws for which no steady state was found
};

/// Why these intervals are not to be used: even the best law misses the readings by more than three times their
/// noise. Empty if some law fits better.
[[nodiscard]] std::string no_law_fits(const LawIntervals& laws);
/// Why the range over laws of an estimate is not to be used; empty as well if it has none.
[[nodiscard]] std::string no_law_fits(const Estimate& estimate);

/// The fits behind the intervals.
struct LawStudy {
  PlainFit plain;
  std::vector<LawFits> laws{};  ///< that were solved; plain friction first
  LawIntervals intervals{};
};

/// The intervals that follow from the fits of all laws; plain friction is the first one. Laws that were not solved
/// are left out, and named.
[[nodiscard]] LawIntervals intervals_of(const ReadingModel& model, const KnownConstants& constants,
                                        const PlainFit& plain, std::vector<LawFits>& laws);

/// The answer, or why there is none.
[[nodiscard]] std::variant<LawStudy, std::string> study_laws(const ReadingModel& model,
                                                             const KnownConstants& constants,
                                                             const LawIntervalOptions& options);

}  // namespace dualdamp::identify
