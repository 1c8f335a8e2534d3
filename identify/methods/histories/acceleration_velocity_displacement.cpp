#include "identify/methods/histories/acceleration_velocity_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/correlated_regression.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"

namespace dualdamp::identify {

namespace {

/// The columns of the regression; mass and stiffness only if they are unknown.
struct Columns {
  std::optional<Eigen::Index> mass, stiffness;
  Eigen::Index damping = 0, friction = 0, offset = 0;
  Eigen::Index count = 0;

  explicit Columns(const KnownConstants& constants) {
    if (std::isnan(constants.mass)) mass = count++;
    damping = count++;
    if (std::isnan(constants.stiffness)) stiffness = count++;
    friction = count++;
    offset = count++;
  }
};

/// All samples of all histories that are fast enough, as rows.
struct MotionRows {
  Eigen::MatrixXd columns;
  Eigen::VectorXd target, speed, drag;
  std::vector<Eigen::Index> blocks;
  std::vector<Exclusion> slow;
};

/// Known forces go to the left of the equation, unknown ones to the right.
MotionRows motion_rows(const std::vector<NumberedHistory>& histories, const std::vector<PreparedHistory>& motions,
                       double least_speed, const Columns& columns, const KnownConstants& constants) {
  std::size_t samples = 0;
  for (const PreparedHistory& motion : motions) samples += motion.v.size();
  MotionRows rows;
  rows.columns.resize(static_cast<Eigen::Index>(samples), columns.count);
  rows.target.resize(static_cast<Eigen::Index>(samples));
  rows.speed.resize(rows.target.size());
  rows.drag.resize(rows.target.size());
  Eigen::Index row = 0;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    const PreparedHistory& motion = motions[h];
    rows.blocks.push_back(row);
    const Eigen::Index first = row;
    for (std::size_t i = 0; i < motion.v.size(); ++i) {
      if (!(std::abs(motion.v[i]) > least_speed)) continue;
      const double stretch = motion.y[i] - motion.x[i];
      double known = motion.force[i];
      if (columns.mass)
        rows.columns(row, *columns.mass) = motion.a[i];
      else
        known -= constants.mass * motion.a[i];
      if (columns.stiffness)
        rows.columns(row, *columns.stiffness) = -stretch;
      else
        known += constants.stiffness * stretch;
      rows.columns(row, columns.damping) = motion.v[i];
      rows.columns(row, columns.friction) = motion.sign[i];
      rows.columns(row, columns.offset) = 1.0;
      rows.target[row] = known;
      rows.speed[row] = motion.v[i];
      rows.drag[row] = motion.drag[i];
      ++row;
    }
    const auto left_out = static_cast<Eigen::Index>(motion.v.size()) - (row - first);
    if (left_out > 0)
      rows.slow.push_back({histories[h].number, std::to_string(left_out) + " of " +
                                                    std::to_string(motion.v.size()) + " samples are slower than " +
                                                    core::format_number(least_speed, 3) + " " +
                                                    constants.unit("m/s")});
  }
  rows.columns.conservativeResize(row, Eigen::NoChange);
  rows.target.conservativeResize(row);
  rows.speed.conservativeResize(row);
  rows.drag.conservativeResize(row);
  return rows;
}

ForceParameters force_parameters(const CorrelatedFit& fit, const Columns& columns,
                                 const KnownConstants& constants) {
  return {columns.mass ? fit.coefficients[*columns.mass] : constants.mass, fit.coefficients[columns.damping],
          columns.stiffness ? fit.coefficients[*columns.stiffness] : constants.stiffness,
          fit.coefficients[columns.friction]};
}

/// (m, c, k, F0, offset) and their standard errors, zero where the constants give the value.
ParameterReading reading_of(const CorrelatedFit& fit, const Columns& columns, const KnownConstants& constants) {
  const ForceParameters force = force_parameters(fit, columns, constants);
  ParameterReading reading{Eigen::VectorXd(5), Eigen::VectorXd::Zero(5)};
  reading.parameters << force.m, force.c, force.k, force.F0, fit.coefficients[columns.offset];
  const std::array<std::optional<Eigen::Index>, 5> places{columns.mass, columns.damping, columns.stiffness,
                                                          columns.friction, columns.offset};
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i]) reading.errors[static_cast<Eigen::Index>(i)] = std::sqrt(fit.covariance(*places[i], *places[i]));
  return reading;
}

std::vector<FurtherParameter> further_parameters(const ParameterReading& reading, const Columns& columns,
                                                 const std::optional<BootstrapSpread>& spread) {
  std::vector<FurtherParameter> list;
  const auto add = [&](const char* name, const char* unit, Eigen::Index place) {
    list.push_back(further(name, unit, reading.parameters[place], spread, place));
  };
  if (columns.mass) add("mass", "kg", 0);
  if (columns.stiffness) add("stiffness", "N/m", 2);
  add("offset", "N", offset_place);
  return list;
}

