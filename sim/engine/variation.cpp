#include "sim/engine/variation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "sim/engine/eigenvalues.hpp"
#include "sim/engine/fast_turns.hpp"
#include "sim/steppers/lu_factors.hpp"
#include "sim/steppers/radau_collocation.hpp"

namespace dualdamp::sim {
namespace {

using Vector = std::vector<double>;
/// J varies smoothly over a part of a step if h J is told by a cubic to this, relative to the rates of both
/// components; the error of a column is then far below.
constexpr double told_by_cubic = 1e-4;
/// A perturbation that turns by this angle [rad] within a part is followed to 3e-9; one by 3.5 to 4e-4.
constexpr double followed = 1.0;
/// With a real part of h times the eigenvalue below that nothing is left of a motion behind the part. The method
/// leaves 5/|z|, which the next parts take away: it is not followed.
constexpr double died_out = -20.0;
/// From this angle [rad] on the exponential of J is tried before the part is halved.
constexpr double fast = 6.0;
/// The shortest part of a step.
constexpr int most_halvings = 20;
/// Operations of a solver of eigenvalues, in cubes of the number of rows.
constexpr long cubes_of_eigenvalues = 25;

/// sum_j slopes_ij u_j = h (J_i (column + u_i) + forcing_i) in every stage i; a set of s states is stored one after
/// the other. Components that nothing changes, as the sliders that stick, are left out of these equations: u = 0.
template <std::size_t N>
class RadauVariation final : public Variation {
 public:
  explicit RadauVariation(std::size_t n)
      : n_(extent<N>(n)),
        state_(n),
        later_(n),
        earlier_(n),
        jacobians_(radau_stages * n * n),
        forcing_(radau_stages * n),
        right_(radau_stages * n),
        matrix_(radau_stages * n * radau_stages * n),
        factors_(radau_stages * n) {
    for (std::size_t k = 0; k < n; ++k) changing_.push_back(k);
  }

  [[nodiscard]] bool pass(const VectorField& field, const TakenStep& step, std::span<double> columns,
                          std::span<double> late) override {
    std::ranges::fill(late, 0.0);
    pass_part(field, step, {0.0, 1.0}, columns, late, most_halvings);
    const auto is_finite = [](double value) { return std::isfinite(value); };
    return std::ranges::all_of(columns, is_finite) && std::ranges::all_of(late, is_finite);
  }

  [[nodiscard]] long parts() const override { return parts_; }
  [[nodiscard]] long operations() const override { return operations_ + fast_turns_.operations(); }

 private:
  /// A part of a step: where it begins and its length, both over the step's.
  struct Part {
    double from = 0.0;
    double length = 1.0;
  };

  void pass_part(const VectorField& field, const TakenStep& step, Part part, std::span<double> columns,
                 std::span<double> late, int halvings) {
    linearise(field, step, part);
    const bool changes = hides_change(step.sizes);
    const double turn = changes ? 0.0 : largest_turn(step.sizes);
    if (turn > fast && pass_fast(columns, late)) return;
    if (halvings > 0 && (changes || turn > followed)) {
      const double half = 0.5 * part.length;
      pass_part(field, step, {part.from, half}, columns, late, halvings - 1);
      pass_part(field, step, {part.from + half, half}, columns, late, halvings - 1);
      return;
    }
    factorise();
    for (std::size_t first = 0; first < columns.size(); first += n_()) {
      const std::span<double> column = columns.subspan(first, n_());
      multiply(column);
      add_change(column);
    }
    multiply(late);
    for (std::size_t i = 0; i < radau_stages; ++i)
      for (std::size_t k = 0; k < rows(); ++k) right_[i * rows() + k] += forcing_[i * n_() + changing_[k]];
    add_change(late);
  }

  /// Jacobians h J_i and h df/dt of the stages.
  void linearise(const VectorField& field, const TakenStep& step, Part part) {
    ++parts_;
    const double h = step.h * part.length;
    for (std::size_t i = 0; i < radau_stages; ++i) {
      const double at = part.from + radau_.nodes[i] * part.length;
      step.stepper.at(at, state_);
      const double t = step.t + at * step.h;
      const std::span<double> jacobian = std::span(jacobians_).subspan(i * n_() * n_(), n_() * n_());
      field.close_jacobian(state_, t, jacobian);
      for (double& entry : jacobian) entry *= h;
      field.evaluate(state_, t + step.increment, later_);
      field.evaluate(state_, t - step.increment, earlier_);
      for (std::size_t k = 0; k < n_(); ++k)
        forcing_[i * n_() + k] = h * (later_[k] - earlier_[k]) / (2.0 * step.increment);
    }
    if constexpr (N == any_size) find_changing();
  }

