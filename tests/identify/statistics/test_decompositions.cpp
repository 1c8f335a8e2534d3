#include "identify/statistics/decompositions.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace dualdamp::identify;

TEST_CASE("decompositions: a line has the deviations of the textbook") {
  // At t = -2 .. 2: the height has the deviation 1/sqrt(5), the slope 1/sqrt(10).
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(5, 2);
  columns.col(1) << -2.0, -1.0, 0.0, 1.0, 2.0;
  const LinearFit fit = linear_fit(columns, (Eigen::VectorXd(5) << -3.0, -1.0, 1.0, 3.0, 5.0).finished());
  CHECK(fit.coefficients[0] == Approx(1.0));
  CHECK(fit.coefficients[1] == Approx(2.0));
  CHECK(fit.deviations[0] == Approx(1.0 / std::sqrt(5.0)));
  CHECK(fit.deviations[1] == Approx(1.0 / std::sqrt(10.0)));
}

TEST_CASE("decompositions: dependent columns have a rank, a fit and a shortest solution") {
  // The second column is twice the first: x = (1, 2) is the shortest of all with x_1 + 2 x_2 = 5.
  Eigen::MatrixXd columns(3, 2);
  columns << 1.0, 2.0, 2.0, 4.0, -1.0, -2.0;
  const Eigen::VectorXd values = 5.0 * columns.col(0);
  const DependentColumns dependent(columns);
  CHECK(dependent.rank() == 1);
  CHECK((columns * dependent.solve(values) - values).norm() < 1e-12);
  Eigen::MatrixXd both(3, 2);
  both << values, -values;
  CHECK((columns * dependent.solve_each(both) - both).norm() < 1e-12);
  const Eigen::VectorXd shortest = shortest_solution(columns, values);
  CHECK(shortest[0] == Approx(1.0));
  CHECK(shortest[1] == Approx(2.0));
}

TEST_CASE("decompositions: what depends to rounding is told by no units, and fits nothing") {
  // The third column is the sum of the others but for rounding, which points wherever it likes.
  Eigen::MatrixXd columns(6, 3);
  columns.col(0) << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  columns.col(1) << 1.0, -1.0, 2.0, -2.0, 1.0, 0.5;
  const Eigen::VectorXd rounding = (Eigen::VectorXd(6) << 1.0, -3.0, 2.0, 0.0, -1.0, 4.0).finished() * 1e-14;
  columns.col(2) = columns.col(0) + columns.col(1) + rounding;
  const Eigen::VectorXd values = (Eigen::VectorXd(6) << 3.0, 0.0, -1.0, 2.0, 1.0, 5.0).finished();
  const Eigen::VectorXd left = left_beside(columns.leftCols(2), values);
  for (const double unit : {1.0, 1e-9, 1e9}) {
    Eigen::MatrixXd in_other_units = columns;
    in_other_units.col(1) *= unit;
    CAPTURE(unit);
    CHECK(DependentColumns(in_other_units).rank() == 2);
    CHECK(orthonormal_basis(in_other_units).cols() == 2);
    CHECK((left_beside(in_other_units, values) - left).norm() < 1e-12);
  }
  columns(2, 1) = std::nan("");
  CHECK_FALSE(pivoted_least_squares(columns, values).allFinite());
}

TEST_CASE("decompositions: a definite matrix is solved and inverted") {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 4.0, 2.0, 2.0, 3.0;  // of determinant 8
  const DefiniteMatrix definite(matrix);
  CHECK(definite.is_regular());
  Eigen::MatrixXd inverse(2, 2);
  inverse << 0.375, -0.25, -0.25, 0.5;
  CHECK((definite.inverse() - inverse).norm() < 1e-15);
  const Eigen::VectorXd right = Eigen::VectorXd::Constant(2, 8.0);
  CHECK((definite.solve(right) - inverse * right).norm() < 1e-14);
  CHECK((definite.solve_each(matrix) - Eigen::MatrixXd::Identity(2, 2)).norm() < 1e-15);
}

TEST_CASE("decompositions: products of matrices") {
  Eigen::MatrixXd A(2, 2);
  A << 1.0, 2.0, 0.0, 3.0;
  Eigen::MatrixXd S(2, 2);
  S << 2.0, 1.0, 1.0, 5.0;
  const auto rows = [](double a, double b, double c, double d) {
    Eigen::MatrixXd matrix(2, 2);
    matrix << a, b, c, d;
    return matrix;
  };
  CHECK(product(A, S) == rows(4.0, 11.0, 3.0, 15.0));
  CHECK(gram(A) == rows(1.0, 2.0, 2.0, 13.0));
  CHECK(propagated(A, S) == rows(26.0, 33.0, 33.0, 45.0));
  CHECK(in_units(S, Eigen::Vector2d(2.0, 10.0)) == rows(8.0, 20.0, 20.0, 500.0));
  CHECK(variance_along(Eigen::Vector2d(1.0, -2.0), S) == 18.0);
  CHECK(projector_beside(Eigen::MatrixXd(Eigen::Vector2d(0.6, 0.8))).isApprox(rows(0.64, -0.48, -0.48, 0.36)));
  const SymmetricSpectrum spectrum = symmetric_spectrum(S);
  CHECK(spectrum.matrix_with(spectrum.values).isApprox(S));
  CHECK(spectrum.matrix_with(spectrum.values.cwiseInverse()).isApprox(inverse_of(S)));
}

TEST_CASE("decompositions: a matrix without columns spans nothing, and takes nothing away") {
  const Eigen::MatrixXd none(3, 0);
  const Eigen::Vector3d values(1.0, 2.0, 3.0);
  CHECK(orthonormal_basis(none).rows() == 3);
  CHECK(orthonormal_basis(none).cols() == 0);
  CHECK(orthonormal_basis(none, 1e-6).cols() == 0);
  CHECK(pivoted_least_squares(none, values).size() == 0);
  CHECK(left_beside(none, values) == values);
  CHECK(DependentColumns(none).rank() == 0);
  CHECK(DependentColumns(none).solve(values).size() == 0);
  CHECK(DependentColumns(none).solve_each(values).cols() == 1);
}
