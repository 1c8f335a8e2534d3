#include "identify/ledger/misfit.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/assumption.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

namespace {

/// Relative change of zeta or F0 by an error of this length along their columns. A value smaller than its standard
/// error counts as that error.
double largest_change(const JointModel& model, const Eigen::MatrixXd& columns, double length) {
  const std::optional<Eigen::MatrixXd> covariance = unit_covariance(columns);
  if (!covariance) return core::infinity;
  const auto change = [&](Eigen::Index j, double value) {
    const double unit = std::sqrt((*covariance)(j, j));
    return length * unit / std::max(std::abs(value), unit);
  };
  return std::max(change(0, model.value.zeta), change(1, model.value.F0));
}

/// Of the channel that the model misses most, whether by chance or not. Nothing: its noise is not known.
std::optional<Misfit> largest_misfit(const JointModel& model, const Taken& taken) {
  const Eigen::MatrixXd columns = free_columns(model.base, model.relaxed, taken);
  const double freedom = static_cast<double>(columns.rows() - columns.cols()) - model.spent;
  if (model.known_noise.empty() || freedom < 1.0) return std::nullopt;
  const Eigen::VectorXd left = left_beside(columns, model.residuals);
  // Each channel is tested against its own noise: of few states the noise is known to a factor only, which one sum
  // over both would have for the better known.
  Misfit misfit{1.0, 0.0};
  Eigen::Index first = 0;
  for (const KnownNoise& noise : model.known_noise) {
    const double own = freedom * static_cast<double>(noise.rows) / static_cast<double>(left.size());
    const double F = left.segment(first, noise.rows).squaredNorm() / own;
    const double tests = static_cast<double>(model.known_noise.size()) / misfit_share;
    const double p_value = std::min(1.0, tests * f_test_p_value(F, own, noise.freedom));
    if (p_value < misfit.p_value) misfit = {p_value, std::sqrt(F)};
    first += noise.rows;
  }
  return misfit;
}

/// Whether an error as long as the misfit could change zeta or F0 by this much.
bool matters(const JointModel& model, const Taken& taken, double least_change) {
  const Eigen::MatrixXd columns = free_columns(model.base, model.relaxed, taken);
  const double freedom = static_cast<double>(columns.rows() - columns.cols()) - model.spent;
  const double squares = left_beside(columns, model.residuals).squaredNorm();
  return largest_change(model, columns, std::sqrt(std::max(0.0, squares - freedom))) >= least_change;
}

}  // namespace

std::optional<Misfit> misfit_of(const JointModel& model, const Taken& taken, double least_change) {
  const std::optional<Misfit> misfit = largest_misfit(model, taken);
  if (!misfit || !(misfit->p_value < family_level) || !matters(model, taken, least_change)) return std::nullopt;
  return misfit;
}

bool leaves_misfit(const JointModel& model, const Taken& taken, double least_change) {
  constexpr double most_times = 3.0;
  const std::optional<Misfit> left = largest_misfit(model, taken);
  return left && (left->p_value < family_level || left->times > most_times) && matters(model, taken, least_change);
}

std::string misfit_size(const Misfit& misfit) {
  return "the joint model misses these data by " + core::format_number(misfit.times, 2) + " times their noise (" +
         p_text(misfit.p_value) + ")";
}

namespace {

/// Is zeta or F0 fitted as negative by steady states that tell neither of them to its own size?
bool tells_nothing(const Estimate& joint) {
  const auto is_vague = [](double value, const Interval& interval) {
    return interval[1] - interval[0] > 2.0 * std::abs(value);
  };
  return (joint.value.zeta < 0.0 || joint.value.F0 < 0.0) && is_vague(joint.value.zeta, joint.interval95->zeta) &&
         is_vague(joint.value.F0, joint.interval95->F0);
}

}  // namespace

std::string fault_of_joint(const Ledger& ledger) {
  if (!ledger.joint || !ledger.joint->interval95) return {};
  if (!ledger.tests_histories && ledger.recorded.states && tells_nothing(*ledger.joint))
    return "the joint model fits these states best with negative friction, and they determine neither zeta nor F0; what "
           "would help: more states, or states over a wider range of levels and frequencies, and constants that are "
           "right";
  if (std::string beyond = beyond_motion(*ledger.joint, ledger.largest, ledger.coordinate); !beyond.empty())
    return "of the joint model " + beyond;
  if (!ledger.tests_histories) return {};
  const auto clearly_negative = [](double value, const Interval& interval) {
    return value + (interval[1] - interval[0]) < 0.0;
  };
  const bool gives_out_work = clearly_negative(ledger.joint->value.c, ledger.joint->interval95->c) ||
                              clearly_negative(ledger.joint->value.F0, ledger.joint->interval95->F0);
  return gives_out_work ? "the joint model fits these histories only with friction that is clearly negative, so a "
                          "constant, a unit or the drive is wrong, or friction is not Coulomb + viscous"
                        : "";
}

}  // namespace dualdamp::identify