  void find_changing() {
    changing_.clear();
    for (std::size_t j = 0; j < n_(); ++j) {
      bool changes = false;
      for (std::size_t i = 0; i < radau_stages && !changes; ++i) {
        changes = forcing_[i * n_() + j] != 0.0;
        for (std::size_t k = 0; k < n_() && !changes; ++k) changes = jacobian(i, j, k) != 0.0;
      }
      if (changes) changing_.push_back(j);
    }
  }

  /// Number of components that change.
  [[nodiscard]] std::size_t rows() const {
    if constexpr (N == any_size)
      return changing_.size();
    else
      return N;
  }

  /// By the exponential of J; false: the part is as it was.
  [[nodiscard]] bool pass_fast(std::span<double> columns, std::span<double> late) {
    const auto n = static_cast<Eigen::Index>(n_());
    const auto count = static_cast<Eigen::Index>(columns.size()) / n;
    using Set = Eigen::Map<Eigen::MatrixXd>;
    Eigen::MatrixXd before(n, count + 1);
    before << Set(columns.data(), n, count), Set(late.data(), n, 1);
    std::vector<Eigen::MatrixXd> jacobians;
    for (std::size_t i = 0; i < radau_stages; ++i)
      jacobians.emplace_back(Set(jacobians_.data() + i * n_() * n_(), n, n));
    const auto after =
        fast_turns_.pass({jacobians, Set(forcing_.data(), n, static_cast<Eigen::Index>(radau_stages))}, before);
    if (!after) return false;
    Set(columns.data(), n, count) = after->leftCols(count);
    Set(late.data(), n, 1) = after->col(count);
    return true;
  }

  /// h J_i from component k to component j.
  [[nodiscard]] double jacobian(std::size_t i, std::size_t j, std::size_t k) const {
    return jacobians_[(i * n_() + k) * n_() + j];
  }

  /// Whether an entry of J at one stage is not what a cubic through the other stages makes it.
  [[nodiscard]] bool hides_change(std::span<const double> sizes) const {
    for (std::size_t j = 0; j < n_(); ++j) {
      for (std::size_t k = 0; k < n_(); ++k) {
        double rest = 0.0;
        double rate = 1.0;
        for (std::size_t i = 0; i < radau_stages; ++i) {
          rest += residual_[i] * jacobian(i, j, k);
          rate = std::max({rate, std::abs(jacobian(i, j, j)), std::abs(jacobian(i, k, k))});
        }
        if (std::abs(rest) * sizes[k] > told_by_cubic * rate * sizes[j]) return true;
      }
    }
    return false;
  }

  /// The largest angle [rad] by which a perturbation turns within the part. The motion need not: an attached mass
  /// that has come to rest, a bristle in its balance.
  [[nodiscard]] double largest_turn(std::span<const double> sizes) {
    double turn = 0.0;
    for (std::size_t i = 0; i < radau_stages; ++i) {
      if (!(largest_cycle(i) > followed) || is_as_before(i)) continue;
      for (const std::complex<double>& z : eigenvalues(i, sizes))
        if (z.real() > died_out) turn = std::max(turn, std::abs(z.imag()));
    }
    return turn;
  }

  /// Whether J at stage i is that at the stage before it.
  [[nodiscard]] bool is_as_before(std::size_t i) const {
    const std::span<const double> all = jacobians_;
    const std::size_t size = n_() * n_();
    return i > 0 && std::ranges::equal(all.subspan(i * size, size), all.subspan((i - 1) * size, size));
  }

  /// About the largest eigenvalue of h J_i; it needs no sizes. Components that act on each other in a ring of
  /// three, and in no pair, would be missed; no law has them.
  [[nodiscard]] double largest_cycle(std::size_t i) const {
    double largest = 0.0;
    for (std::size_t j = 0; j < n_(); ++j) {
      double sum = std::abs(jacobian(i, j, j));
      for (std::size_t k = 0; k < n_(); ++k)
        if (k != j) sum += std::sqrt(std::abs(jacobian(i, j, k) * jacobian(i, k, j)));
      largest = std::max(largest, sum);
    }
    return largest;
  }