/// The forces less inertia, spring and offset, over speed, and the fitted friction.
EstimateCurve friction_curve(const MotionRows& rows, const CorrelatedFit& fit, const Columns& columns) {
  EstimateCurve curve{"friction_velocity", {{"v", "m/s", {}}, {"F", "N", {}}, {"fitted", "N", {}}}};
  for (Eigen::Index i = 0; i < rows.speed.size(); ++i) {
    const double fitted = fit.coefficients[columns.damping] * rows.columns(i, columns.damping) +
                          fit.coefficients[columns.friction] * rows.columns(i, columns.friction);
    curve.columns[0].values.push_back(rows.speed[i]);
    curve.columns[1].values.push_back(fitted + fit.residuals[i]);
    curve.columns[2].values.push_back(fitted);
  }
  return curve;
}

/// If columns nearly depend on each other, the fit rests on their small difference, which consists mostly of errors
/// of the sensors.
void judge_condition(const CorrelatedFit& fit, Estimate& estimate) {
  constexpr double nearly_dependent = 20.0;
  if (fit.condition < nearly_dependent || fit.deviation == 0.0) return;
  estimate.warnings.push_back("the columns nearly depend on each other (condition number " +
                              core::format_number(fit.condition, 2) +
                              "): give the mass, or measure at two levels or frequencies");
}

/// Real friction is never quite a straight line over speed: a small curvature is a warning, and the estimate stays
/// usable.
void judge_curvature(Estimate& estimate) {
  if (!estimate.lack_of_fit) return;
  LackOfFit& test = *estimate.lack_of_fit;
  test.least_effect = 0.02;
  test.fired = test.p_value < test.level && test.effect > test.least_effect;
  if (test.fired)
    estimate.findings.emplace_back("friction over speed is not a straight line (see the curve friction_velocity)");
  else if (test.p_value < test.level && test.effect > 5e-4)
    estimate.warnings.push_back("friction over speed bends by " + core::percent(test.effect, 3) +
                                " of its largest value, more than chance explains");
}

std::string fault_of_unknowns(const KnownConstants& constants, bool with_force) {
  const auto known = [](double value) { return !std::isnan(value); };
  if (known(constants.mass) && !(constants.mass > 0.0 && std::isfinite(constants.mass)))
    return "the mass must be positive and finite";
  if (known(constants.stiffness) && !(constants.stiffness >= 0.0 && std::isfinite(constants.stiffness)))
    return "the stiffness must be finite and not negative";
  const bool scaled = known(constants.mass) || (known(constants.stiffness) && constants.stiffness > 0.0);
  if (!scaled && !with_force) return "the method needs the mass, the stiffness or a record of the force";
  return {};
}

bool have_force(const std::vector<NumberedHistory>& histories) {
  return std::ranges::any_of(histories, [](const NumberedHistory& item) {
    return std::ranges::any_of(item.history->force, [](double force) { return force != 0.0; });
  });
}

/// The regression with one choice of cut-off.
struct Regression {
  MotionRows rows;
  std::optional<CorrelatedFit> fit;
};

Regression regress(const std::vector<NumberedHistory>& histories, std::size_t choice, const Columns& columns,
                   const KnownConstants& constants, const RegressionOptions& options) {
  std::vector<PreparedHistory> motions;
  motions.reserve(histories.size());
  for (const NumberedHistory& item : histories) {
    const std::vector<double> cutoffs = cutoffs_for(*item.history, options);
    motions.push_back(prepared_history(*item.history, cutoffs[std::min(choice, cutoffs.size() - 1)]));
  }
  Regression regression;
  constexpr double share = 0.01;
  double fastest = 0.0;
  for (const PreparedHistory& motion : motions) fastest = std::max(fastest, largest_speed(motion));
  regression.rows = motion_rows(histories, motions, least_speed_for(fastest, share, options), columns, constants);
  regression.fit = fit_correlated(regression.rows.columns, regression.rows.target, regression.rows.blocks);
  return regression;
}

