#include "identify/methods/histories/friction_force.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/histories/friction_samples.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/correlated_regression.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"

namespace dualdamp::identify {

namespace {

/// Rows of the regression on {v, sgn v, 1}.
struct SlidingRows {
  Eigen::MatrixXd columns;
  Eigen::VectorXd target, displacement;
  std::vector<Eigen::Index> blocks;
};

SlidingRows sliding_rows(const std::vector<FrictionSamples>& histories, double least_speed) {
  std::size_t count = 0;
  for (const FrictionSamples& samples : histories) count += samples.force.size();
  SlidingRows rows;
  rows.columns.resize(static_cast<Eigen::Index>(count), 3);
  rows.target.resize(rows.columns.rows());
  rows.displacement.resize(rows.columns.rows());
  Eigen::Index row = 0;
  for (const FrictionSamples& samples : histories) {
    rows.blocks.push_back(row);
    for (std::size_t i = 0; i < samples.force.size(); ++i) {
      if (!(std::abs(samples.motion.v[i]) > least_speed)) continue;
      rows.columns.row(row) << samples.motion.v[i], samples.motion.sign[i], 1.0;
      rows.target[row] = samples.force[i];
      rows.displacement[row] = samples.motion.x[i];
      ++row;
    }
  }
  rows.columns.conservativeResize(row, Eigen::NoChange);
  rows.target.conservativeResize(row);
  rows.displacement.conservativeResize(row);
  return rows;
}

void add_curves(const std::vector<FrictionSamples>& histories, double c, Estimate& estimate) {
  EstimateCurve over_velocity{"friction_velocity", {{"v", "m/s", {}}, {"F", "N", {}}, {"dry", "N", {}}}};
  EstimateCurve over_displacement{"friction_displacement", {{"x", "m", {}}, {"F", "N", {}}}};
  for (const FrictionSamples& samples : histories) {
    for (std::size_t i = 0; i < samples.force.size(); ++i) {
      over_velocity.columns[0].values.push_back(samples.motion.v[i]);
      over_velocity.columns[1].values.push_back(samples.force[i]);
      over_velocity.columns[2].values.push_back(samples.force[i] - c * samples.motion.v[i]);
      over_displacement.columns[0].values.push_back(samples.motion.x[i]);
      over_displacement.columns[1].values.push_back(samples.force[i]);
    }
  }
  estimate.curves = {std::move(over_velocity), std::move(over_displacement)};
}

/// Sums over the swings of the motion.
struct Swings {
  double S_xx = 0.0, S_xF = 0.0;  ///< of force over displacement after a reversal
  double samples = 0.0;           ///< samples in these sums, less two unknowns for each swing
  double resolved = 0.0;          ///< swings with three samples or more
  double speed = 0.0;             ///< sum of transition speeds
  double transitions = 0.0;
  double swing = 0.0;  ///< sum of |x| from reversal to reversal
  double time = 0.0;   ///< from reversal to reversal
  double work = 0.0;   ///< of the friction force
  double count = 0.0;