  /// Of h J_i, each component in its own size. Those of components that do not change are zero.
  [[nodiscard]] Eigen::VectorXcd eigenvalues(std::size_t i, std::span<const double> sizes) {
    const auto n = static_cast<long>(rows());
    operations_ += cubes_of_eigenvalues * n * n * n;
    return eigenvalues_of(Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index row, Eigen::Index column) {
      const std::size_t j = changing_[static_cast<std::size_t>(row)];
      const std::size_t k = changing_[static_cast<std::size_t>(column)];
      return jacobian(i, j, k) * sizes[k] / sizes[j];
    }));
  }

  /// Of the equations of all stages.
  void factorise() {
    const std::size_t m = rows();
    const std::size_t size = m * radau_stages;
    if constexpr (N == any_size) {
      if (factored_ != size) factors_ = LuFactors<double, any_size>(size);
      factored_ = size;
    }
    const std::span<double> matrix = std::span(matrix_).first(size * size);
    std::ranges::fill(matrix, 0.0);
    for (std::size_t i = 0; i < radau_stages; ++i) {
      // With the other sign: the factors are those of 0 - matrix.
      for (std::size_t j = 0; j < radau_stages; ++j)
        for (std::size_t k = 0; k < m; ++k) matrix[(j * m + k) * size + i * m + k] = -radau_.slopes[i][j];
      for (std::size_t k = 0; k < m; ++k)
        for (std::size_t j = 0; j < m; ++j)
          matrix[(i * m + k) * size + i * m + j] += jacobian(i, changing_[j], changing_[k]);
    }
    factors_.compute(0.0, matrix);
    const auto rows_of_all = static_cast<long>(size);
    operations_ += rows_of_all * rows_of_all * rows_of_all;
  }

  /// right_ = h J_i times a column in every stage.
  void multiply(std::span<const double> column) {
    std::ranges::fill(right_, 0.0);
    for (std::size_t i = 0; i < radau_stages; ++i)
      for (std::size_t k = 0; k < n_(); ++k)
        for (std::size_t j = 0; j < rows(); ++j) right_[i * rows() + j] += jacobian(i, changing_[j], k) * column[k];
  }

  /// The last stage of what right_ makes.
  void add_change(std::span<double> column) {
    factors_.solve(right_.data());
    for (std::size_t k = 0; k < rows(); ++k) column[changing_[k]] += right_[(radau_stages - 1) * rows() + k];
  }

  /// The fourth divided difference over the stages, its largest weight 1.
  static RadauCollocation::Row fourth_difference() {
    RadauCollocation::Row weights{};
    for (std::size_t i = 0; i < radau_stages; ++i) {
      weights[i] = 1.0;
      for (std::size_t j = 0; j < radau_stages; ++j)
        if (j != i) weights[i] /= RadauCollocation::once().nodes[i] - RadauCollocation::once().nodes[j];
    }
    double largest = 0.0;
    for (const double weight : weights) largest = std::max(largest, std::abs(weight));
    for (double& weight : weights) weight /= largest;
    return weights;
  }

  const RadauCollocation& radau_ = RadauCollocation::once();
  const RadauCollocation::Row residual_ = fourth_difference();
  Extent<N> n_;
  long parts_ = 0;
  long operations_ = 0;
  FastTurns fast_turns_;
  std::vector<std::size_t> changing_;  ///< components that change within the part
  std::size_t factored_ = N * radau_stages;
  Vector state_;
  Vector later_;
  Vector earlier_;
  Vector jacobians_;
  Vector forcing_;
  Vector right_;
  Vector matrix_;
  LuFactors<double, N * radau_stages> factors_;
};

}  // namespace

std::unique_ptr<Variation> make_variation(std::size_t size) {
  switch (size) {
    case 2:
      return std::make_unique<RadauVariation<2>>(size);
    case 3:
      return std::make_unique<RadauVariation<3>>(size);
    case 4:
      return std::make_unique<RadauVariation<4>>(size);
    default:
      return std::make_unique<RadauVariation<any_size>>(size);
  }
}

}  // namespace dualdamp::sim
