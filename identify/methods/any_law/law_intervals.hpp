#pragma once
/// What a record says about zeta and F0 when nobody knows the friction law: every law of the library is fitted,
/// over its severity, and two ranges are drawn.
///
///   hull      the union of the 95 % regions of all laws that the record does not reject at 5 %
///   average   the 2.5 and 97.5 % points of the mixture of the same laws, which count alike; within a law its
///             severities count by their likelihood and a prior of standard deviation `severity_deviation` about
///             zero
///
/// No law is the rig's: laws err by `law_error` of what the departure does to the readings, beside the noise. Plain
/// friction does not err, nor does a law that leaves more than half of what plain friction leaves.
/// zeta and F0 of a law are those of the Coulomb + viscous friction that it departs from (identify/rigs/rigs.hpp):
/// what remains as its severity goes to zero. When every law is rejected the noise is raised until the best one is
/// not, and `inflation` says by how much (birge1932). Source: brynjarsdottir2014, pasquier2015. Docs:
/// docs/methods/any_law.md. Cost: one record of eight states with phases takes seconds; laws are shared out to all
/// cores.

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/methods/any_law/library.hpp"
#include "identify/methods/any_law/severity_curve.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// What one law makes of the record.
struct LawAnswer {
  std::string name;
  double p_value = 0.0;
  bool rejected = false;
  double severity = 0.0;  ///< of the best fit
  double largest = 0.0;   ///< severity up to which it was sought on that side; signed
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
  /// Which law ends the hull below and above.
  std::array<std::string, 2> zeta_ends, F0_ends;
  std::vector<std::string> unsolved;  ///< laws without a steady state at these unknowns
};

/// The fits behind the intervals.
struct LawStudy {
  PlainFit plain;
  std::vector<LawFits> laws{};  ///< plain friction first; those that were solved
  LawIntervals intervals{};
};

/// The answer, or why there is none.
[[nodiscard]] std::variant<LawStudy, std::string> study_laws(const ReadingModel& model,
                                                             const KnownConstants& constants,
                                                             const LawIntervalOptions& options);

}  // namespace dualdamp::identify
