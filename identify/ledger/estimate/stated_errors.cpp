#include "identify/ledger/estimate/stated_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

namespace {

/// The coefficient of a relaxation where the model is linearised.
double coefficient_of(const JointModel& model, std::size_t number) {
  return model.coefficients.size() == 0 ? 0.0 : model.coefficients[static_cast<Eigen::Index>(number)];
}

/// Which relaxations are free, bound by a stated deviation, or held at the stated number.
class StatedErrors {
 public:
  StatedErrors(const JointModel& model, const Taken& taken, const StatedShares& shares) : model_(model) {
    deviations_.assign(model.relaxations.size(), 0.0);
    const auto stated_of = [&](std::size_t j) {
      const Relaxation& relaxation = model.relaxations[j];
      return relaxation.stated == nullptr ? 0.0 : shares.relative(relaxation.stated) * relaxation.stated_unit;
    };
    for (std::size_t j = 0; j < deviations_.size(); ++j)
      if (std::abs(coefficient_of(model, j)) < shares.allowed() * model.relaxations[j].stated_unit)
        deviations_[j] = stated_of(j);
    for (std::size_t j = 0; j < deviations_.size(); ++j)
      if (deviations_[j] > 0.0) bound_.push_back(j);
    for (const std::size_t j : taken) {
      const bool is_exact = model.relaxations[j].stated != nullptr && !(stated_of(j) > 0.0);
      if (!(deviations_[j] > 0.0)) (is_exact && !bound_.empty() ? exact_ : free_).push_back(j);
    }
  }

  [[nodiscard]] bool has_exact() const { return !exact_.empty(); }

  /// All exact numbers free.
  [[nodiscard]] std::optional<Solution> with_exact_free() const {
    Taken free = free_;
    free.insert(free.end(), exact_.begin(), exact_.end());
    std::optional<Solution> found = solution(free, model_.residuals, 1.0);
    if (!found || model_.is_stated) return found;
    const double variance = found->squares_of_rows / found->freedom;
    return bound_.empty() ? (found->variance = variance, found) : solution(free, model_.residuals, variance);
  }

  /// All exact numbers as stated.
  [[nodiscard]] std::optional<Solution> with_exact_held(double variance) const {
    Eigen::VectorXd residuals = model_.residuals;
    for (const std::size_t j : exact_)
      residuals += coefficient_of(model_, j) * model_.relaxed.col(static_cast<Eigen::Index>(j));
    return solution(free_, residuals, variance);
  }

 private:
  /// Rows of the bound errors, over their deviations, stand below those of the record.
  [[nodiscard]] std::optional<Solution> solution(Taken free, const Eigen::VectorXd& residuals,
                                                 double variance) const {
    const auto more = static_cast<Eigen::Index>(bound_.size());
    const double freedom = static_cast<double>(residuals.size() - model_.base.cols()) -
                           static_cast<double>(free.size()) - model_.spent;
    free.insert(free.end(), bound_.begin(), bound_.end());
    const Eigen::MatrixXd own = free_columns(model_.base, model_.relaxed, free);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(own.rows() + more, own.cols());
    Eigen::VectorXd target(own.rows() + more);
    columns.topRows(own.rows()) = own;
    target.head(own.rows()) = residuals;
    for (Eigen::Index i = 0; i < more; ++i) {
      const std::size_t number = bound_[static_cast<std::size_t>(i)];
      const double weight = std::sqrt(variance) / deviations_[number];
      columns(own.rows() + i, own.cols() - more + i) = weight;
      target[own.rows() + i] = -weight * coefficient_of(model_, number);
    }
    std::optional<Eigen::MatrixXd> covariance = unit_covariance(columns);
    if (!covariance || freedom < 1.0) return std::nullopt;
    Solution found{.free = std::move(free), .variance = variance, .freedom = freedom};
    found.step = *covariance * (columns.transpose() * target);
    found.covariance = std::move(*covariance);
    const Eigen::VectorXd left = target - columns * found.step;
    found.squares_of_rows = left.head(own.rows()).squaredNorm();
    found.squares = left.squaredNorm();
    return found;
  }

  const JointModel& model_;
  std::vector<double> deviations_;  ///< of the coefficient of each relaxation; 0: not bound
  Taken bound_, exact_, free_;
};

}  // namespace

std::optional<Solution> solved(const JointModel& model, const Taken& taken, const StatedShares& shares) {
  const StatedErrors errors(model, taken, shares);
  std::optional<Solution> free = errors.with_exact_free();
  if (!free || !errors.has_exact()) return free;
  std::optional<Solution> held = errors.with_exact_held(free->variance);
  constexpr double as_well = counted_deviations * counted_deviations;
  return held && held->squares < free->squares + as_well * free->variance ? held : free;
}

bool knows_stated_errors(const JointModel& model) {
  return std::ranges::any_of(model.relaxations,
                             [](const Relaxation& relaxation) { return relaxation.stated != nullptr; });
}

}  // namespace dualdamp::identify
