#include "sim/engine/variation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "sim/engine/eigenvalues.hpp"
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
/// The shortest part of a step.
constexpr int most_halvings = 20;

/// sum_j slopes_ij u_j = h (J_i (column + u_i) + forcing_i) in every stage i; a set of s states is stored one after
/// the other.
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
        factors_(radau_stages * n) {}

  [[nodiscard]] bool pass(const VectorField& field, const TakenStep& step, std::span<double> columns,
                          std::span<double> late) override {
    std::ranges::fill(late, 0.0);
    pass_part(field, step, {0.0, 1.0}, columns, late, most_halvings);
    const auto is_finite = [](double value) { return std::isfinite(value); };
    return std::ranges::all_of(columns, is_finite) && std::ranges::all_of(late, is_finite);
  }

  [[nodiscard]] long parts() const override { return parts_; }

 private:
  /// A part of a step: where it begins and its length, both over the step's.
  struct Part {
    double from = 0.0;
    double length = 1.0;
  };

  void pass_part(const VectorField& field, const TakenStep& step, Part part, std::span<double> columns,
                 std::span<double> late, int halvings) {
    linearise(field, step, part);
    if (halvings > 0 && (hides_change(step.sizes) || hides_turn(step.sizes))) {
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
    for (std::size_t k = 0; k < right_.size(); ++k) right_[k] += forcing_[k];
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
      field.jacobian(state_, t, jacobian);
      for (double& entry : jacobian) entry *= h;
      field.evaluate(state_, t + step.increment, later_);
      field.evaluate(state_, t - step.increment, earlier_);
      for (std::size_t k = 0; k < n_(); ++k)
        forcing_[i * n_() + k] = h * (later_[k] - earlier_[k]) / (2.0 * step.increment);
    }
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

  /// Whether a perturbation turns within the part faster than five stages tell. The motion need not: an attached
  /// mass that has come to rest, a bristle in its balance.
  [[nodiscard]] bool hides_turn(std::span<const double> sizes) const {
    for (std::size_t i = 0; i < radau_stages; ++i) {
      if (!(largest_cycle(i) > followed)) continue;
      for (const std::complex<double>& z : eigenvalues(i, sizes))
        if (std::abs(z.imag()) > followed && z.real() > died_out) return true;
    }
    return false;
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

  /// Of h J_i, each component in its own size.
  [[nodiscard]] Eigen::VectorXcd eigenvalues(std::size_t i, std::span<const double> sizes) const {
    const auto n = static_cast<Eigen::Index>(n_());
    return eigenvalues_of(Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index row, Eigen::Index column) {
      const auto j = static_cast<std::size_t>(row);
      const auto k = static_cast<std::size_t>(column);
      return jacobian(i, j, k) * sizes[k] / sizes[j];
    }));
  }

  /// Of the equations of all stages.
  void factorise() {
    const std::size_t size = n_() * radau_stages;
    std::ranges::fill(matrix_, 0.0);
    for (std::size_t i = 0; i < radau_stages; ++i) {
      // With the other sign: the factors are those of 0 - matrix.
      for (std::size_t j = 0; j < radau_stages; ++j)
        for (std::size_t k = 0; k < n_(); ++k) matrix_[(j * n_() + k) * size + i * n_() + k] = -radau_.slopes[i][j];
      for (std::size_t k = 0; k < n_(); ++k)
        for (std::size_t j = 0; j < n_(); ++j) matrix_[(i * n_() + k) * size + i * n_() + j] += jacobian(i, j, k);
    }
    factors_.compute(0.0, matrix_);
  }

  /// right_ = h J_i times a column in every stage.
  void multiply(std::span<const double> column) {
    std::ranges::fill(right_, 0.0);
    for (std::size_t i = 0; i < radau_stages; ++i)
      for (std::size_t k = 0; k < n_(); ++k)
        for (std::size_t j = 0; j < n_(); ++j) right_[i * n_() + j] += jacobian(i, j, k) * column[k];
  }

  /// The last stage of what right_ makes.
  void add_change(std::span<double> column) {
    factors_.solve(right_.data());
    for (std::size_t k = 0; k < n_(); ++k) column[k] += right_[(radau_stages - 1) * n_() + k];
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
