#pragma once
/// Guards made of a few terms, and a search over them.

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "core/crossing/first_crossing.hpp"
#include "core/crossing/interval_start.hpp"
#include "tests/support/exponential_sum.hpp"
#include "tests/support/numbers.hpp"

namespace dualdamp::core::guard_problems {

using oracle::ExponentialSum;
using oracle::LongComplex;

using test::epsilon;
using test::pi;

/// One element with its coefficient.
struct Term {
  Complex exponent;
  Complex coefficient;
  int parent = ExponentialBasis::no_parent;
};
using Terms = std::vector<Term>;

/// c_0 + c_1 s + c_2 s^2 + ...
inline Terms polynomial(const std::vector<double>& c) {
  Terms terms;
  double factorial = 1.0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (k > 0) factorial *= static_cast<double>(k);
    terms.push_back({0.0, factorial * c[k], static_cast<int>(k) - 1});
  }
  return terms;
}

/// Several guards on the basis of all their elements.
class Problem {
 public:
  explicit Problem(const std::vector<Terms>& guards, int known_zeros = 0, double expected = 0.0) {
    for (const Terms& terms : guards) {
      const int offset = basis_.size();
      for (const Term& term : terms) {
        basis_.add(term.exponent, term.parent < 0 ? term.parent : term.parent + offset);
      }
    }
    basis_.finish(expected);
    int next = 0;
    for (const Terms& terms : guards) {
      Guard guard;
      clear(basis_, guard.value);
      for (const Term& term : terms) {
        guard.value.re[static_cast<std::size_t>(next)] = term.coefficient.real();
        guard.value.im[static_cast<std::size_t>(next++)] = term.coefficient.imag();
      }
      guard.known_zeros = known_zeros;
      prepare(basis_, guard);
      guards_.push_back(guard);
    }
  }

  [[nodiscard]] const ExponentialBasis& basis() const { return basis_; }
  [[nodiscard]] const std::vector<Guard>& guards() const { return guards_; }

 private:
  ExponentialBasis basis_;
  std::vector<Guard> guards_;
};

struct Result {
  SearchEnd end = SearchEnd::horizon;
  Crossing crossing;
  std::vector<Grazing> grazings;
  SearchCount count;
};

inline Result search(const Problem& problem, double horizon) {
  Result result;
  result.end =
      first_crossing(problem.basis(), problem.guards(), horizon, result.crossing, result.grazings, result.count);
  CHECK(result.crossing.found == (result.end == SearchEnd::crossing));
  return result;
}

inline Result search(const Terms& terms, double horizon, int known_zeros = 0) {
  return search(Problem({terms}, known_zeros), horizon);
}

inline ExponentialSum reference(const Terms& terms, int known_zeros = 0) {
  ExponentialSum sum;
  for (const Term& term : terms) sum.add(LongComplex(term.exponent), LongComplex(term.coefficient), term.parent);
  sum.finish(known_zeros);
  return sum;
}

inline void check_crossing(const Result& result, int guard, double s, double tolerance) {
  REQUIRE(result.crossing.found);
  CHECK(result.crossing.guard == guard);
  CHECK(std::abs(result.crossing.s - s) <= tolerance);
}

/// cos(w s) as a term of amplitude a and phase p.
inline Term cosine(double a, double w, double p = 0.0) { return {Complex(0.0, w), std::polar(a, p)}; }
inline Term constant(double value) { return {0.0, value}; }

}  // namespace dualdamp::core::guard_problems
