#include "identify/methods/histories/recursive_least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/histories/friction_samples.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/correlated_regression.hpp"
#include "identify/uncertainty/parametric_bootstrap.hpp"

namespace dualdamp::identify {

namespace {

/// The recursion in its information form, P^-1 <- lambda P^-1 + psi psi^T, in units in which both columns are of
/// order one. The form with P itself would subtract numbers of the size of the initial P and lose digits.
class Recursion {
 public:
  Recursion(double forgetting, double speed) : forgetting_(forgetting), speed_(speed) {
    constexpr double known_at_start = 1e-12;  // in samples: the first samples decide
    information_ = known_at_start * Eigen::Matrix2d::Identity();
  }

  void update(double force, double v, double sign) {
    const Eigen::Vector2d psi(v / speed_, sign);
    information_ = forgetting_ * information_ + psi * psi.transpose();
    moment_ = forgetting_ * moment_ + force * psi;
  }

  /// (c, F0).
  [[nodiscard]] Eigen::Vector2d state() const {
    const Eigen::Vector2d theta = information_.ldlt().solve(moment_);
    return {theta[0] / speed_, theta[1]};
  }

 private:
  double forgetting_;
  double speed_;
  Eigen::Matrix2d information_;
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero();
};

/// The samples that are used, as rows.
struct TimedRows {
  Eigen::MatrixXd columns;
  Eigen::VectorXd target;
  std::vector<double> time;
  std::vector<Eigen::Index> blocks;
};

TimedRows timed_rows(const std::vector<FrictionSamples>& histories, double least_speed) {
  std::size_t count = 0;
  for (const FrictionSamples& samples : histories) count += samples.force.size();
  TimedRows rows;
  rows.columns.resize(static_cast<Eigen::Index>(count), 2);
  rows.target.resize(rows.columns.rows());
  double elapsed = 0.0;  // histories one after the other
  for (const FrictionSamples& samples : histories) {
    const PreparedHistory& motion = samples.motion;
    rows.blocks.push_back(static_cast<Eigen::Index>(rows.time.size()));
    for (std::size_t i = 0; i < samples.force.size(); ++i) {
      if (!(std::abs(motion.v[i]) > least_speed)) continue;
      const auto row = static_cast<Eigen::Index>(rows.time.size());
      rows.columns.row(row) << motion.v[i], motion.sign[i];
      rows.target[row] = samples.force[i];
      rows.time.push_back(elapsed + motion.start + static_cast<double>(i) / motion.sample_rate);
    }
    elapsed += static_cast<double>(samples.force.size()) / motion.sample_rate;
  }
  const auto used = static_cast<Eigen::Index>(rows.time.size());
  rows.columns.conservativeResize(used, Eigen::NoChange);
  rows.target.conservativeResize(used);
  return rows;
}

Recursion recursion_over(const TimedRows& rows, double forgetting, double speed, EstimateCurve& curve) {
  constexpr Eigen::Index most_points = 2000;
  const Eigen::Index every = std::max<Eigen::Index>(1, rows.target.size() / most_points);
  Recursion recursion(forgetting, speed);
  for (Eigen::Index i = 0; i < rows.target.size(); ++i) {
    recursion.update(rows.target[i], rows.columns(i, 0), rows.columns(i, 1));
    if (i % every != 0 || i < 2) continue;
    curve.columns[0].values.push_back(rows.time[static_cast<std::size_t>(i)]);
    const Eigen::Vector2d state = recursion.state();
    curve.columns[1].values.push_back(state[0]);
    curve.columns[2].values.push_back(state[1]);
  }
  return recursion;
}

/// Covariance of (c, F0): that of least squares over the samples in the memory.
Eigen::Matrix2d covariance_of(const CorrelatedFit& fit, double forgetting) {
  const auto samples = static_cast<double>(fit.residuals.size());
  // Exponential weights are worth (1 + l)/(1 - l) equal ones.
  const double remembered = forgetting < 1.0 ? (1.0 + forgetting) / (1.0 - forgetting) : samples;
  return fit.covariance * std::max(1.0, samples / remembered);
}

/// Compares the friction of both halves of the record.
void compare_halves(const TimedRows& rows, Estimate& estimate) {
  const Eigen::Index half = rows.target.size() / 2;
  const auto first = fit_correlated(rows.columns.topRows(half), rows.target.head(half), {});
  const auto second = fit_correlated(rows.columns.bottomRows(half), rows.target.tail(half), {});
  if (!first || !second) return;
  const double change = second->coefficients[1] - first->coefficients[1];
  const double error = std::sqrt(first->covariance(1, 1) + second->covariance(1, 1));
  constexpr double of_weight = 0.01;
  if (std::abs(change) < 3.0 * error || std::abs(change) < of_weight * std::abs(estimate.value.F0)) return;
  estimate.warnings.push_back(
      "the Coulomb friction changes by " + core::signed_percent(change / estimate.value.F0, 3) +
      " from the first half of the record to the second: a forgetting factor below 1 follows it");
}

/// Results of the recursion for a record.
struct RecursiveFit {
  TimedRows rows;
  std::optional<CorrelatedFit> fit;
  ParameterReading reading;  ///< (m, c, k, F0), where mass and stiffness are constants
  EstimateCurve curve{"friction_over_time", {{"t", "s", {}}, {"c", "N.s/m", {}}, {"F0", "N", {}}}};
};

RecursiveFit fit_recursively(const std::vector<FrictionSamples>& histories, const KnownConstants& constants,
                             const RecursiveOptions& options) {
  RecursiveFit result;
  result.rows = timed_rows(histories, least_speed_for(histories, options));
  result.fit = fit_correlated(result.rows.columns, result.rows.target, result.rows.blocks);
  if (!result.fit) return result;
  const double fastest = result.rows.columns.col(0).cwiseAbs().maxCoeff();
  const Recursion recursion = recursion_over(result.rows, options.forgetting, fastest, result.curve);
  const Eigen::Vector2d state = recursion.state();
  const Eigen::Matrix2d covariance = covariance_of(*result.fit, options.forgetting);
  result.reading.parameters = Eigen::Vector4d(constants.mass, state[0], constants.stiffness, state[1]);
  result.reading.errors = Eigen::Vector4d(0.0, std::sqrt(covariance(0, 0)), 0.0, std::sqrt(covariance(1, 1)));
  return result;
}

/// Why the record does not separate viscous from Coulomb friction; empty when it does.
std::string fault_of(const RecursiveFit& result) {
  if (!result.fit)
    return "viscous and Coulomb friction cannot be distinguished: too few samples beyond the least speed, or "
           "one speed only";
  // Filters may reverse the velocity of a few samples at the ends.
  constexpr double few = 0.05;
  if (1.0 - std::abs(result.rows.columns.col(1).mean()) < 2.0 * few)
    return "the motion goes in one direction only, where a Coulomb force and an offset of the force sensor cannot be "
           "distinguished";
  return {};
}

}  // namespace

Estimate recursive_least_squares(const Record& record, const KnownConstants& constants,
                                 const RecursiveOptions& options) {
  Estimate estimate;
  estimate.method = recursive_least_squares_method.name;
  const std::vector<FrictionSamples> histories = friction_samples(record, constants, options, estimate);
  if (histories.empty()) return estimate;
  if (!(options.forgetting > 0.0 && options.forgetting <= 1.0)) {
    refuse(estimate, "the forgetting factor must be above 0 and at most 1");
    return estimate;
  }
  RecursiveFit result = fit_recursively(histories, constants, options);
  if (std::string fault = fault_of(result); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const auto again = [&](const Record& drawn) -> std::optional<ParameterReading> {
    Estimate ignored;
    RecursiveFit other = fit_recursively(friction_samples(drawn, constants, options, ignored), constants, options);
    return other.fit ? std::optional(std::move(other.reading)) : std::nullopt;
  };
  Estimate ignored;
  const Eigen::VectorXd& p = result.reading.parameters;
  const ForceParameters force{p[0], p[1], p[2], p[3]};
  set_estimate(estimate, force,
               parametric_bootstrap(usable_histories(record, options, ignored), result.reading, 0.0, again));
  estimate.curves.push_back(std::move(result.curve));
  for (const FrictionSamples& samples : histories) estimate.used.push_back(samples.number);

  std::vector<std::string> faults;
  const double fastest = result.rows.columns.col(0).cwiseAbs().maxCoeff();
  const double scale = std::abs(force.c) * fastest + std::abs(force.F0);
  judge_force_signs(estimate, scale / fastest, scale, faults);
  if (options.forgetting == 1.0) compare_halves(result.rows, estimate);
  conclude(estimate, faults, "the state after " + std::to_string(result.rows.target.size()) + " samples");
  return estimate;
}

constinit const MethodEntry recursive_least_squares_method{
    .name = "recursive_least_squares",
    .summary = "viscous and Coulomb friction followed over time, with forgetting",
    .assumes =
        "mass and stiffness known, white noise, friction that drifts slowly; checked: agreement of both "
        "halves of the record where nothing is forgotten",
    .equation = "z = k (y - x) + f - m a, psi = (v, sgn v), theta += P psi (z - psi^T theta)/(l + psi^T P psi)",
    .sources = "liang2004identifying, ljung1999",
    .needs = RecordKind::history,
    .lacks = lacks_histories,
    .call = call_of<recursive_least_squares>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
