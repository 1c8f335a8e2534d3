#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "sim/steppers/radau_collocation.hpp"
#include "sim/steppers/stepper.hpp"

namespace {

using namespace dualdamp;
using sim::RadauCollocation;
using sim::Stepper;
using StateVector = std::vector<double>;
constexpr std::size_t stages = RadauCollocation::stages;

/// A field from two functions.
class Field final : public sim::VectorField {
 public:
  using Function = std::function<void(std::span<const double>, double, std::span<double>)>;
  Field(std::size_t size, Function rates, Function jacobian)
      : size_(size), rates_(std::move(rates)), jacobian_(std::move(jacobian)) {}

  [[nodiscard]] std::size_t size() const override { return size_; }
  void evaluate(std::span<const double> x, double t, std::span<double> rates) const override {
    rates_(x, t, rates);
  }
  void jacobian(std::span<const double> x, double t, std::span<double> columns) const override {
    jacobian_(x, t, columns);
  }

 private:
  std::size_t size_;
  Function rates_;
  Function jacobian_;
};

/// x'' + x^3 = g(t) with g such that x = sin t + cos(2.3 t)/2 is a solution; `copies` of it side by side.
struct ForcedDuffing {
  static StateVector exact(double t, std::size_t copies = 1) {
    StateVector x;
    for (std::size_t c = 0; c < copies; ++c) {
      x.push_back(std::sin(t) + 0.5 * std::cos(2.3 * t));
      x.push_back(std::cos(t) - 1.15 * std::sin(2.3 * t));
    }
    return x;
  }

  static Field field(std::size_t copies = 1) {
    const auto rates = [copies](std::span<const double> x, double t, std::span<double> r) {
      const double wanted = exact(t)[0];
      const double g = -std::sin(t) - 2.645 * std::cos(2.3 * t) + wanted * wanted * wanted;
      for (std::size_t c = 0; c < copies; ++c) {
        r[2 * c] = x[2 * c + 1];
        r[2 * c + 1] = g - x[2 * c] * x[2 * c] * x[2 * c];
      }
    };
    const auto jacobian = [copies](std::span<const double> x, double, std::span<double> columns) {
      const std::size_t n = 2 * copies;
      std::ranges::fill(columns, 0.0);
      for (std::size_t c = 0; c < n; c += 2) {
        columns[c * n + c + 1] = -3.0 * x[c] * x[c];
        columns[(c + 1) * n + c] = 1.0;
      }
    };
    return {2 * copies, rates, jacobian};
  }
};

/// Prothero and Robinson: x' = lambda (x - sin t) + cos t, with the solution x = sin t for any lambda.
Field prothero_robinson(double lambda) {
  return {1,
          [lambda](std::span<const double> x, double t, std::span<double> r) {
            r[0] = lambda * (x[0] - std::sin(t)) + std::cos(t);
          },
          [lambda](std::span<const double>, double, std::span<double> columns) { columns[0] = lambda; }};
}

struct Method {
  const char* name;
  std::unique_ptr<Stepper> (*make)();
  int end_order;    ///< of the error at the end of one step
  int dense_order;  ///< of the error inside it
  double h;         ///< a step at which round-off and higher orders are both small
};

const Method methods[] = {{"explicit", sim::make_explicit_stepper, 9, 8, 0.22},
                          {"implicit", sim::make_implicit_stepper, 10, 6, 0.35}};

struct Stepped {
  StateVector end;
  StateVector error;
};

/// One step with a negligible error of the iteration.
Stepped step(Stepper& stepper, const sim::VectorField& field, const StateVector& x, double t, double h,
             double allowed = 1e-14) {
  Stepped result{StateVector(x.size()), StateVector(x.size())};
  const StateVector tolerance(x.size(), allowed);
  REQUIRE(stepper.step(field, x, t, h, tolerance, result.end, result.error));
  return result;
}

/// Largest errors over many steps from points of the exact solution: at the end, inside, and as estimated.
struct Errors {
  double end = 0.0;
  double dense = 0.0;
  double estimate = 0.0;
};

Errors local_errors(const Method& method, double h) {
  const Field field = ForcedDuffing::field();
  const auto stepper = method.make();
  Errors errors;
  StateVector inside(2);
  for (double t = 0.0; t < 6.0; t += 0.37) {
    const Stepped s = step(*stepper, field, ForcedDuffing::exact(t), t, h);
    const auto grow = [](double& largest, double value) { largest = std::max(largest, std::abs(value)); };
    for (std::size_t k = 0; k < 2; ++k) {
      grow(errors.end, s.end[k] - ForcedDuffing::exact(t + h)[k]);
      grow(errors.estimate, s.error[k]);
      for (double part = 0.05; part < 1.0; part += 0.1) {
        stepper->at(part, inside);
        grow(errors.dense, inside[k] - ForcedDuffing::exact(t + part * h)[k]);
      }
    }
  }
  return errors;
}

/// A plain controller: every step's estimate below `tolerance` (1 + |x|).
StateVector integrate(Stepper& stepper, const sim::VectorField& field, StateVector x, double end,
                      double tolerance) {
  StateVector next(x.size());
  StateVector error(x.size());
  StateVector allowed(x.size());
  double t = 0.0;
  double h = 1e-6 * end;
  for (int steps = 0; t < end; ++steps) {
    REQUIRE(steps < 100000);
    const double tried = std::min(h, end - t);
    for (std::size_t k = 0; k < x.size(); ++k) allowed[k] = tolerance * (1.0 + std::abs(x[k]));
    double ratio = 1e3;
    if (stepper.step(field, x, t, tried, allowed, next, error)) {
      ratio = 1e-10;
      for (std::size_t k = 0; k < x.size(); ++k) ratio = std::max(ratio, std::abs(error[k]) / allowed[k]);
    }
    h = tried * std::clamp(0.8 * std::pow(ratio, -1.0 / (stepper.order() + 1)), 0.2, 5.0);
    if (ratio > 1.0) continue;
    t = tried < end - t ? t + tried : end;
    x = next;
  }
  return x;
}

}  // namespace