  [[nodiscard]] bool contact_shows() const {
    return count >= 2.0 && resolved >= 0.5 * count && S_xF > 0.0 && samples > 0.0;
  }
  /// Transition velocity [m/s]; 0 if the contact is not visible.
  [[nodiscard]] double mean_speed() const {
    return contact_shows() && transitions >= 0.5 * count ? speed / transitions : 0.0;
  }
};

/// After a reversal the part of the force without c v changes by 2 F0, for a contact of stiffness K over a
/// displacement of 2 F0/K.
void add_reversal(const FrictionSamples& samples, const std::vector<double>& dry, std::size_t reversal,
                  std::size_t next, double F0, Swings& swings) {
  constexpr double straight = 0.8;   // share of that change after which the contact begins to slip
  constexpr double complete = 0.98;  // share at which the change is complete; the level in slip is not known better
  const std::vector<double>& x = samples.motion.x;
  double n = 0.0, mean_x = 0.0, mean_F = 0.0, S_xx = 0.0, S_xF = 0.0;
  std::size_t i = reversal;
  for (; i < next && std::abs(dry[i] - dry[reversal]) < straight * 2.0 * F0; ++i) {
    n += 1.0;
    const double dx = x[i] - mean_x;
    const double dF = dry[i] - mean_F;
    mean_x += dx / n;
    mean_F += dF / n;
    S_xx += dx * (x[i] - mean_x);
    S_xF += dx * (dry[i] - mean_F);
  }
  if (n >= 3.0) {
    swings.S_xx += S_xx;
    swings.S_xF += S_xF;
    swings.samples += n - 2.0;
    swings.resolved += 1.0;
  }
  while (i < next && std::abs(dry[i] - dry[reversal]) < complete * 2.0 * F0) ++i;
  if (i >= next || i == reversal) return;
  const double before = std::abs(dry[i - 1] - dry[reversal]) / (2.0 * F0);
  const double after = std::abs(dry[i] - dry[reversal]) / (2.0 * F0);
  const double share = std::clamp((complete - before) / (after - before), 0.0, 1.0);
  const std::vector<double>& v = samples.motion.v;
  // v^2 grows in proportion to the displacement from the reversal.
  swings.speed += std::abs(v[i - 1] + share * (v[i] - v[i - 1])) / std::sqrt(complete);
  swings.transitions += 1.0;
}

void add_swings(const FrictionSamples& samples, double c, double offset, double F0, Swings& swings) {
  const std::vector<double>& v = samples.motion.v;
  std::vector<double> dry(samples.force.size());
  for (std::size_t i = 0; i < dry.size(); ++i) dry[i] = samples.force[i] - c * v[i] - offset;
  std::vector<std::size_t> at;  // last sample before the velocity changes its sign
  int sign = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const int here = (v[i] > 0.0) - (v[i] < 0.0);
    if (here == 0) continue;
    if (sign != 0 && here != sign) at.push_back(i - 1);
    sign = here;
  }
  for (std::size_t r = 0; r + 1 < at.size(); ++r) {
    add_reversal(samples, dry, at[r], at[r + 1], F0, swings);
    const std::vector<double>& x = samples.motion.x;
    swings.swing += std::abs(x[at[r + 1]] - x[at[r]]);
    swings.time += static_cast<double>(at[r + 1] - at[r]) / samples.motion.sample_rate;
    for (std::size_t i = at[r]; i < at[r + 1]; ++i)
      swings.work += 0.5 * (samples.force[i] + samples.force[i + 1]) * (x[i + 1] - x[i]);
    swings.count += 1.0;
  }
}

Swings swings_of(const std::vector<FrictionSamples>& histories, const CorrelatedFit& fit) {
  Swings swings;
  for (const FrictionSamples& samples : histories)
    add_swings(samples, fit.coefficients[0], fit.coefficients[2], fit.coefficients[1], swings);
  return swings;
}

/// Contact stiffness, transition velocity and the area of the loop, as far as the sample rate resolves them.
void report_contact(const Swings& swings, double F0, Estimate& estimate) {
  if (swings.count < 2.0 || !(F0 > 0.0)) return;
  estimate.others.push_back({"loop_area", "J", 2.0 * swings.work / swings.count, std::nullopt, std::nullopt});
  if (!swings.contact_shows()) {
    estimate.warnings.emplace_back(
        "the force goes from one limit to the other within two samples: the contact is stiffer than this sample rate "
        "can show");
    return;
  }
  const double slope = swings.S_xF / swings.S_xx;
  // The filters of the acceleration make the contact appear softer than it is, by more than its standard error.
  estimate.others.push_back({"contact_stiffness", "N/m", slope, std::nullopt, std::nullopt});
  const double speed = swings.mean_speed();
  if (!(speed > 0.0)) return;
  const double X = 0.5 * swings.swing / swings.count;
  const double omega = std::numbers::pi * swings.count / swings.time;
  estimate.others.push_back({"transition_velocity", "m/s", speed, std::nullopt, std::nullopt});
  const double inner = X * X - speed * speed / (omega * omega);
  if (inner > 0.0)
    estimate.others.push_back(
        {"stiffness_from_transition", "N/m", 2.0 * F0 / (X - std::sqrt(inner)), std::nullopt, std::nullopt});
}

void judge_loop(Estimate& estimate) {
  if (!estimate.lack_of_fit) return;
  LackOfFit& test = *estimate.lack_of_fit;
  test.least_effect = 0.02;
  test.fired = test.p_value < test.level && test.effect > test.least_effect;
  const std::string text =
      "the force depends on displacement by " + core::percent(test.effect, 3) + " of its largest value";
  if (test.fired)
    estimate.findings.push_back(text +
                                ": a gain error, a wrong mass or stiffness, or friction that varies with position");
  else if (test.p_value < test.level && test.effect > 1e-3)
    estimate.warnings.push_back(text);
}

/// The line through the samples that slide.
struct SlidingLine {
  double least_speed = 0.0;
  SlidingRows rows;
  std::optional<CorrelatedFit> fit;
  Swings swings;
};

SlidingLine sliding_line(const std::vector<FrictionSamples>& histories, const RegressionOptions& options) {
  const auto line_beyond = [&](double speed) {
    SlidingLine line{speed, sliding_rows(histories, speed), {}, {}};
    line.fit = fit_correlated(line.rows.columns, line.rows.target, line.rows.blocks);
    if (line.fit) line.swings = swings_of(histories, *line.fit);
    return line;
  };
  SlidingLine line = line_beyond(least_speed_for(histories, options));
  // A compliant contact slides only beyond its transition velocity: slower samples do not belong to the line.
  constexpr double beyond = 1.2;
  for (int pass = 0; pass < 3 && line.fit && options.least_speed == 0.0; ++pass) {
    const double transition = beyond * line.swings.mean_speed();
    if (!(transition > line.least_speed)) break;
    SlidingLine faster = line_beyond(transition);
    if (!faster.fit) break;
    line = std::move(faster);
  }
  return line;
}

/// (m, c, k, F0, offset), where mass and stiffness are constants.
ParameterReading reading_of(const CorrelatedFit& fit, const KnownConstants& constants) {
  const auto error = [&](Eigen::Index i) { return std::sqrt(fit.covariance(i, i)); };
  ParameterReading reading{Eigen::VectorXd(5), Eigen::VectorXd(5)};
  reading.parameters << constants.mass, fit.coefficients[0], constants.stiffness, fit.coefficients[1],
      fit.coefficients[2];
  reading.errors << 0.0, error(0), 0.0, error(1), error(2);
  return reading;
}

}  // namespace

