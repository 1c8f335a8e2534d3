#include "identify/methods/decays/free_decay.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/decays/extremes.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

using std::numbers::pi;

/// Range of R that is searched: damping ratios from 0.86 down to -0.13, where a swing grows by half.
constexpr double least_R = 0.005;
constexpr double greatest_R = 1.5;
constexpr int search_cells = 300;

/// Largest number of windows of four extremes that are listed.
constexpr int most_windows = 32;

double alternating(Eigen::Index i) { return i % 2 == 0 ? 1.0 : -1.0; }

/// The model for a given R is linear in c = (X_0, D = X_0 - X_1, o):
///   e_i = s_i (X_0 - p_i D) + o,   p_i = 1 + R + ... + R^(i-1),   s_i = (-1)^i
/// With p_i instead of R^i the columns stay independent at R = 1, which is Coulomb friction alone.
class DecayModel {
 public:
  DecayModel(std::span<const double> extremes, bool zero_offset)
      : e_(Eigen::Map<const Eigen::VectorXd>(extremes.data(), static_cast<Eigen::Index>(extremes.size()))),
        unknowns_(zero_offset ? 2 : 3) {}

  struct Fit {
    double R = 0.0;
    Eigen::VectorXd coefficients;
    Eigen::VectorXd residual;
    double slope = 0.0;  ///< of half the sum of squares with respect to R
  };

  [[nodiscard]] Fit fit(double R) const {
    Eigen::MatrixXd columns;
    Eigen::VectorXd dp;
    build(R, columns, dp);
    Fit fit;
    fit.R = R;
    fit.coefficients = linear_least_squares(columns, e_);
    fit.residual = e_ - columns * fit.coefficients;
    // The coefficients minimise the sum of squares, so only its explicit dependence on R counts.
    fit.slope = -fit.residual.dot(dp * -fit.coefficients[1]);
    return fit;
  }

  /// Derivatives of the extremes with respect to (R, X_0, D, o).
  [[nodiscard]] Eigen::MatrixXd jacobian(const Fit& fit) const {
    Eigen::MatrixXd columns;
    Eigen::VectorXd dp;
    build(fit.R, columns, dp);
    Eigen::MatrixXd all(e_.size(), unknowns_ + 1);
    all << dp * -fit.coefficients[1], columns;
    return all;
  }

  /// The cube of the fitted amplitudes, with their signs: the effect of friction that varies with amplitude. The
  /// square cannot be used, because near R = 1 it is the effect of a change of R.
  [[nodiscard]] Eigen::VectorXd cubic_term(const Fit& fit) const {
    const Eigen::VectorXd offset = Eigen::VectorXd::Constant(e_.size(), unknowns_ == 3 ? fit.coefficients[2] : 0.0);
    return (e_ - fit.residual - offset).array().cube();
  }

 private:
  void build(double R, Eigen::MatrixXd& columns, Eigen::VectorXd& dp) const {
    columns.resize(e_.size(), unknowns_);
    dp.resize(e_.size());
    double p = 0.0;
    double slope = 0.0;  // dp/dR
    for (Eigen::Index i = 0; i < e_.size(); ++i) {
      const double s = alternating(i);
      columns(i, 0) = s;
      columns(i, 1) = -s * p;
      if (unknowns_ == 3) columns(i, 2) = 1.0;
      dp[i] = s * slope;
      slope = p + R * slope;
      p = 1.0 + R * p;
    }
  }

  Eigen::VectorXd e_;
  Eigen::Index unknowns_;
};

/// R from as many extremes as unknowns, from differences in which friction and offset cancel.
double exact_R(std::span<const double> e, bool zero_offset) {
  if (zero_offset) return -(e[1] + e[2]) / (e[0] + e[1]);
  return -(e[3] - e[1]) / (e[2] - e[0]);
}

/// The least-squares R: the best cell of a search over the whole range, then the zero of the slope within it.
/// Nothing when the best cell is at an end of the range.
std::optional<double> least_squares_R(const DecayModel& model) {
  const auto ratio = [](int i) { return least_R + (greatest_R - least_R) * i / search_cells; };
  int best = 0;
  double least = core::infinity;
  for (int i = 0; i <= search_cells; ++i) {
    const double square = model.fit(ratio(i)).residual.squaredNorm();
    if (square < least) {
      least = square;
      best = i;
    }
  }
  if (best == 0 || best == search_cells) return std::nullopt;
  const auto slope = [&model](double R) { return model.fit(R).slope; };
  const double low = ratio(best - 1);
  const double high = ratio(best + 1);
  const double at_low = slope(low);
  const double at_high = slope(high);
  if (!(at_low <= 0.0 && at_high >= 0.0)) return std::nullopt;
  std::uintmax_t steps = 200;
  const auto bracket = boost::math::tools::toms748_solve(slope, low, high, at_low, at_high,
                                                         boost::math::tools::eps_tolerance<double>(), steps);
  return std::midpoint(bracket.first, bracket.second);
}

double zeta_of(double R) {
  const double L = -std::log(R) / pi;
  return L / std::sqrt(1.0 + L * L);
}