// Butcher's simplifying assumptions in terms of the inverse matrix. C(s): the derivative matrix is exact for
// polynomials c^k, k <= s. B(2s - 1): the last row of A integrates c^(k-1) to 1/k for k <= 2s - 1, and not for 2s.
// Together with c_s = 1 they give order 2s - 1 (hairer1996, IV.5).
TEST_CASE("the Radau coefficients satisfy the order conditions") {
  const RadauCollocation radau;
  for (std::size_t i = 0; i < stages; ++i)
    for (int k = 1; k <= static_cast<int>(stages); ++k) {
      double slope = 0.0;
      for (std::size_t j = 0; j < stages; ++j) slope += radau.slopes[i][j] * std::pow(radau.nodes[j], k);
      CHECK(slope == Approx(k * std::pow(radau.nodes[i], k - 1)).margin(1e-13).epsilon(1e-13));
    }

  Eigen::MatrixXd slopes(stages, stages);
  for (std::size_t i = 0; i < stages; ++i)
    for (std::size_t j = 0; j < stages; ++j)
      slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = radau.slopes[i][j];
  const Eigen::MatrixXd butcher = slopes.inverse();
  const auto defect = [&](int k) {
    double sum = -1.0 / k;
    for (std::size_t j = 0; j < stages; ++j)
      sum += butcher(stages - 1, static_cast<Eigen::Index>(j)) * std::pow(radau.nodes[j], k - 1);
    return std::abs(sum);
  };
  for (int k = 1; k < 2 * static_cast<int>(stages); ++k) CHECK(defect(k) < 1e-14);
  CHECK(defect(2 * stages) > 1e-6);
}

