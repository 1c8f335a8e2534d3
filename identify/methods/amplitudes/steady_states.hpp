#pragma once
/// Common parts of the methods that read steady states with phases or at several frequencies: preparation of the
/// states, a straight line of force over speed, and the error of a method at its own estimate.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/methods/amplitudes/line_estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Why the record has no two pairs with phases; empty when it has.
[[nodiscard]] std::string lacks_phases(const Record& record);

/// Amplitude of the fundamental of x; the amplitude read where no harmonics were measured.
[[nodiscard]] double fundamental(const Pair& pair);

/// The pairs with positive finite amplitudes in the order of the record, each with its frequency and number; with
/// `phases` only those whose phase was measured and by whose phase the base drives the mass. Pairs left out are
/// listed in `estimate`. Nothing after the estimate has been refused: no pairs, no stiffness, a frequency that is
/// not known.
[[nodiscard]] std::optional<std::vector<Pair>> take_states(const Record& record, const KnownConstants& constants,
                                                           bool phases, Estimate& estimate);

/// Leaves out the states that stick at (zeta, x_f) of `value`; false when there are none. Needs the mass.
bool drop_sticking(std::vector<Pair>& states, const ParameterSet& value, const KnownConstants& constants,
                   Estimate& estimate);

/// The states as the exact law has them at `value`, with only those quantities that were measured. States for which
/// there is no motion without a stop are left out. Needs the mass and c > 0.
[[nodiscard]] std::vector<Pair> exact_states(const std::vector<Pair>& states, const ParameterSet& value,
                                             const KnownConstants& constants);

/// Error of a method on the exact states at its own estimate: a difference above 1 % of either parameter is a
/// warning, above 10 % a fault; `because` names the cause. Nothing happens if the mass is not known or the estimate
/// is not a friction.
void judge_own_reading(const std::vector<Pair>& states, const KnownConstants& constants,
                       const std::function<std::optional<ParameterSet>(const std::vector<Pair>&)>& read,
                       const std::string& because, Estimate& estimate, std::vector<std::string>& faults);

/// force = F0 share + c speed, by least squares.
struct ForceLine {
  std::vector<Datum> points;  ///< Y: speed [m/s], x: force [N]
  Moments moments;
  Line line;
  double share = 1.0;
  Eigen::VectorXd residuals;  ///< N

  [[nodiscard]] double c() const { return line.slope; }
  [[nodiscard]] double F0() const { return line.intercept / share; }
  [[nodiscard]] double freedom() const { return moments.count - 2.0; }
};

/// Nothing from fewer than two speeds.
[[nodiscard]] std::optional<ForceLine> force_line(std::vector<Datum> points, double share);

/// Value and, from three points on, its uncertainty.
void set_estimate(Estimate& estimate, const ForceLine& line, const KnownConstants& constants);

}  // namespace dualdamp::identify
