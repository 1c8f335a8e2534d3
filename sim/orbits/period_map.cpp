#include "sim/orbits/period_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/engine/eigenvalues.hpp"

namespace dualdamp::sim {

using friction::Direction;

double distance(const State& a, const State& b, double size, double omega) {
  const double scale = std::max(size, std::abs(a.v) / omega);
  if (!same_mode(a, b)) return std::numeric_limits<double>::infinity();
  const double x_gap = (b.x - a.x) / scale;
  const double v_gap = (b.v - a.v) / omega / scale;
  double result = scale > 0.0 ? std::sqrt(x_gap * x_gap + v_gap * v_gap) : 0.0;
  for (std::size_t i = 0; i < a.memories.size(); ++i) {
    const std::vector<double>& before = a.memories[i].state;
    const std::vector<double>& after = b.memories[i].state;
    for (std::size_t k = 0; k < before.size(); ++k) {
      // A state near zero may have the size of the motion and pass zero here.
      const double own = std::max({std::abs(before[k]), std::abs(after[k]), scale});
      if (own > 0.0) result = std::max(result, std::abs(after[k] - before[k]) / own);
    }
  }
  return result;
}

bool ForcingPeriod::ends_in_its_mode() const { return same_mode(begin, end); }

std::vector<std::complex<double>> ForcingPeriod::multipliers() const {
  if (!ends_in_its_mode()) return {};
  if (monodromy.rows() == 2 && monodromy.cols() == 2) {
    // Without law states there are two eigenvalues: a quadratic equation is cheaper than a general solver.
    const double half_trace = 0.5 * (monodromy(0, 0) + monodromy(1, 1));
    const double half_gap = 0.5 * (monodromy(0, 0) - monodromy(1, 1));
    const std::complex<double> root =
        std::sqrt(std::complex<double>(half_gap * half_gap + monodromy(0, 1) * monodromy(1, 0)));
    return {half_trace + root, half_trace - root};
  }
  const Eigen::VectorXcd values = eigenvalues_of(monodromy);
  return {values.begin(), values.end()};
}

double ForcingPeriod::radius() const {
  if (!ends_in_its_mode() || !monodromy.allFinite()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const std::complex<double>& value : multipliers()) largest = std::max(largest, std::abs(value));
  return largest;
}

bool ForcingPeriod::holds(Eigen::Index row) const {
  if (row < 2 || monodromy.rows() != monodromy.cols()) return false;
  return monodromy(row, row) == 1.0 && (monodromy.row(row).array() != 0.0).count() == 1;
}

std::vector<Eigen::Index> ForcingPeriod::free_coordinates() const {
  std::vector<Eigen::Index> free;
  for (Eigen::Index row = 0; row < monodromy.rows(); ++row) {
    if (!holds(row)) free.push_back(row);
  }
  return free;
}

double ForcingPeriod::free_radius() const {
  if (!ends_in_its_mode() || !monodromy.allFinite()) return std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Index> free = free_coordinates();
  return eigenvalues_of(monodromy(free, free)).cwiseAbs().maxCoeff();
}

ForcingPeriod PeriodMap::pass(Monodromy monodromy, PeriodObserver* observer) {
  ForcingPeriod period;
  period.begin = engine_->state();
  period.peak = period.trough = engine_->position();
  engine_->track_sensitivity(monodromy == Monodromy::with);
  if (observer != nullptr) observer->begin(period.begin);
  const long last = engine_->periods_passed() + periods_;
  exhausted_ = {};
  while (engine_->periods_passed() < last) {
    if (engine_->work() > most_work_) {
      exhausted_ = {
          core::OutcomeKind::event_limit,
          "no steady state found: the computation was stopped: a forcing period has too many events or steps"};
      break;
    }
    const Interval* interval = engine_->next_in_period();
    if (interval == nullptr) break;
    period.moves = period.moves || interval->direction != Direction::none;
    period.peak = std::max(period.peak, engine_->position());
    period.trough = std::min(period.trough, engine_->position());
    if (observer != nullptr) observer->observe(*interval, engine_->position());
  }
  period.size = std::max(std::abs(period.peak), std::abs(period.trough));
  period.end = engine_->state();
  if (monodromy == Monodromy::with) period.monodromy = engine_->sensitivity();
  return period;
}

ForcingPeriod PeriodMap::from_start(double x, double v, Monodromy monodromy) {
  engine_->start(x, v);
  return pass(monodromy);
}

ForcingPeriod PeriodMap::from(const State& state, Monodromy monodromy, PeriodObserver* observer) {
  engine_->restart(state);
  return pass(monodromy, observer);
}

ForcingPeriod PeriodMap::next(Monodromy monodromy) { return pass(monodromy); }

Eigen::VectorXd coordinates(const State& state) {
  std::vector<double> list{state.x, state.v};
  for (const friction::Memory& memory : state.memories)
    list.insert(list.end(), memory.state.begin(), memory.state.end());
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

State displaced(const State& state, const Eigen::VectorXd& change) {
  State result = state;
  result.x += change[0];
  if (state.direction != Direction::none) result.v += change[1];
  if (state.turns_freely && result.v != 0.0)
    result.direction = result.v < 0.0 ? Direction::backward : Direction::forward;
  Eigen::Index next = 2;
  for (friction::Memory& memory : result.memories) {
    for (double& value : memory.state) value += change[next++];
  }
  return result;
}

namespace {

/// The power of two below |value|; 1 for zero and for what is no number.
double power_of_two(double value) {
  return value != 0.0 && std::isfinite(value) ? std::ldexp(1.0, std::ilogb(value)) : 1.0;
}

}  // namespace

Eigen::VectorXd sizes_of_coordinates(const ForcingPeriod& period, double omega) {
  const Eigen::MatrixXd& matrix = period.monodromy;
  const double length = power_of_two(std::max(period.size, std::abs(period.begin.v) / omega));
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(matrix.cols(), length);
  sizes[1] = length * power_of_two(omega);
  for (Eigen::Index i = 2; i < sizes.size(); ++i) {
    const double caused = std::abs(matrix(i, 0)) * sizes[0] + std::abs(matrix(i, 1)) * sizes[1];
    const double effect = std::abs(matrix(0, i)) / sizes[0] + std::abs(matrix(1, i)) / sizes[1];
    const bool acts = effect > 0.0 && caused > 0.0;
    sizes[i] = power_of_two(acts ? std::sqrt(caused / effect) : effect > 0.0 ? 1.0 / effect : caused);
  }
  return sizes;
}

Solution solve_in_sizes(const Eigen::MatrixXd& system, const Eigen::VectorXd& right, const Eigen::VectorXd& rows,
                        const Eigen::VectorXd& unknowns) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(rows.cwiseInverse().asDiagonal() * system * unknowns.asDiagonal());
  return {lu.solve(right.cwiseQuotient(rows)).cwiseProduct(unknowns), lu.isInvertible()};
}

Eigen::VectorXd newton_step(const ForcingPeriod& period, double omega) {
  if (!period.ends_in_its_mode()) return {};
  const Eigen::VectorXd gap = coordinates(period.end) - coordinates(period.begin);
  const Eigen::Index n = gap.size();
  // The matrix of a neighbour that sticks in another mode has other coordinates.
  if (period.monodromy.rows() != n || period.monodromy.cols() != n) return {};
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n) - period.monodromy;
  for (Eigen::Index row = 2; row < n; ++row) {
    if (gap[row] == 0.0 && period.holds(row)) system(row, row) = 1.0;
  }
  const Eigen::VectorXd sizes = sizes_of_coordinates(period, omega);
  Solution step = solve_in_sizes(system, gap, sizes, sizes);
  if (!step.is_unique || !step.value.allFinite()) return {};
  return std::move(step.value);
}

}  // namespace dualdamp::sim