/// d zeta/dR
double zeta_slope(double R) {
  const double L = -std::log(R) / pi;
  return -1.0 / (pi * R * std::pow(1.0 + L * L, 1.5));
}

/// A fit of a decay and its results, with lengths in the unit of the extremes.
struct Solution {
  DecayModel::Fit fit;
  double zeta = 0.0;
  double x_f = 0.0;
  double side = 1.0;  ///< sign of the first amplitude

  [[nodiscard]] double first_amplitude() const { return fit.coefficients[0]; }
  [[nodiscard]] double offset() const { return fit.coefficients.size() == 3 ? fit.coefficients[2] : 0.0; }
};

std::optional<Solution> solve(std::span<const double> extremes, bool zero_offset) {
  const std::size_t unknowns = zero_offset ? 3 : 4;
  const DecayModel model(extremes, zero_offset);
  const std::optional<double> R =
      extremes.size() == unknowns ? exact_R(extremes, zero_offset) : least_squares_R(model);
  if (!R || !(*R > 0.0) || !std::isfinite(*R)) return std::nullopt;
  Solution solution;
  solution.fit = model.fit(*R);
  solution.zeta = zeta_of(*R);
  solution.side = extremes[0] >= extremes[1] ? 1.0 : -1.0;
  const double X_0 = solution.fit.coefficients[0];
  const double drop = solution.fit.coefficients[1];
  solution.x_f = solution.side * (drop - (1.0 - *R) * X_0) / (1.0 + *R);
  return solution;
}

/// Covariance of (zeta, x_f) for unit variance of one extreme.
std::optional<Eigen::Matrix2d> unit_covariance(const DecayModel& model, const Solution& solution) {
  const Eigen::MatrixXd jacobian = model.jacobian(solution.fit);
  const Eigen::LLT<Eigen::MatrixXd> normal(jacobian.transpose() * jacobian);
  if (normal.info() != Eigen::Success) return std::nullopt;
  const double R = solution.fit.R;
  const double X_0 = solution.fit.coefficients[0];
  const double drop = solution.fit.coefficients[1];
  Eigen::MatrixXd to_friction = Eigen::MatrixXd::Zero(2, jacobian.cols());  // from (R, X_0, D, o)
  to_friction(0, 0) = zeta_slope(R);
  to_friction(1, 0) = solution.side * (2.0 * X_0 - drop) / ((1.0 + R) * (1.0 + R));
  to_friction(1, 1) = -solution.side * (1.0 - R) / (1.0 + R);
  to_friction(1, 2) = solution.side / (1.0 + R);
  const Eigen::MatrixXd half = normal.matrixL().solve(to_friction.transpose());
  return Eigen::Matrix2d(half.transpose() * half);
}

/// Fits, leaves out the extremes after the mass has stopped for good at the estimate, and fits again until none is
/// left out.
std::optional<Solution> solve_moving(Extremes& extremes, bool zero_offset, const KnownConstants& constants,
                                     Estimate& estimate) {
  while (enough(extremes, zero_offset ? 3 : 4, estimate)) {
    std::optional<Solution> solution = solve(extremes.values, zero_offset);
    if (!solution) {
      refuse(estimate,
             "no decay ratio between 0.005 and 1.5 fits the extremes: the swings do not shrink like a "
             "free vibration's");
      return std::nullopt;
    }
    const std::vector<double>& e = extremes.values;
    std::size_t moving = 1;
    for (double side = solution->side; moving < e.size(); ++moving, side = -side) {
      const double X = side * (e[moving - 1] - solution->offset());
      if (solution->x_f > 0.0 && !(X > solution->x_f)) break;
    }
    if (moving == e.size()) return solution;
    cut(extremes, moving,
        "the mass had stopped: extreme " + std::to_string(moving) + " is within x_f = " +
            core::format_number(solution->x_f * extremes.unit, 4) + " " + constants.unit("m") + " of the middle",
        estimate);
  }
  return std::nullopt;
}

/// The half swing lasts pi/(wn sqrt(1 - zeta^2)). If the time between two extremes is much longer, extremes may be
/// missing.
void judge_times(const DecayRecord& record, const Estimate& estimate, const KnownConstants& constants,
                 std::vector<std::string>& faults, std::vector<std::string>& warnings) {
  const std::size_t count = estimate.used.size();
  if (record.times.empty()) return;
  if (record.times.size() != record.extremes.size()) {
    faults.emplace_back("there are not as many times as extremes");
    return;
  }
  const double zeta = estimate.value.zeta;
  const double expected =
      pi * std::sqrt(constants.mass) / std::sqrt(constants.stiffness) / std::sqrt((1.0 - zeta) * (1.0 + zeta));
  std::vector<double> swings;
  for (std::size_t i = 1; i < count; ++i) {
    swings.push_back(record.times[i] - record.times[i - 1]);
    if (swings.back() > 2.0 * expected) {
      faults.push_back("extremes seem to be missing between " + std::to_string(i) + " and " +
                       std::to_string(i + 1));
      return;
    }
  }
  // The first may belong to a release by hand, the last to a mass that no longer moves.
  const double swing = upper_median(std::move(swings));
  if (std::abs(swing / expected - 1.0) > 0.02) {
    warnings.push_back("half swings last " + core::format_number(swing, 4) +
                       " s, and mass, stiffness and zeta say " + core::format_number(expected, 4) + " s");
  }
}

