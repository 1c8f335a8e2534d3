#include "friction_models/laws/iwan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/random.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::ContactCompliance;
using friction::Iwan;
using friction::Law;

namespace {

/// The elements as so many contacts side by side, each with a memory of its own.
class Contacts {
 public:
  explicit Contacts(const std::vector<Iwan::Element>& elements) {
    for (const auto& [stiffness, limit] : elements)
      hosts_.emplace_back(Law(ContactCompliance(limit, limit, stiffness, 0.0)), friction::Instant{});
  }
  void move_to(double x) {
    for (sim::LawHost& host : hosts_) host.move_to(x);
  }
  [[nodiscard]] double force() const {
    double sum = 0.0;
    for (const sim::LawHost& host : hosts_) sum += host.force();
    return sum;
  }

 private:
  std::vector<sim::LawHost> hosts_;
};

}  // namespace

TEST_CASE("iwan conforms to the law contract", "[friction][iwan]") {
  const std::vector<std::string> none;
  const auto element = [](double stiffness, double limit) {
    return friction::ParameterValues{{"stiffness", stiffness}, {"limit", limit}};
  };
  const std::vector<friction::ParameterValues> list = {element(500.0, 0.1), element(1e4, 1.0), element(1e3, 3.0),
                                                       element(1e4, 1.0)};
  std::vector<sim::LawCase> cases = {sim::law_case("iwan", {{"elements", list}})};
  for (const double count : {1.0, 12.0})
    cases.push_back(sim::law_case("iwan", {{"stiffness", 1e4}, {"limit", 2.0}, {"count", count}}));
  for (sim::LawCase& c : cases) {
    c.stroke = 0.02;
    CHECK(sim::nonconformities(c) == none);
  }
}

TEST_CASE("iwan is its elements in parallel, along random paths", "[friction][iwan]") {
  test::Random random(11);
  for (int round = 0; round < 20; ++round) {
    std::vector<Iwan::Element> elements;
    const int count = 1 + random.pick(12);
    for (int i = 0; i < count; ++i) {
      const double stiffness = random.logarithmic(10.0, 1e4);
      elements.push_back({stiffness, stiffness * random.logarithmic(1e-3, 1.0)});
      // Equal slip distances are merged.
      if (random.chance(0.3)) elements.push_back({2.0 * stiffness, 2.0 * elements.back().limit});
    }
    double total = 0.0;
    for (const auto& element : elements) total += element.limit;
    sim::LawHost iwan(Law(Iwan(elements)), {});
    Contacts contacts(elements);
    for (int i = 0; i < 60; ++i) {
      const double x = random.sign() * random.logarithmic(1e-4, 2.0);
      iwan.move_to(x);
      contacts.move_to(x);
      REQUIRE_FALSE(iwan.broken());
      // Positions to rounding of 2 m times the greatest stiffness; both hosts let a guard overrun by 1e-12.
      REQUIRE(std::abs(iwan.force() - contacts.force()) < 1e-10 * total + 1e-11 * 1e4);
    }
  }
}

TEST_CASE("iwan: the backbone of uniform elements", "[friction][iwan]") {
  // n elements: sum of min(k_i x, f_i); for n growing k x - k^2 x^2/(4 F), which is F at x = 2 F/k.
  const double stiffness = 1e4;
  const double limit = 2.0;
  for (const int n : {1, 7, 400}) {
    sim::LawHost host(Law(Iwan(Iwan::uniform(stiffness, limit, n))), {});
    for (const double x : {2e-5, 1e-4, 2.1e-4, 3.9e-4, 4e-4, 1.0}) {
      host.move_to(x);
      double sum = 0.0;
      for (int i = 0; i < n; ++i) sum += std::min(stiffness / n * x, 2.0 * limit * (i + 0.5) / (n * n));
      CHECK(host.force() == Approx(sum).epsilon(1e-11));
      const double smooth = x < 4e-4 ? stiffness * x - stiffness * stiffness * x * x / (4.0 * limit) : limit;
      // The midpoint rule over the slip distances errs by at most half an element's limit, F/n^2 on average.
      CHECK(std::abs(host.force() - smooth) <= limit / (n * n));
    }
  }
}

TEST_CASE("iwan: Masing's rule, and the loop of uniform elements", "[friction][iwan]") {
  const double stiffness = 1e4;
  const double limit = 2.0;
  const int n = 300;
  const Law law(Iwan(Iwan::uniform(stiffness, limit, n)));
  const double amplitude = 1.7e-4;
  sim::LawHost backbone(law, {});
  sim::LawHost loop(law, {});
  loop.move_to(amplitude);
  const double at_reversal = loop.force();
  // The branch after a reversal is the backbone with both axes doubled.
  for (const double way : {1e-5, 6e-5, 1.1e-4, 1.7e-4}) {
    backbone.move_to(way);
    loop.move_to(amplitude - 2.0 * way);
    CHECK(loop.force() == Approx(at_reversal - 2.0 * backbone.force()).epsilon(1e-10));
  }
  loop.move_to(amplitude);
  const double before = loop.work();
  loop.move_to(-amplitude);
  loop.move_to(amplitude);
  // Every element with d < A takes 4 f (A - d); with density k^2/(2 F) this is k^2 A^3/(3 F) for n growing.
  double sum = 0.0;
  for (const auto& [k, f] : Iwan::uniform(stiffness, limit, n)) sum += 4.0 * f * std::max(0.0, amplitude - f / k);
  CHECK(loop.work() - before == Approx(sum).epsilon(1e-10));
  const double smooth = stiffness * stiffness * std::pow(amplitude, 3) / (3.0 * limit);
  CHECK(sum == Approx(smooth).epsilon(3.0 / n));
}

TEST_CASE("iwan: return-point memory, and forgotten inner loops", "[friction][iwan]") {
  sim::LawHost inner(Law(Iwan(Iwan::uniform(1e4, 2.0, 50))), {});
  sim::LawHost straight = inner;
  inner.move_to(2e-4);
  straight.move_to(2e-4);
  const double force = inner.force();
  for (const double x : {1e-4, 1.5e-4, 1.2e-4, 1.4e-4, 2e-4}) inner.move_to(x);
  CHECK(inner.force() == Approx(force).epsilon(1e-12));
  inner.move_to(3e-4);
  straight.move_to(3e-4);
  CHECK(inner.force() == Approx(straight.force()).epsilon(1e-12));
  CHECK(inner.memory() == straight.memory());
}

TEST_CASE("iwan of one element is contact_compliance in the standard system", "[friction][iwan]") {
  const test::SettledMotion motion = test::settled_motion(Law(Iwan({{1e4, 2.0}})));
  CHECK(std::abs(motion.peak - 0.186333154800891) < 1e-14);
}

TEST_CASE("iwan: friction work in the standard system is that of its elements", "[friction][iwan]") {
  const std::vector<Iwan::Element> elements = Iwan::uniform(500.0, 10.0, 40);
  const test::SettledMotion motion = test::settled_motion(Law(Iwan(elements)));
  // The transient leaves a mean stress in the elements that do not slide any more, and so a mean position.
  const double amplitude = (motion.peak - motion.trough) / 2.0;
  CHECK(motion.peak + motion.trough < -1e-3);
  double sum = 0.0;
  for (const auto& [k, f] : elements) sum += 4.0 * f * std::max(0.0, amplitude - f / k);
  CHECK(motion.friction_work == Approx(sum).epsilon(1e-9));
}
