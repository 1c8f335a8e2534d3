#include "sim/orbits/orbit_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/numbers.hpp"
#include "sim/neutral_margin.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

/// "3 %", for a distance relative to the size of the motion.
std::string share_of_size(double distance) {
  return distance < 1.0 ? core::percent(distance, 1) : "more than its size";
}

/// Relative error of a steady state above which a warning states it.
constexpr double least_warned = 1e-4;

bool can_have_finer_steps(const Model& model) { return model.solver.tolerance >= 10.0 * least_tolerance; }

}  // namespace

// Under weak damping a motion closes within the tolerance long before it has reached its orbit. What is left to it,
// and what errors of steps add up to, is measured by the monodromy matrix.
void warn_of_distance(const ForcingPeriod& period, double tolerance, double accuracy, double omega,
                      SteadyState& result) {
  constexpr double usual = 1e-9;
  const double rest = 1.0 - period.radius();
  if (tolerance <= usual || !(rest > neutral_margin)) return;
  const double distance = std::max(correction_left(period, omega), accuracy / rest);
  if (!(distance > least_warned)) return;
  result.warnings.emplace_back(
      "the steady state may be off by " + share_of_size(distance) +
      ": at this tolerance a motion counts as closed while it is still that far from it; a smaller "
      "'numerics.tolerance' finds it more exactly");
}

Model with_other_steps(const Model& model) {
  constexpr double tenfold = 10.0;
  Model other = model;
  other.solver.tolerance *= can_have_finer_steps(model) ? 1.0 / tenfold : tenfold;
  return other;
}

void warn_of_steps(const ForcingPeriod& period, PeriodMap& other, const Model& model, SteadyState& result) {
  const ForcingPeriod again = other.from(period.begin, Monodromy::without);
  const std::string compared = std::string("with ") + (can_have_finer_steps(model) ? "a tenth of" : "ten times") +
                               " 'numerics.tolerance' its period ";
  if (!other.outcome().ok()) {
    result.warnings.emplace_back("the error of the steady state is not known: " + compared +
                                 "was not computed to its end");
    return;
  }
  const double error = std::max({std::abs(again.peak - period.peak), std::abs(again.trough - period.trough),
                                 std::abs(again.end.x - period.end.x),
                                 std::abs(again.end.v - period.end.v) / model.excitation.frequency}) /
                       period.size;
  if (!(error > least_warned)) return;
  result.warnings.emplace_back("the steady state may be off by " + share_of_size(error) + ": " + compared +
                               "differs by that, because errors of steps grow within it");
}

}  // namespace dualdamp::sim
