/// What the iterations of an implicit step cost, in evaluations of the field.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <span>

#include "sim/steppers/stepper.hpp"

namespace {

using namespace dualdamp;

/// x' = -rate (x - cos t), y' = 0, with a slope by x that is wrong by a factor. Evaluations are counted.
class Relaxation final : public sim::VectorField {
 public:
  static constexpr double rate = 5000.0;
  explicit Relaxation(double factor) : factor_(factor) {}

  [[nodiscard]] std::size_t size() const override { return 2; }
  void evaluate(std::span<const double> x, double t, std::span<double> rates) const override {
    ++calls;
    rates[0] = broken ? std::numeric_limits<double>::quiet_NaN() : -rate * (x[0] - std::cos(t));
    rates[1] = 0.0;
  }
  void jacobian(std::span<const double>, double, std::span<double> columns) const override {
    columns[0] = -factor_ * rate;
    columns[1] = columns[2] = columns[3] = 0.0;
  }
  void linearize(std::span<const double> x, double t, std::span<double> rates,
                 std::span<double> columns) const override {
    sim::VectorField::linearize(x, t, rates, columns);
    ++linearizations;
  }

  mutable int calls = 0;
  mutable int linearizations = 0;
  bool broken = false;

 private:
  double factor_;
};

/// The solution that begins at x0.
double exact(double x0, double t) {
  constexpr double a = Relaxation::rate;
  const double forced = a / (a * a + 1.0);
  return forced * (a * std::cos(t) + std::sin(t)) + (x0 - forced * a) * std::exp(-a * t);
}

constexpr std::array<double, 2> allowed = {1e-7, 1e-7};
constexpr double h = 0.1;

}  // namespace

TEST_CASE("an implicit step is as accurate with a wrong Jacobian, in fewer iterations than Newton's method alone",
          "[sim][steppers]") {
  for (const double factor : {0.8, 1.0, 1.25, 1.6}) {
    CAPTURE(factor);
    const Relaxation field(factor);
    const auto stepper = sim::make_implicit_stepper();
    const std::array<double, 2> x = {1.0, 1.0};
    std::array<double, 2> end{};
    std::array<double, 2> error{};
    REQUIRE(stepper->step(field, x, 0.0, h, allowed, end, error));
    CHECK(end[0] == Approx(exact(x[0], h)).margin(1e-2 * allowed[0]));
    CHECK(end[1] == 1.0);
    // Five evaluations an iteration, and one for the estimate. Newton's method alone takes 14, 2, 11 and 19
    // iterations.
    CHECK(field.calls <= (factor == 1.0 ? 11 : 31));
  }
}

TEST_CASE("the rates that come with a Jacobian are not evaluated again", "[sim][steppers]") {
  const Relaxation field(1.0);
  const auto stepper = sim::make_implicit_stepper();
  const std::array<double, 2> x = {1.0, 1.0};
  std::array<double, 2> end{};
  std::array<double, 2> error{};
  REQUIRE(stepper->step(field, x, 0.0, h, allowed, end, error));
  CHECK(field.linearizations == 1);
  // Two iterations at five stages, and the estimate; that of the Jacobian stands for one of them.
  CHECK(field.calls == 11);
}

TEST_CASE("a step that fails from its prediction is tried from other starts where these have not failed lately",
          "[sim][steppers]") {
  Relaxation field(1.0);
  const auto stepper = sim::make_implicit_stepper();
  std::array<double, 2> x = {1.0, 1.0};
  std::array<double, 2> end{};
  std::array<double, 2> error{};
  double t = 0.0;
  const auto step = [&](double length) { return stepper->step(field, x, t, length, allowed, end, error); };
  const auto starts_of_failure = [&](double length) {
    field.broken = true;
    field.linearizations = 0;
    CHECK_FALSE(step(length));
    field.broken = false;
    return field.linearizations;
  };
  const auto go_on = [&] {
    REQUIRE(step(h));
    x = end;
    t += h;
    CHECK(x[0] == Approx(exact(1.0, t)).margin(2e-2 * allowed[0]));
  };
  go_on();
  CHECK(starts_of_failure(h) == 3);
  CHECK(starts_of_failure(0.5 * h) == 1);
  CHECK(starts_of_failure(0.25 * h) == 3);
  for (int i = 0; i < 3; ++i) {
    go_on();
    CHECK(starts_of_failure(h) == 1);
  }
  go_on();
  CHECK(starts_of_failure(h) == 3);
}