/// The fits with all cut-offs, the first of which is the estimate, and whether they agree.
void compare_cutoffs(const std::vector<NumberedHistory>& histories, const Regression& first, const Columns& columns,
                     const KnownConstants& constants, const RegressionOptions& options, Estimate& estimate,
                     std::vector<std::string>& faults) {
  const std::vector<double> cutoffs = cutoffs_for(*histories.front().history, options);
  if (cutoffs.size() < 2) return;
  double spread = 0.0;
  for (std::size_t choice = 0; choice < cutoffs.size(); ++choice) {
    const Regression other = choice == 0 ? first : regress(histories, choice, columns, constants, options);
    if (!other.fit) continue;
    const ForceParameters force = force_parameters(*other.fit, columns, constants);
    estimate.subsets.push_back({"cutoff " + core::format_number(cutoffs[choice], 4) + " Hz",
                                static_cast<int>(other.rows.target.size()), parameters(force),
                                further_parameters(reading_of(*other.fit, columns, constants), columns, {})});
    spread = std::max(spread, std::abs(force.F0 / estimate.value.F0 - 1.0));
    spread = std::max(spread, std::abs(force.c / estimate.value.c - 1.0));
  }
  constexpr double warned = 0.02;
  constexpr double too_much = 0.1;
  if (!(spread > warned)) return;
  const std::string text = "another cut-off frequency changes the friction by " + core::percent(spread, 3);
  if (spread > too_much)
    faults.push_back(text);
  else
    estimate.warnings.push_back(text);
}

}  // namespace

Estimate acceleration_velocity_displacement(const Record& record, const KnownConstants& constants,
                                            const RegressionOptions& options) {
  Estimate estimate;
  estimate.method = acceleration_velocity_displacement_method.name;
  const std::vector<NumberedHistory> histories = usable_histories(record, options, estimate);
  if (histories.empty()) return estimate;
  if (std::string fault = fault_of_unknowns(constants, have_force(histories)); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const Columns columns(constants);
  const Regression regression = regress(histories, 0, columns, constants, options);
  if (!regression.fit) {
    refuse(estimate,
           "mass, stiffness and friction cannot be distinguished: the motion has too few samples beyond the "
           "least speed, one direction only, or one level and frequency only");
    return estimate;
  }
  const CorrelatedFit& fit = *regression.fit;
  const ForceParameters force = force_parameters(fit, columns, constants);
  std::vector<std::string> faults;
  if (!(force.m > 0.0)) faults.emplace_back("the mass came out negative");
  if (force.k < 0.0) faults.emplace_back("the stiffness came out negative");
  const ParameterReading own = reading_of(fit, columns, constants);
  const auto again = [&](const Record& drawn) -> std::optional<ParameterReading> {
    Estimate ignored;
    const Regression other = regress(usable_histories(drawn, options, ignored), 0, columns, constants, options);
    return other.fit ? std::optional(reading_of(*other.fit, columns, constants)) : std::nullopt;
  };
  const std::optional<BootstrapSpread> spread =
      parametric_bootstrap(histories, own, own.parameters[offset_place], again);
  set_estimate(estimate, force, spread);
  estimate.others = further_parameters(own, columns, spread);
  for (const NumberedHistory& item : histories) estimate.used.push_back(item.number);
  estimate.excluded.insert(estimate.excluded.end(), regression.rows.slow.begin(), regression.rows.slow.end());
  estimate.curves.push_back(friction_curve(regression.rows, fit, columns));

  const double fastest = regression.rows.speed.cwiseAbs().maxCoeff();
  const double scale = std::abs(force.c) * fastest + std::abs(force.F0);
  judge_force_signs(estimate, scale / fastest, scale, faults);
  judge_condition(fit, estimate);
  estimate.lack_of_fit = correlated_term_test(regression.rows.columns, regression.rows.target, regression.rows.drag,
                                              regression.rows.blocks, scale, "v|v| term t-test");
  judge_curvature(estimate);
  compare_cutoffs(histories, regression, columns, constants, options, estimate, faults);
  conclude(estimate, faults,
           "rests on " + std::to_string(regression.rows.target.size()) + " samples of " +
               std::to_string(histories.size()) + (histories.size() == 1 ? " history" : " histories") + ", worth " +
               core::format_number(fit.independent, 3) + " independent ones");
  return estimate;
}

std::optional<ForceParameters> regressed_forces(const Record& record, const KnownConstants& constants,
                                                const RegressionOptions& options) {
  Estimate taken;
  const std::vector<NumberedHistory> histories = usable_histories(record, options, taken);
  if (histories.empty() || !fault_of_unknowns(constants, have_force(histories)).empty()) return std::nullopt;
  const Columns columns(constants);
  const Regression regression = regress(histories, 0, columns, constants, options);
  return regression.fit ? std::optional(force_parameters(*regression.fit, columns, constants)) : std::nullopt;
}

constinit const MethodEntry acceleration_velocity_displacement_method{
    .name = "acceleration_velocity_displacement",
    .summary = "mass, stiffness and friction by regressing the forces on acceleration, velocity and displacement",
    .assumes =
        "constant sample rate; mass, stiffness or force known; white noise; checked: condition of the "
        "columns, a term v|v|, agreement of several cut-off frequencies",
    .equation = "k (y - x) + f = m a + c v + F0 sgn v + offset, least squares over samples with |v| > least speed",
    .sources = "chen1996, janot2019",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<acceleration_velocity_displacement>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
