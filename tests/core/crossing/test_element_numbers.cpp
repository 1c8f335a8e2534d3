#include "core/crossing/element_numbers.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "core/crossing/divided_exponential.hpp"
#include "core/crossing/exponential_basis.hpp"
#include "tests/support/exponential_sum.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using core::ElementNumbers;

namespace {

ElementNumbers counted(std::size_t size) {
  ElementNumbers numbers;
  numbers.fit(size);
  for (std::size_t k = 0; k < size; ++k) {
    numbers.re[k] = static_cast<double>(k);
    numbers.im[k] = -1.0;
  }
  return numbers;
}

bool is_counted(const ElementNumbers& numbers, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) {
    if (numbers.re[k] != static_cast<double>(k) || numbers.im[k] != -1.0) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("Element numbers keep their values through copies, in place and on the heap") {
  constexpr std::size_t many = 3 * ElementNumbers::in_place;
  for (const std::size_t size : {std::size_t{3}, ElementNumbers::in_place, ElementNumbers::in_place + 1, many}) {
    CAPTURE(size);
    const ElementNumbers original = counted(size);
    const ElementNumbers copy = original;  // NOLINT(performance-unnecessary-copy-initialization)
    CHECK(is_counted(copy, size));
    ElementNumbers larger = counted(2 * many);
    larger = original;
    CHECK(is_counted(larger, size));
    ElementNumbers smaller = counted(1);
    smaller = original;
    smaller.re[0] = -1.0;
    CHECK(original.re[0] == 0.0);
    smaller.re[0] = 0.0;
    CHECK(is_counted(smaller, size));
    std::vector<ElementNumbers> list(5, original);
    list.resize(100, counted(size));  // moves those held
    for (const ElementNumbers& numbers : list) CHECK(is_counted(numbers, size));
  }
}

TEST_CASE("A basis with hundreds of elements is summed like a small one") {
  test::Random random(31);
  core::ExponentialBasis basis;
  oracle::ExponentialSum sum;
  core::ModeFunction f;
  std::vector<core::Complex> coefficients;
  double size = 0.0;
  for (int k = 0; k < 300; ++k) {
    // Decays, oscillations, chains of two on the one before.
    const int parent = k % 3 == 2 ? k - 1 : core::ExponentialBasis::no_parent;
    const core::Complex exponent(-random.logarithmic(1e-3, 10.0), k % 2 == 0 ? random.uniform(-5.0, 5.0) : 0.0);
    const core::Complex coefficient = random.phasor(1e-3, 1.0);
    basis.add(exponent, parent);
    sum.add(oracle::LongComplex(exponent), oracle::LongComplex(coefficient), parent);
    coefficients.push_back(coefficient);
    size += std::abs(coefficient);
  }
  basis.finish();
  sum.finish();
  core::clear(basis, f);
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    f.re[k] = coefficients[k].real();
    f.im[k] = coefficients[k].imag();
  }
  core::ModeFunction slope;
  core::differentiate(basis, f, slope);
  for (const double s : {0.0, 0.1, 1.0, 3.0}) {
    core::ExponentialBasis::Values values;
    basis.evaluate(s, values);
    const auto expected = sum.jet(static_cast<long double>(s));
    // A few roundings of each term; |E| <= 1 + s.
    CHECK(std::abs(core::evaluate(basis, f, values) - static_cast<double>(expected[0])) < 1e-14 * (1.0 + s) * size);
    CHECK(std::abs(core::evaluate(basis, slope, values) - static_cast<double>(expected[1])) <
          1e-13 * (1.0 + s) * size);
  }
}

TEST_CASE("A chain that is too long is refused, not cut") {
  core::ExponentialBasis basis;
  int parent = core::ExponentialBasis::no_parent;
  for (std::size_t k = 0; k < core::max_nodes; ++k) parent = basis.add(-static_cast<double>(k), parent);
  CHECK_THROWS_AS(basis.add(-9.0, parent), std::length_error);
}