/// Estimates from each four successive extremes, "1-4", "2-5", ...: the classical way to use more than four.
void list_windows(const Extremes& extremes, const KnownConstants& constants, Estimate& estimate) {
  const int windows = static_cast<int>(extremes.values.size()) - 3;
  if (windows < 2) return;
  for (int first = 0; first < std::min(windows, most_windows); ++first) {
    const std::optional<Solution> solution =
        solve(std::span(extremes.values).subspan(static_cast<std::size_t>(first), 4), false);
    if (!solution) continue;
    estimate.subsets.push_back({std::to_string(first + 1) + "-" + std::to_string(first + 4), 4,
                                parameters(solution->zeta, solution->x_f * extremes.unit, constants)});
  }
}

void add_uncertainty(const DecayModel& model, const Solution& solution, const FreeDecayOptions& options,
                     double unit, const KnownConstants& constants, Estimate& estimate) {
  const auto freedom = static_cast<double>(estimate.used.size()) - (options.zero_offset ? 3.0 : 4.0);
  const bool known = options.sigma_x > 0.0;
  if (!known && freedom < 1.0) return;
  const double deviation = known ? options.sigma_x / unit : solution.fit.residual.norm() / std::sqrt(freedom);
  if (known && freedom >= 1.0)
    warn_of_scatter(solution.fit.residual.squaredNorm() / freedom / (deviation * deviation), freedom, estimate);
  const std::optional<Eigen::Matrix2d> covariance = unit_covariance(model, solution);
  if (!covariance) return;
  const Eigen::DiagonalMatrix<double, 2> to_metres(deviation, deviation * unit);
  set_uncertainty(estimate, to_metres * *covariance * to_metres, known ? normal95() : quantile95(freedom),
                  constants);
}

DecayFit decay_fit(const Solution& solution, std::size_t unknowns, double unit) {
  DecayFit fit;
  fit.R = solution.fit.R;
  fit.first_amplitude = solution.first_amplitude() * unit;
  fit.offset = solution.offset() * unit;
  const auto count = static_cast<std::size_t>(solution.fit.residual.size());
  if (count > unknowns) {
    fit.residual_deviation = solution.fit.residual.norm() / std::sqrt(static_cast<double>(count - unknowns)) * unit;
  }
  for (const double residual : solution.fit.residual) fit.residuals.push_back(residual * unit);
  return fit;
}

}  // namespace

Estimate free_decay(const Record& record, const KnownConstants& constants, const FreeDecayOptions& options) {
  Estimate estimate;
  estimate.method = free_decay_method.name;
  std::optional<Extremes> extremes = take_extremes(record, constants, estimate);
  if (!extremes) return estimate;
  const std::optional<Solution> solution = solve_moving(*extremes, options.zero_offset, constants, estimate);
  if (!solution) return estimate;
  const DecayModel model(extremes->values, options.zero_offset);
  estimate.value = parameters(solution->zeta, solution->x_f * extremes->unit, constants);
  for (std::size_t i = 0; i < extremes->values.size(); ++i) estimate.used.push_back(static_cast<int>(i) + 1);
  estimate.decay = decay_fit(*solution, options.zero_offset ? 3 : 4, extremes->unit);
  add_uncertainty(model, *solution, options, extremes->unit, constants, estimate);

  std::vector<std::string> faults;
  const double X_0 = std::abs(solution->first_amplitude());
  judge_signs(estimate, X_0 * extremes->unit, faults);
  judge_times(*record.decay, estimate, constants, faults, estimate.warnings);
  estimate.lack_of_fit = added_term_test(model.jacobian(solution->fit), solution->fit.residual,
                                         model.cubic_term(solution->fit), 2.0 * X_0, "cubic term F-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired) {
    estimate.findings.emplace_back(
        "the extremes do not decay as viscous and Coulomb friction make them, so no single zeta and F0 "
        "describes them (see the estimates from each four)");
  }
  list_windows(*extremes, constants, estimate);
  conclude(estimate, faults,
           "rests on " + std::to_string(estimate.used.size()) + " of " +
               std::to_string(record.decay->extremes.size()) + " extremes");
  return estimate;
}

constinit const MethodEntry free_decay_method{
    .name = "free_decay",
    .summary = "damping ratio and friction force from the decrements of a free vibration",
    .assumes =
        "linear spring, zeta < 1, the mass moves through every half swing; checked: extremes alternate, extremes after "
        "the stop are left out, half period against mass and stiffness, cubic term F-test",
    .equation =
        "X_(i+1) = R X_i - x_f (1 + R), R = exp(-pi zeta/sqrt(1 - zeta^2)); R = -(e_3 - e_1)/(e_2 - e_0) of signed "
        "extremes e about any offset",
    .sources = "feeny1996decrement, liang1998decrement",
    .needs = RecordKind::decay,
    .lacks = lacks_decay,
    .call = call_of<free_decay>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
