#include "sim/engine/variation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/engine/lu_factors.hpp"
#include "sim/engine/radau_collocation.hpp"

namespace dualdamp::sim {
namespace {

using Vector = std::vector<double>;

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
    linearise(field, step);
    for (std::size_t first = 0; first < columns.size(); first += n_()) {
      const std::span<double> column = columns.subspan(first, n_());
      for (std::size_t i = 0; i < radau_stages; ++i) multiply(i, column, std::span(right_).subspan(i * n_(), n_()));
      add_change(column);
    }
    std::ranges::fill(late, 0.0);
    right_ = forcing_;
    add_change(late);
    const auto is_finite = [](double value) { return std::isfinite(value); };
    return std::ranges::all_of(columns, is_finite) && std::ranges::all_of(late, is_finite);
  }

 private:
  /// Jacobians h J_i and h df/dt of the radau_stages, and the factors of their equations.
  void linearise(const VectorField& field, const TakenStep& step) {
    const std::size_t size = n_() * radau_stages;
    std::ranges::fill(matrix_, 0.0);
    for (std::size_t i = 0; i < radau_stages; ++i) {
      step.stepper.at(radau_.nodes[i], state_);
      const double t = step.t + radau_.nodes[i] * step.h;
      const std::span<double> jacobian = std::span(jacobians_).subspan(i * n_() * n_(), n_() * n_());
      field.jacobian(state_, t, jacobian);
      for (double& entry : jacobian) entry *= step.h;
      field.evaluate(state_, t + step.increment, later_);
      field.evaluate(state_, t - step.increment, earlier_);
      for (std::size_t k = 0; k < n_(); ++k)
        forcing_[i * n_() + k] = step.h * (later_[k] - earlier_[k]) / (2.0 * step.increment);
      // With the other sign: the factors are those of 0 - matrix.
      for (std::size_t j = 0; j < radau_stages; ++j)
        for (std::size_t k = 0; k < n_(); ++k) matrix_[(j * n_() + k) * size + i * n_() + k] = -radau_.slopes[i][j];
      for (std::size_t j = 0; j < n_(); ++j)
        for (std::size_t k = 0; k < n_(); ++k)
          matrix_[(i * n_() + j) * size + i * n_() + k] += jacobian[j * n_() + k];
    }
    factors_.compute(0.0, matrix_);
  }

  /// h J_i times a column.
  void multiply(std::size_t i, std::span<const double> column, std::span<double> product) const {
    std::ranges::fill(product, 0.0);
    for (std::size_t j = 0; j < n_(); ++j)
      for (std::size_t k = 0; k < n_(); ++k) product[k] += jacobians_[(i * n_() + j) * n_() + k] * column[j];
  }

  /// The last stage of what right_ makes.
  void add_change(std::span<double> column) {
    factors_.solve(right_.data());
    for (std::size_t k = 0; k < n_(); ++k) column[k] += right_[(radau_stages - 1) * n_() + k];
  }

  const RadauCollocation& radau_ = RadauCollocation::once();
  Extent<N> n_;
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