// The matrix is recovered from its eigenvalues.
TEST_CASE("the Radau coefficients are diagonalised") {
  const RadauCollocation radau;
  for (std::size_t i = 0; i < stages; ++i)
    for (std::size_t j = 0; j < stages; ++j) {
      double sum = radau.to_stages[i][0] * radau.real_eigenvalue * radau.from_stages[0][j];
      for (std::size_t p = 0; p < RadauCollocation::pairs; ++p) {
        const std::size_t row = 1 + 2 * p;
        const std::complex<double> from(radau.from_stages[row][j], radau.from_stages[row + 1][j]);
        const std::complex<double> turned = radau.eigenvalues[p] * from;
        sum += radau.to_stages[i][row] * turned.real() + radau.to_stages[i][row + 1] * turned.imag();
      }
      CHECK(sum == Approx(radau.slopes[i][j]).margin(1e-10).epsilon(0));
    }
}

// R(z) is Pade's approximation of exp(z) with degrees s - 1 and s: all of a step on x' = lambda x, stiff or not.
TEST_CASE("the implicit stepper has the stability function of Radau IIA") {
  const auto stepper = sim::make_implicit_stepper();
  for (const double z : {-0.3, -2.0, -17.0, -400.0, -1e6, 1.5}) {
    double above = 1.0;
    double below = 1.0;
    double up = 1.0;
    double down = 1.0;
    for (int j = 1; j <= static_cast<int>(stages); ++j) {
      const double degrees = 2.0 * static_cast<double>(stages) - j;
      up *= (static_cast<double>(stages) - j) / (degrees * j) * z;
      down *= -(static_cast<double>(stages) - j + 1.0) / (degrees * j) * z;
      above += up;
      below += down;
    }
    const Field field(
        1, [z](std::span<const double> x, double, std::span<double> r) { r[0] = z * x[0]; },
        [z](std::span<const double>, double, std::span<double> columns) { columns[0] = z; });
    CAPTURE(z);
    CHECK(step(*stepper, field, {1.0}, 0.0, 1.0).end[0] == Approx(above / below).margin(1e-14).epsilon(1e-13));
  }
}

// Halving h divides an error of order p by 2^p. The next order alters the exponent by about h: half a unit is
// allowed.
TEST_CASE("steppers have the orders they promise at the end, inside and in the estimate") {
  for (const Method& method : methods) {
    CAPTURE(method.name);
    const Errors coarse = local_errors(method, method.h);
    const Errors fine = local_errors(method, 0.5 * method.h);
    CHECK(std::log2(coarse.end / fine.end) > method.end_order - 0.5);
    CHECK(std::log2(coarse.end / fine.end) < method.end_order + 1.0);
    CHECK(std::log2(coarse.dense / fine.dense) == Approx(method.dense_order).margin(0.5));
    CHECK(std::log2(coarse.estimate / fine.estimate) == Approx(method.make()->order() + 1).margin(0.5));
    CHECK(coarse.estimate > coarse.end);
  }
}

// Order reduction. With h |lambda| >> 1 the error of a step is the quadrature error of the stages over lambda, of
// order h^s/lambda (hairer1996, IV.15, stiffly accurate): s instead of 2s, but small where the problem is stiff.
TEST_CASE("the implicit stepper loses order on stiff components as the theory says") {
  const auto global_error = [](double lambda, double h) {
    const Field field = prothero_robinson(lambda);
    const auto stepper = sim::make_implicit_stepper();
    double worst = 0.0;
    StateVector x{std::sin(0.3)};
    for (int k = 0; k < 12; ++k) {
      x = step(*stepper, field, x, 0.3 + k * h, h).end;
      worst = std::max(worst, std::abs(x[0] - std::sin(0.3 + (k + 1) * h)));
    }
    return worst;
  };
  const double coarse = global_error(-1e5, 0.8);
  const double fine = global_error(-1e5, 0.4);
  CHECK(std::log2(coarse / fine) == Approx(stages).margin(0.5));
  CHECK(std::log10(coarse / global_error(-1e6, 0.8)) == Approx(1.0).margin(0.1));
  CHECK(coarse < 1e-9);
}

// Dense output is what the engine's events are found on; a step begins where the one before ended, bit for bit.
TEST_CASE("dense output is exact at both ends") {
  for (const Method& method : methods) {
    CAPTURE(method.name);
    const auto stepper = method.make();
    const Field field = ForcedDuffing::field();
    StateVector x = ForcedDuffing::exact(0.0);
    StateVector at(2);
    for (int k = 0; k < 20; ++k) {
      const double h = 0.01 * (k + 1);
      const StateVector end = step(*stepper, field, x, 0.1 * k, h).end;
      stepper->at(0.0, at);
      CHECK(at == x);
      stepper->at(1.0, at);
      CHECK(at == end);
      x = end;
    }
  }
}