Estimate friction_force(const Record& record, const KnownConstants& constants, const RegressionOptions& options) {
  Estimate estimate;
  estimate.method = friction_force_method.name;
  const std::vector<FrictionSamples> histories = friction_samples(record, constants, options, estimate);
  if (histories.empty()) return estimate;
  const SlidingLine line = sliding_line(histories, options);
  if (!line.fit) {
    refuse(estimate,
           "viscous and Coulomb friction cannot be distinguished: the motion has too few samples beyond " +
               core::format_number(line.least_speed, 3) + " " + constants.unit("m/s") +
               ", or one speed or one direction only");
    return estimate;
  }
  const ParameterReading own = reading_of(*line.fit, constants);
  const auto again = [&](const Record& drawn) -> std::optional<ParameterReading> {
    Estimate ignored;
    const SlidingLine other = sliding_line(friction_samples(drawn, constants, options, ignored), options);
    return other.fit ? std::optional(reading_of(*other.fit, constants)) : std::nullopt;
  };
  Estimate ignored;
  const std::optional<BootstrapSpread> spread =
      parametric_bootstrap(usable_histories(record, options, ignored), own, own.parameters[offset_place], again);
  const ForceParameters force{constants.mass, own.parameters[1], constants.stiffness, own.parameters[3]};
  set_estimate(estimate, force, spread);
  estimate.others.push_back(further("offset", "N", own.parameters[offset_place], spread, offset_place));
  for (const FrictionSamples& samples : histories) estimate.used.push_back(samples.number);
  report_contact(line.swings, force.F0, estimate);
  add_curves(histories, force.c, estimate);

  std::vector<std::string> faults;
  const double fastest = line.rows.columns.col(0).cwiseAbs().maxCoeff();
  const double scale = std::abs(force.c) * fastest + std::abs(force.F0);
  judge_force_signs(estimate, scale / fastest, scale, faults);
  estimate.lack_of_fit = correlated_term_test(line.rows.columns, line.rows.target, line.rows.displacement,
                                              line.rows.blocks, scale, "displacement term t-test");
  judge_loop(estimate);
  conclude(estimate, faults,
           "rests on " + std::to_string(line.rows.target.size()) + " samples faster than " +
               core::format_number(line.least_speed, 3) + " " + constants.unit("m/s"));
  return estimate;
}

constinit const MethodEntry friction_force_method{
    .name = "friction_force",
    .summary = "friction force over velocity and displacement, contact stiffness and transition velocity",
    .assumes =
        "mass and stiffness known, signals without lag or gain error, white noise; checked: a term in x, which gain "
        "errors and wrong constants leave",
    .equation = "F = k (y - x) + f - m a; F = c v + F0 sgn v + offset for |v| > least speed",
    .sources = "liang2004identifying",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<friction_force>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
