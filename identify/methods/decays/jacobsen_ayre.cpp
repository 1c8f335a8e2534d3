#include "identify/methods/decays/jacobsen_ayre.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/decays/extremes.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

using std::numbers::pi;

struct Friction {
  double zeta = 0.0;
  double x_f = 0.0;
};

/// X: magnitudes, at least three.
Friction rule_of_thumb(const std::vector<double>& X) {
  const std::size_t n = X.size();
  return {std::log(X[0] / X[2]) / core::two_pi, (X[n - 3] - X[n - 1]) / 4.0};
}

/// The numbers without the bias that each makes in the other; nothing when the large swings are not larger than the
/// small ones, because the two equations are then the same.
std::optional<Friction> corrected(const Friction& crude, const std::vector<double>& X) {
  const double to_zeta = 2.0 / (pi * X[1]);           // of x_f
  const double to_x_f = 0.5 * pi * X[X.size() - 2];   // of zeta
  const double determinant = 1.0 - to_zeta * to_x_f;  // 1 - X_small/X_large
  constexpr double least = 0.05;
  if (!(determinant > least)) return std::nullopt;
  return Friction{(crude.zeta - to_zeta * crude.x_f) / determinant,
                  (crude.x_f - to_x_f * crude.zeta) / determinant};
}

/// From the standard deviation of one extreme.
Eigen::Matrix2d covariance(const std::vector<double>& X, double deviation) {
  const auto n = static_cast<Eigen::Index>(X.size());
  Eigen::Matrix2Xd jacobian = Eigen::Matrix2Xd::Zero(2, n);
  jacobian(0, 0) = 1.0 / (core::two_pi * X[0]);
  jacobian(0, 2) = -1.0 / (core::two_pi * X[2]);
  jacobian(1, n - 3) = 0.25;
  jacobian(1, n - 1) = -0.25;
  return deviation * deviation * jacobian * jacobian.transpose();
}

/// The bias of the rule, computed from the corrected numbers.
void judge_bias(const Friction& crude, const std::optional<Friction>& better, Estimate& estimate,
                std::vector<std::string>& faults) {
  if (!better || !(better->zeta > 0.0) || !(better->x_f > 0.0)) {
    faults.emplace_back("these extremes do not determine the bias of the rule");
    return;
  }
  const double zeta_bias = crude.zeta / better->zeta - 1.0;
  const double x_f_bias = crude.x_f / better->x_f - 1.0;
  const std::string text = "the rule takes one friction for the other: zeta is about " +
                           core::signed_percent(zeta_bias, 3) + " off and F0 about " +
                           core::signed_percent(x_f_bias, 3) + " (free_decay is not)";
  constexpr double largest = 0.1;
  if (std::max(std::abs(zeta_bias), std::abs(x_f_bias)) > largest)
    faults.push_back(text);
  else
    estimate.warnings.push_back(text);
}

}  // namespace

Estimate jacobsen_ayre(const Record& record, const KnownConstants& constants, const JacobsenAyreOptions& options) {
  Estimate estimate;
  estimate.method = jacobsen_ayre_method.name;
  if (std::string lack = lacks_decay(record); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return estimate;
  }
  const std::optional<Extremes> extremes = take_extremes(record, constants, estimate);
  if (!extremes || !enough(*extremes, 3, estimate)) return estimate;
  std::vector<double> X;
  for (const double value : extremes->values) X.push_back(std::abs(value));
  if (!(X[2] > 0.0) || !(X[0] > X[2]) || !(X[X.size() - 3] > X[X.size() - 1])) {
    refuse(estimate, "the swings do not shrink");
    return estimate;
  }
  const Friction crude = rule_of_thumb(X);
  const std::optional<Friction> better = corrected(crude, X);
  estimate.value = parameters(crude.zeta, crude.x_f * extremes->unit, constants);
  for (std::size_t i = 0; i < X.size(); ++i) estimate.used.push_back(static_cast<int>(i) + 1);
  if (better)
    estimate.subsets.push_back({"corrected", static_cast<int>(X.size()),
                                parameters(better->zeta, better->x_f * extremes->unit, constants)});
  if (options.sigma_x > 0.0) {
    const Eigen::DiagonalMatrix<double, 2> to_metres(1.0, extremes->unit);
    set_uncertainty(estimate, to_metres * covariance(X, options.sigma_x / extremes->unit) * to_metres, normal95(),
                    constants);
  }
  std::vector<std::string> faults;
  judge_bias(crude, better, estimate, faults);
  conclude(estimate, faults, "rests on the first and the last three of " + std::to_string(X.size()) + " extremes");
  return estimate;
}

constinit const MethodEntry jacobsen_ayre_method{
    .name = "jacobsen_ayre",
    .summary =
        "rule of thumb: damping ratio from the large swings, friction from the small ones; biased, a baseline",
    .assumes =
        "viscous damping alone rules the first two swings, dry friction alone the last two, extremes about zero; "
        "checked: extremes alternate, the bias that follows from the estimate itself",
    .equation = "zeta = ln(X_0/X_2)/(2 pi), x_f = (X_(n-3) - X_(n-1))/4",
    .sources = "jacobsen1958, liang1998decrement",
    .needs = RecordKind::decay,
    .lacks = lacks_decay,
    .call = call_of<jacobsen_ayre>,
    .rests_on = AssumptionSet::all_but(Assumption::drive),
};

}  // namespace dualdamp::identify