// Sizes 2, 3 and 4 have separate code, the others share one.
TEST_CASE("a step does not depend on how many equations are beside it") {
  for (const Method& method : methods) {
    const auto stepper = method.make();
    const StateVector alone = step(*stepper, ForcedDuffing::field(), ForcedDuffing::exact(0.7), 0.7, method.h).end;
    for (const std::size_t copies : {2U, 3U, 20U}) {
      const StateVector x = ForcedDuffing::exact(0.7, copies);
      const StateVector end = step(*stepper, ForcedDuffing::field(copies), x, 0.7, method.h).end;
      CAPTURE(method.name, copies);
      for (std::size_t k = 0; k < end.size(); ++k) CHECK(end[k] == Approx(alone[k % 2]).epsilon(1e-14));
    }
  }
}

// x' = J x with J = S diag(rates) S^-1: the end of a step is S diag(R(h rates)) S^-1 x, and R = exp to 1e-12 for
// the slow rates at h = 0.05 and within its own decay, R(-500) = 1e-2, for the fast one - which the displacements
// leave out.
TEST_CASE("the end of a step is smooth enough in x for central differences") {
  Eigen::Matrix3d basis;
  basis << 1, 2, 0, -1, 1, 1, 0, 1, 2;
  const Eigen::Vector3d rates(-1e4, -1.0, -0.3);
  const Eigen::Matrix3d matrix = basis * rates.asDiagonal() * basis.inverse();
  const Field field(
      3,
      [&](std::span<const double> x, double t, std::span<double> r) {
        Eigen::Map<Eigen::Vector3d>(r.data()) = matrix * Eigen::Map<const Eigen::Vector3d>(x.data());
        r[0] += std::cos(3.0 * t);
      },
      [&](std::span<const double>, double, std::span<double> columns) {
        Eigen::Map<Eigen::Matrix3d>(columns.data()) = matrix;
      });
  const double h = 0.05;
  const auto stepper = sim::make_implicit_stepper();
  const StateVector start{0.4, 1.0, -0.7};
  for (int slow = 1; slow < 3; ++slow) {
    const double displacement = 1e-5;
    StateVector plus = start;
    StateVector minus = start;
    for (std::size_t k = 0; k < 3; ++k) {
      plus[k] += displacement * basis(static_cast<Eigen::Index>(k), slow);
      minus[k] -= displacement * basis(static_cast<Eigen::Index>(k), slow);
    }
    const StateVector right = step(*stepper, field, plus, 0.2, h, 1e-10).end;
    const StateVector left = step(*stepper, field, minus, 0.2, h, 1e-10).end;
    for (std::size_t k = 0; k < 3; ++k) {
      const double exact = std::exp(h * rates[slow]) * basis(static_cast<Eigen::Index>(k), slow);
      CHECK((right[k] - left[k]) / (2.0 * displacement) == Approx(exact).margin(1e-8));
    }
  }
}

TEST_CASE("what a stepper did before does not alter a step") {
  const Field field = ForcedDuffing::field();
  const StateVector x = ForcedDuffing::exact(1.0);
  const double allowed = 1e-8;
  const StateVector alone = step(*sim::make_implicit_stepper(), field, x, 1.0, 0.5, allowed).end;
  const auto used = sim::make_implicit_stepper();
  for (const double before : {0.3, 0.5, 0.9}) {
    (void)step(*used, field, ForcedDuffing::exact(1.0 - before), 1.0 - before, before, allowed);
    const StateVector end = step(*used, field, x, 1.0, 0.5, allowed).end;
    for (std::size_t k = 0; k < 2; ++k) CHECK(end[k] == Approx(alone[k]).margin(2e-3 * allowed).epsilon(0));
  }
}

