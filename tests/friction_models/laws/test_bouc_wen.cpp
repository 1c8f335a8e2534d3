#include "friction_models/laws/bouc_wen.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/dahl.hpp"
#include "friction_models/laws/iwan.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using friction::BoucWen;
using friction::Law;

namespace {

sim::LawCase bouc_wen(double exponent, double ratio, double beta_share) {
  sim::LawCase c = sim::law_case(
      "bouc_wen",
      {{"limit", 2.0}, {"stiffness", 1e4}, {"exponent", exponent}, {"ratio", ratio}, {"beta_share", beta_share}});
  c.stroke = 20.0 * 2.0 / 1e4;
  c.passive = beta_share >= 0.5;
  c.scaled = [=](double factor) { return Law(BoucWen(factor * 2.0, 1e4, exponent, ratio, beta_share)); };
  return c;
}

}  // namespace

TEST_CASE("bouc_wen conforms to the law contract", "[friction][bouc_wen]") {
  const std::vector<std::string> none;
  CHECK(sim::nonconformities(bouc_wen(1.0, 0.0, 0.5)) == none);
  CHECK(sim::nonconformities(bouc_wen(2.0, 0.1, 0.7)) == none);
  CHECK(sim::nonconformities(bouc_wen(1.5, 0.0, 0.1)) == none);
  CHECK(sim::nonconformities(bouc_wen(30.0, 0.3, 1.0)) == none);
  CHECK(sim::nonconformities(bouc_wen(3.0, 0.0, 1.4)) == none);
}

TEST_CASE("bouc_wen: first loading in closed form", "[friction][bouc_wen]") {
  // z/z0 = 1 - exp(-x/z0) for the exponent 1, tanh(x/z0) for 2, whatever b.
  const double z0 = 2e-4;
  for (const double b : {0.0, 0.5, 1.0}) {
    sim::LawHost one(Law(BoucWen(2.0, 1e4, 1.0, 0.2, b)), {});
    sim::LawHost two(Law(BoucWen(2.0, 1e4, 2.0, 0.2, b)), {});
    for (const double r : {0.1, 1.0, 4.0}) {
      one.move_to(r * z0);
      two.move_to(r * z0);
      CHECK(one.force() == Approx(2.0 * (0.2 * r + 0.8 * (1.0 - std::exp(-r)))).epsilon(1e-9));
      CHECK(two.force() == Approx(2.0 * (0.2 * r + 0.8 * std::tanh(r))).epsilon(1e-9));
    }
  }
}

TEST_CASE("bouc_wen: with b = 1 and exponent 1 it is dahl", "[friction][bouc_wen]") {
  test::Random random(11);
  sim::LawHost bouc(Law(BoucWen(2.0, 1e4, 1.0, 0.0, 1.0)), {});
  sim::LawHost dahl(Law(friction::Dahl(2.0, 1e4, 1.0)), {});
  for (int i = 0; i < 100; ++i) {
    const double x = random.sign() * random.logarithmic(1e-6, 1e-3);
    bouc.move_to(x);
    dahl.move_to(x);
    CHECK(std::abs(bouc.force() - dahl.force()) < 1e-8);
  }
}

TEST_CASE("bouc_wen: a large exponent leaves contact_compliance", "[friction][bouc_wen]") {
  // Unloading is elastic in both at b = 1/2. They differ most where the slider begins to slide: with 1 - r = d
  // there, integral of dr/(1 - r^n) = 1 gives exp(-n d) = 1 - exp(-n d) for large n, so n d tends to ln 2, as 1/n.
  const double z0 = 2e-4;
  for (const double n : {100.0, 1000.0}) {
    const Law law(BoucWen(2.0, 1e4, n, 0.0, 0.5));
    sim::LawHost onset(law, {});
    onset.move_to(z0);
    const double gap = n * (2.0 - onset.force()) / 2.0;
    CHECK(gap == Approx(std::log(2.0)).epsilon(5.0 / n));
    sim::LawHost bouc(law, {});
    sim::LawHost contact(Law(friction::ContactCompliance(2.0, 2.0, 1e4, 0.0)), {});
    test::Random random(5);
    for (int i = 0; i < 300; ++i) {
      const double x = random.uniform(-3.0, 3.0) * z0;
      bouc.move_to(x);
      contact.move_to(x);
      CHECK(n * std::abs(bouc.force() - contact.force()) / 2.0 < 1.001 * gap);
    }
  }
}

TEST_CASE("bouc_wen: an inner loop does not close, that of iwan does", "[friction][bouc_wen]") {
  const double z0 = 2e-4;
  const auto lost = [&](const Law& law) {
    sim::LawHost host(law, {});
    host.move_to(z0);
    const double before = host.force();
    host.move_to(0.7 * z0);
    host.move_to(z0);
    return (before - host.force()) / before;
  };
  // Unloading is elastic to z = tanh(1) - 0.3, reloading goes along another tanh: tanh(atanh(tanh(1) - 0.3) + 0.3).
  const double z = std::tanh(1.0);
  CHECK(lost(Law(BoucWen(2.0, 1e4, 2.0, 0.0, 0.5))) ==
        Approx(1.0 - std::tanh(std::atanh(z - 0.3) + 0.3) / z).epsilon(1e-8));
  CHECK(std::abs(lost(Law(friction::Iwan(friction::Iwan::uniform(1e4, 2.0, 20))))) < 1e-12);
}

TEST_CASE("bouc_wen: it gives out work in unloading when b is below 1/2, and says so", "[friction][bouc_wen]") {
  // Heat in unloading is F |v| r (2 b - 1) with r = z/z0, exponent 1.
  const auto heat_of_unloading = [](double b) {
    sim::LawHost host(Law(BoucWen(2.0, 1e4, 1.0, 0.0, b)), {});
    host.move_to(2e-4);
    const double before = host.heat();
    host.move_to(1e-4);
    return host.heat() - before;
  };
  CHECK(heat_of_unloading(0.3) < -1e-6);
  CHECK(std::abs(heat_of_unloading(0.5)) < 1e-15);
  CHECK(heat_of_unloading(0.7) > 1e-6);
  const auto warned = [](double b) { return !BoucWen::warnings({{"beta_share", b}}).empty(); };
  CHECK(warned(0.49));
  CHECK_FALSE(warned(0.5));
}
