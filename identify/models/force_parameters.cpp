#include "identify/models/force_parameters.hpp"

#include <cmath>
#include <utility>

#include "identify/conclusion.hpp"
#include "identify/record.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

/// c of critical damping. Two roots, unlike critical_damping(): a search may try constants whose product leaves the
/// range of double precision.
double critical(const ForceParameters& force) { return 2.0 * std::sqrt(force.m) * std::sqrt(force.k); }

}  // namespace

ParameterSet parameters(const ForceParameters& force) {
  const bool sprung = force.k > 0.0;
  return {sprung ? force.c / critical(force) : unknown, force.c, sprung ? force.F0 / force.k : unknown, force.F0};
}

void set_estimate(Estimate& estimate, const ForceParameters& force, const Eigen::Matrix4d& covariance,
                  double half_width, const ForceParameters& bias) {
  estimate.value = parameters(force);
  const ParameterSet& value = estimate.value;
  // Rows: derivatives of zeta and x_f by (m, c, k, F0).
  const Eigen::RowVector4d to_zeta(-0.5 * value.zeta / force.m, 1.0 / critical(force), -0.5 * value.zeta / force.k,
                                   0.0);
  const Eigen::RowVector4d to_x_f(0.0, 0.0, -value.x_f / force.k, 1.0 / force.k);
  const auto deviation = [&](const Eigen::RowVector4d& row) {
    return std::sqrt(row.dot((covariance * row.transpose()).transpose()));
  };
  const bool sprung = force.k > 0.0;
  const ParameterSet error{sprung ? deviation(to_zeta) : unknown, std::sqrt(covariance(1, 1)),
                           sprung ? deviation(to_x_f) : unknown, std::sqrt(covariance(3, 3))};
  estimate.std = error;
  const ParameterSet middle =
      parameters({force.m - bias.m, force.c - bias.c, force.k - bias.k, force.F0 - bias.F0});
  estimate.interval95 = around(middle, error, half_width);
  // Without a spring there is no zeta, and no correlation with it.
  if (!sprung) return;
  const double mixed = to_zeta.dot(covariance.col(3));
  Eigen::Matrix2d of_pair;
  of_pair << error.zeta * error.zeta, mixed, mixed, error.F0 * error.F0;
  estimate.covariance = of_pair;
  if (error.zeta > 0.0 && error.F0 > 0.0) estimate.correlation = mixed / (error.zeta * error.F0);
}

FurtherParameter further(std::string name, std::string unit, double value, double variance, double half_width) {
  const double std = std::sqrt(variance);
  return {std::move(name), std::move(unit), value, std, around(value, half_width * std)};
}

void judge_force_signs(Estimate& estimate, double scale_c, double scale_F0, std::vector<std::string>& faults) {
  const bool known = estimate.interval95.has_value();
  judge_sign(estimate.value.c, scale_c, known ? &estimate.interval95->c : nullptr, "the viscous damping", estimate,
             faults);
  judge_sign(estimate.value.F0, scale_F0, known ? &estimate.interval95->F0 : nullptr, "the Coulomb friction",
             estimate, faults);
}

}  // namespace dualdamp::identify