// mu = 1000 in its usual scaling, x'' = ((1 - x^2) x' - x)/1e-6 from (2, 0), to t = 2: two relaxation jumps. The
// reference is that of the Test Set for IVP Solvers (problem VDPOL).
TEST_CASE("the implicit stepper passes the jumps of a van der Pol oscillator") {
  const double fast = 1e6;
  const Field field(
      2,
      [fast](std::span<const double> x, double, std::span<double> r) {
        r[0] = x[1];
        r[1] = fast * ((1.0 - x[0] * x[0]) * x[1] - x[0]);
      },
      [fast](std::span<const double> x, double, std::span<double> columns) {
        columns[0] = 0.0;
        columns[1] = fast * (-2.0 * x[0] * x[1] - 1.0);
        columns[2] = 1.0;
        columns[3] = fast * (1.0 - x[0] * x[0]);
      });
  const auto stepper = sim::make_implicit_stepper();
  const StateVector end = integrate(*stepper, field, {2.0, 0.0}, 2.0, 1e-10);
  CHECK(end[0] == Approx(1.706167732170483).epsilon(1e-9));
  CHECK(end[1] == Approx(-0.8928097010247975).epsilon(1e-9));
}

TEST_CASE("a step that fails says so and leaves the dense output of the one before") {
  // No real rate beyond x = 1, which x' = 1 + sqrt(1 - x) reaches.
  const Field field(
      1, [](std::span<const double> x, double, std::span<double> r) { r[0] = 1.0 + std::sqrt(1.0 - x[0]); },
      [](std::span<const double> x, double, std::span<double> columns) {
        columns[0] = -0.5 / std::sqrt(1.0 - x[0]);
      });
  for (const Method& method : methods) {
    CAPTURE(method.name);
    const auto stepper = method.make();
    const StateVector end = step(*stepper, field, {0.0}, 0.0, 0.1, 1e-8).end;
    const StateVector allowed{1e-8};
    StateVector out(1);
    StateVector error(1);
    CHECK_FALSE(stepper->step(field, end, 0.1, 2.0, allowed, out, error));
    stepper->at(1.0, out);
    CHECK(out == end);
  }
}

// For one linear equation the two stages that Hairer's test compares differ by exactly lambda.
TEST_CASE("the explicit stepper knows how stiff a step was") {
  const auto stepper = sim::make_explicit_stepper();
  for (const double lambda : {-5.0, -40.0, -300.0}) {
    (void)step(*stepper, prothero_robinson(lambda), {0.2}, 0.1, 0.1);
    CHECK(stepper->stiffness() == Approx(-0.1 * lambda).epsilon(1e-6));
  }
  CHECK(sim::make_implicit_stepper()->stiffness() == 0.0);
}

TEST_CASE("implicit steps that follow each other are predicted whatever the rounding of their times",
          "[sim][steppers]") {
  /// x'' = -x^3, which counts its evaluations.
  class Counting final : public sim::VectorField {
   public:
    std::size_t size() const override { return 2; }
    void evaluate(std::span<const double> x, double, std::span<double> rates) const override {
      ++calls;
      rates[0] = x[1];
      rates[1] = -x[0] * x[0] * x[0];
    }
    void jacobian(std::span<const double> x, double, std::span<double> columns) const override {
      columns[0] = columns[3] = 0.0;
      columns[1] = -3.0 * x[0] * x[0];
      columns[2] = 1.0;
    }
    mutable int calls = 0;
  };
  const Counting field;
  const auto stepper = sim::make_implicit_stepper();
  std::array<double, 2> x = {1.0, 0.0};
  std::array<double, 2> end{};
  std::array<double, 2> error{};
  const std::array<double, 2> allowed = {1e-7, 1e-7};
  const double h = 0.07;
  int before = 0;
  int most = 0;
  double t = 0.0;
  for (int i = 0; i < 100; ++i) {
    before = field.calls;
    REQUIRE(stepper->step(field, x, t, h, allowed, end, error));
    if (i > 0) most = std::max(most, field.calls - before);
    x = end;
    t += h;
  }
  CHECK(most <= 11);  // two iterations and the estimate
}
