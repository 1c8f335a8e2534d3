#include "friction_models/laws/lugre.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/dahl.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/forced_mass.hpp"
#include "tests/support/sliding.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Law;
using friction::Lugre;
using friction::StribeckCurve;

namespace {

struct Values {
  double kinetic = 1.0;
  double static_level = 1.5;
  double velocity = 0.001;
  Lugre::Bristles bristles{};

  [[nodiscard]] friction::ParameterValues named() const {
    return {{"kinetic", kinetic},        {"static", static_level},    {"stribeck_velocity", velocity},
            {"sigma0", bristles.sigma0}, {"sigma1", bristles.sigma1}, {"sigma2", bristles.sigma2}};
  }
  [[nodiscard]] Law law(double factor = 1.0) const {
    return Law(Lugre(StribeckCurve(factor * kinetic, factor * static_level, velocity), bristles));
  }
};

/// Table I of canudas1995, whose mass is 1 kg.
const Values published{.bristles = {1e5, 316.22776601683796, 0.4}};

sim::LawCase lugre(const Values& values) {
  sim::LawCase c = sim::law_case("lugre", values.named());
  c.stroke = 30.0 * values.static_level / values.bristles.sigma0;
  c.passive = Lugre::warnings(values.named()).empty();
  c.scaled = [=](double factor) { return values.law(factor); };
  return c;
}

/// Drags the law by `distance` at this speed.
void drag(sim::LawHost& host, double speed, double distance) {
  test::slide(host, speed, distance / std::abs(speed));
}

}  // namespace

TEST_CASE("lugre conforms to the law contract", "[friction][lugre]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(lugre(published)) == none);
  CHECK(sim::nonconformities(lugre({2.0, 3.0, 0.05, {1e4, 20.0, 0.0}})) == none);
  CHECK(sim::nonconformities(lugre({2.0, 2.0, 0.05, {1e5, 316.0, 0.0}})) == none);
  CHECK(sim::nonconformities(lugre({2.0, 3.0, 1e-4, {1e4, 20.0, 10.0}})) == none);
}

TEST_CASE("lugre: steady sliding", "[friction][lugre]") {
  // F = g(v) sgn v + sigma2 v; z comes to it as exp(-sigma0 x/g), here exp(-100/1.5).
  for (const double v : {1e-5, 1e-3, 2e-3, 0.5, -0.001, -0.3}) {
    INFO(v);
    sim::LawHost host(published.law(), {});
    drag(host, v, 1e-3);
    const double r = v / 0.001;
    const double level = 1.0 + 0.5 * std::exp(-r * r);
    CHECK(host.force() == Approx(std::copysign(level, v) + 0.4 * v).epsilon(1e-9));
  }
}

TEST_CASE("lugre: without damping and with one level it is dahl", "[friction][lugre]") {
  const Law lugre = Values{2.0, 2.0, 0.05, {1e4, 0.0, 0.0}}.law();
  const Law dahl(friction::Dahl(2.0, 1e4, 1.0));
  for (const double z : {-1.9e-4, -1e-5, 0.0, 3e-5, 2e-4}) {
    for (const double v : {-0.3, -1e-6, 1e-6, 0.3}) {
      const friction::Memory memory{.state = {z}};
      const Direction direction = v < 0.0 ? Direction::backward : Direction::forward;
      double one = 0.0;
      double other = 0.0;
      CHECK(lugre.respond(memory, {.v = v}, direction, {&one, 1}) ==
            Approx(dahl.respond(memory, {.v = v}, direction, {&other, 1})).epsilon(1e-15));
      CHECK(std::abs(one - other) < 1e-15 * std::abs(v));
    }
  }
}

TEST_CASE("lugre: its published values give out work, and it says so", "[friction][lugre]") {
  // Loaded slowly to the static level, then pulled away at 10 m/s over the distance kinetic/sigma0: sigma1 z' =
  // -sigma1 v (static - kinetic)/kinetic = -1581 N at first. barabanov2000: it takes sigma2 >= sigma1 (static -
  // kinetic)/kinetic to outweigh that.
  const auto work = [](const Values& values) {
    sim::LawHost host(values.law(), {});
    drag(host, 1e-4, 2e-4);
    drag(host, 10.0, 1e-5);
    return host.work();
  };
  Values passive = published;
  passive.bristles.sigma2 = 0.5 * passive.bristles.sigma1;
  CHECK(work(published) < -1e-3);
  CHECK(work(passive) > 1e-4);
  CHECK(Lugre::warnings(passive.named()).empty());
  const std::vector<std::string> warnings = Lugre::warnings(published.named());
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("158.1 N.s/m") != std::string::npos);
}

TEST_CASE("lugre: the break-away force falls as the load grows faster", "[friction][lugre]") {
  // As canudas1995 found: near the static level for slow loads, towards the kinetic one for fast loads. Break-away:
  // the largest friction force of a free mass under a load that grows at this rate.
  const auto break_away = [](double rate) {
    test::ForcedMass mass(published.law(), 1.0, [=](double t) { return rate * t; });
    double largest = 0.0;
    while (mass.x() < 5e-5) {
      mass.step(1e-5);
      largest = std::max(largest, mass.force());
    }
    return largest;
  };
  double before = 1.5;
  for (const double rate : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const double force = break_away(rate);
    INFO(rate << " N/s: " << force << " N");
    CHECK(force < before);
    CHECK(force > 1.0);
    before = force;
  }
}

TEST_CASE("lugre: the mass drifts under a load that oscillates below break-away", "[friction][lugre]") {
  // Apart from the drift the mass does not move: F = sigma0 z = the load, between a and b of the level g: dx =
  // g/sigma0 dr/(1 - r) on the way up, g/sigma0 dr/(1 + r) down, so each period moves the mass by g/sigma0 ln((1 -
  // a^2)/(1 - b^2)). A load of 0.1 Hz leaves sigma1 v, 0.2 % of the load.
  const Values values{1.0, 1.0, 0.001, {1e5, 316.0, 0.0}};
  const double omega = 0.2 * 3.141592653589793;
  test::ForcedMass mass(values.law(), 1.0, [=](double t) { return 0.3 - 0.3 * std::cos(omega * t); });
  std::vector<double> places;
  for (int period = 0; period < 3; ++period) {
    for (int i = 0; i < 10'000; ++i) mass.step(1e-3);
    places.push_back(mass.x());
  }
  const double drift = 1e-5 * std::log(1.0 / (1.0 - 0.36));
  CHECK(places[1] - places[0] == Approx(drift).epsilon(0.01));
  CHECK(places[2] - places[1] == Approx(drift).epsilon(0.01));
}
