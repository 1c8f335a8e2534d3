#include <catch2/catch.hpp>
#include <cmath>

#include "sim/steppers/dop853.hpp"

using namespace dualdamp::sim;
using dop853::Row;

namespace {

/// sum_j row_j nodes_j^power over the first `count` entries.
double moment(const Row& row, int power, std::size_t count = dop853::all_stages) {
  double sum = 0.0;
  for (std::size_t j = 0; j < count; ++j) sum += row[j] * std::pow(dop853::nodes[j], power);
  return sum;
}

}  // namespace

// Condition of every stage: its row sum is its node. From the third stage on they are of second order, which allows
// order 8 with so few stages (hairer1993, II.5).
TEST_CASE("DOP853: each stage belongs to its node") {
  for (std::size_t i = 1; i < dop853::all_stages; ++i) {
    CAPTURE(i);
    // Weights of up to 43 cancel.
    CHECK(moment(dop853::weights[i], 0) == Approx(dop853::nodes[i]).margin(1e-13).epsilon(0));
    if (i > 1)
      CHECK(moment(dop853::weights[i], 1) == Approx(0.5 * std::pow(dop853::nodes[i], 2)).margin(1e-13).epsilon(0));
  }
}

TEST_CASE("DOP853: the end of a step integrates polynomials of degree 7 exactly, and not of degree 8") {
  const Row& end = dop853::weights[dop853::stages];
  for (int power = 0; power < 8; ++power)
    CHECK(moment(end, power) == Approx(1.0 / (power + 1)).margin(1e-14).epsilon(0));
  CHECK(std::abs(moment(end, 8) - 1.0 / 9.0) > 1e-6);
}

// b_j (1 - c_j) = sum_i b_i a_ij: the other simplifying assumption of methods of order 8.
TEST_CASE("DOP853: the weights of the end carry those of the stages") {
  const Row& end = dop853::weights[dop853::stages];
  for (std::size_t j = 0; j < dop853::stages; ++j) {
    double sum = 0.0;
    for (std::size_t i = 0; i < dop853::stages; ++i) sum += end[i] * dop853::weights[i][j];
    CHECK(sum == Approx(end[j] * (1.0 - dop853::nodes[j])).margin(1e-14));
  }
}

TEST_CASE("DOP853: the embedded methods are of orders 5 and 3") {
  for (int power = 0; power < 5; ++power) CHECK(moment(dop853::fifth, power) == Approx(0.0).margin(1e-14));
  CHECK(std::abs(moment(dop853::fifth, 5)) > 1e-4);

  Row third = dop853::weights[dop853::stages];
  third[0] -= dop853::third_0;
  third[8] -= dop853::third_8;
  third[11] -= dop853::third_11;
  for (int power = 0; power < 3; ++power) CHECK(moment(third, power) == Approx(0.0).margin(1e-14));
  CHECK(std::abs(moment(third, 3)) > 1e-4);
}
