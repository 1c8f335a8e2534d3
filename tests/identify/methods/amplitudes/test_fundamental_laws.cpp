#include "identify/methods/amplitudes/fundamental_laws.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "friction_models/registry.hpp"

using namespace dualdamp::identify;
using std::numbers::pi;

namespace {

double integral(const std::function<double(double)>& f, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, 0.0, to, 15, 1e-14);
}

}  // namespace

TEST_CASE("Dawson's integral has its known values") {
  // Abramowitz and Stegun, table 7.5, and the asymptotic series at 30.
  CHECK(dawson(0.5) == Approx(0.4244363835020223).epsilon(1e-14));
  CHECK(dawson(-0.5) == -dawson(0.5));
  CHECK(dawson(0.249999) == Approx(0.2398382834820202).epsilon(1e-14));
  CHECK(dawson(0.250001) == Approx(0.2398400436428565).epsilon(1e-14));
  CHECK(dawson(1e20) == 5e-21);
  CHECK(dawson(1.0) == Approx(0.5380795069127684).epsilon(1e-14));
  CHECK(dawson(2.0) == Approx(0.3013403889237920).epsilon(1e-14));
  CHECK(dawson(10.0) == Approx(0.05025384718759853).epsilon(1e-13));
  CHECK(dawson(30.0) == Approx(1.0 / 60.0 * (1.0 + 1.0 / 1800.0 + 3.0 / 1800.0 / 1800.0)).epsilon(1e-8));
  CHECK(dawson(1e-6) == Approx(1e-6).epsilon(1e-11));
}

TEST_CASE("A law that the engines know too has one name") {
  for (const char* name : {"stribeck", "viscous_power", "viscous_saturating"}) {
    CAPTURE(name);
    CHECK(dualdamp::friction::find_law(name) != nullptr);
    CHECK(std::ranges::count(fundamental_laws(), name, &FundamentalLaw::name) == 1);
  }
}

TEST_CASE("The fundamental of a saturating law is its integral, on every branch") {
  for (const double a :
       {1e-4, 0.05, 0.0999, 0.1001, 0.5, 0.999999, 1.0 - 2e-7, 1.0, 1.0 + 2e-7, 1.000001, 1.001, 3.0, 200.0}) {
    CAPTURE(a);
    const double expected =
        4.0 / pi *
        integral([a](double t) { return a * std::sin(t) * std::sin(t) / (1.0 + a * std::sin(t)); }, 0.5 * pi);
    CHECK(saturating_fundamental(a).value == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("Fundamentals of the laws are those of their forces") {
  constexpr double V = 0.7;
  constexpr double shape = 0.4;
  for (const FundamentalLaw& law : fundamental_laws()) {
    if (law.forces == nullptr) continue;
    CAPTURE(law.name);
    const FundamentalLaw::Terms terms = law.fundamentals(V, 0.3, shape).value;
    for (std::size_t j = 0; j < law.coefficients.size(); ++j) {
      const double expected =
          4.0 / pi *
          integral([&](double t) { return law.forces(V * std::sin(t), shape)[j] * std::sin(t); }, 0.5 * pi);
      // The power law's force has an infinite slope at rest, which costs the quadrature digits.
      CHECK(terms[j] == Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("Laws of position do the work of their fundamental") {
  // pi X Phi = 4 int_0^X F(x) dx.
  constexpr double X = 0.3;
  const auto law = [](std::string_view name) {
    for (const FundamentalLaw& candidate : fundamental_laws())
      if (candidate.name == name) return candidate;
    return fundamental_laws().front();
  };
  CHECK(pi * X * law("position_quadratic").fundamentals(0.7, X, 0.0).value[2] ==
        Approx(4.0 * integral([](double x) { return x * x; }, X)).epsilon(1e-12));
  CHECK(pi * X * law("position_linear").fundamentals(0.7, X, 0.0).value[2] ==
        Approx(4.0 * integral([](double x) { return x; }, X)).epsilon(1e-12));
}

TEST_CASE("Derivatives of the fundamentals are those of their values") {
  // Central differences of a relative step h = 1e-4 err by h^2/6 of a third derivative, 1e-8 of the values here,
  // and by rounding, eps/h = 2e-12. On both sides of V = 0.1 shape and of V = shape the closed forms change.
  constexpr double X = 0.3;
  constexpr double h = 1e-4;
  for (const FundamentalLaw& law : fundamental_laws())
    for (const double V : {0.03, 0.0399, 0.0401, 0.2, 0.39, 0.4, 0.41, 0.7, 1.0}) {
      constexpr double shape = 0.4;
      CAPTURE(law.name, V);
      const FundamentalLaw::Fundamentals at = law.fundamentals(V, X, shape);
      const auto value = [&](double stretch, double widen) {
        return law.fundamentals(V * stretch, X * stretch, shape * widen).value;
      };
      for (std::size_t j = 0; j < law.coefficients.size(); ++j) {
        const double slope = (value(1.0 + h, 1.0)[j] - value(1.0 - h, 1.0)[j]) / (2.0 * h);
        const double by_shape = (value(1.0, 1.0 + h)[j] - value(1.0, 1.0 - h)[j]) / (2.0 * h * shape);
        CHECK(at.slope[j] == Approx(slope).margin(3e-8 * at.value[j]));
        CHECK(at.by_shape[j] == Approx(by_shape).margin(3e-8 * at.value[j] / shape));
      }
    }
}
