#include "friction_models/laws/elasto_plastic.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/lugre.hpp"
#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/forced_mass.hpp"
#include "tests/support/sliding.hpp"

using namespace dualdamp;
using friction::ElastoPlastic;
using friction::Law;
using friction::Lugre;
using friction::StribeckCurve;

namespace {

const Lugre::Bristles bristles{1e5, 316.0, 0.4};

friction::ParameterValues elasto_plastic_values(double static_level, const Lugre::Bristles& b,
                                                double elastic_limit) {
  return {{"kinetic", 1.0},     {"static", static_level}, {"stribeck_velocity", 0.001},    {"sigma0", b.sigma0},
          {"sigma1", b.sigma1}, {"sigma2", b.sigma2},     {"elastic_limit", elastic_limit}};
}

Law elasto_plastic_law(double static_level, const Lugre::Bristles& b, double elastic_limit, double factor = 1.0) {
  return Law(ElastoPlastic(StribeckCurve(factor, factor * static_level, 0.001), b, factor * elastic_limit));
}

sim::LawCase elasto_plastic(double static_level, const Lugre::Bristles& b, double elastic_limit) {
  sim::LawCase c = sim::law_case("elasto_plastic", elasto_plastic_values(static_level, b, elastic_limit));
  c.stroke = 30.0 * static_level / b.sigma0;
  c.passive = b.sigma2 >= b.sigma1 * (static_level - 1.0);
  c.scaled = [=](double factor) { return elasto_plastic_law(static_level, b, elastic_limit, factor); };
  return c;
}

}  // namespace

TEST_CASE("elasto_plastic conforms to the law contract", "[friction][elasto_plastic]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(elasto_plastic(1.5, bristles, 0.7e-5)) == none);
  CHECK(sim::nonconformities(elasto_plastic(1.0, bristles, 0.99e-5)) == none);
  CHECK(sim::nonconformities(elasto_plastic(1.5, {1e5, 0.0, 0.0}, 1e-9)) == none);
  CHECK(sim::nonconformities(elasto_plastic(1.5, {1e5, 20.0, 10.0}, 0.5e-5)) == none);
}

TEST_CASE("elasto_plastic: a spring below its elastic limit, lugre's level in a long slip",
          "[friction][elasto_plastic]") {
  sim::LawHost host(elasto_plastic_law(1.5, {1e5, 0.0, 0.4}, 0.7e-5), {});
  for (const double x : {0.69e-5, -0.5e-5, 0.0, -0.69e-5, 0.3e-5}) {
    host.move_to(x);
    CHECK(host.force() == Approx(1e5 * x + 0.4 * host.now().v).margin(1e-10));
  }
  for (const double v : {1e-5, 1e-3, 0.3}) {
    INFO(v);
    // z comes to g/sigma0 as exp(-sigma0 x/g).
    test::slide(host, v, 1e-3 / v);
    const double r = v / 0.001;
    CHECK(host.force() == Approx(1.0 + 0.5 * std::exp(-r * r) + 0.4 * v).epsilon(1e-9));
  }
}

TEST_CASE("elasto_plastic: first yield in closed form", "[friction][elasto_plastic]") {
  // With static = kinetic and y = (z - z_ba)/(z_m - z_ba): alpha = (1 - cos(pi y))/2, dx = dz/(1 - alpha z/z_m).
  // The integral by Simpson's rule with 2000 panels, whose error is below 1e-13.
  const double least = 0.4e-5;
  const double largest = 1e-5;
  const auto slope = [&](double z) {
    const double y = (z - least) / (largest - least);
    return 1.0 / (1.0 - (1.0 - std::cos(3.141592653589793 * y)) / 2.0 * z / largest);
  };
  const double z = 0.9e-5;
  const int panels = 2000;
  const double h = (z - least) / (2.0 * panels);
  double x = least;
  for (int i = 0; i < panels; ++i) {
    const double from = least + 2.0 * i * h;
    x += h / 3.0 * (slope(from) + 4.0 * slope(from + h) + slope(from + 2.0 * h));
  }
  sim::LawHost host(elasto_plastic_law(1.0, {1e5, 0.0, 0.0}, least), {});
  host.move_to(x);
  CHECK(host.events() == 1);
  CHECK(host.last_event().x == Approx(least).epsilon(1e-9));
  CHECK(host.force() == Approx(1e5 * z).epsilon(1e-9));
}

TEST_CASE("elasto_plastic: no drift under a load below its elastic limit, where lugre drifts",
          "[friction][elasto_plastic]") {
  // Loads up to 0.6 of the level; bristles that give way at 0.7 of it are a linear spring and damper for the mass,
  // whose transient falls as exp(-158 t).
  const auto load = [](double t) { return 0.3 - 0.3 * std::cos(20.0 * 3.141592653589793 * t); };
  const auto drift = [&](const Law& law) {
    test::ForcedMass mass(law, 1.0, load);
    for (int i = 0; i < 2'000; ++i) mass.step(1e-4);
    const double before = mass.x();
    for (int i = 0; i < 10'000; ++i) mass.step(1e-4);
    return mass.x() - before;  // over ten periods
  };
  CHECK(std::abs(drift(elasto_plastic_law(1.5, bristles, 0.7e-5))) < 1e-16);
  CHECK(drift(Law(Lugre(StribeckCurve(1.0, 1.5, 0.001), bristles))) > 1e-5);
  // Beyond the elastic limit it creeps as well.
  CHECK(drift(elasto_plastic_law(1.5, bristles, 0.3e-5)) > 1e-7);
}

TEST_CASE("elasto_plastic: an elastic limit beyond the kinetic level is refused", "[friction][elasto_plastic]") {
  const friction::LawEntry& entry = *friction::find_law("elasto_plastic");
  const auto faults = [&](double limit) {
    friction::ParameterValues given = elasto_plastic_values(1.5, bristles, limit);
    return friction::complete(entry, given);
  };
  CHECK(faults(0.99e-5).empty());
  const auto found = faults(1e-5);
  REQUIRE(found.size() == 1);
  CHECK(found[0].name == "elastic_limit");
  CHECK(found[0].allowed.find("1.0e-05 m") != std::string::npos);
}
