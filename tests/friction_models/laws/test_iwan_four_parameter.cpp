#include "friction_models/laws/iwan_four_parameter.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Iwan;
using friction::IwanFourParameter;
using friction::Law;

namespace {

const std::vector<IwanFourParameter> joints = {
    {.stiffness = 1e4, .limit = 2.0, .exponent = -0.5, .beta = 0.3},
    {.stiffness = 3e3, .limit = 5.0, .exponent = -0.85, .beta = 0.0},
    {.stiffness = 1e4, .limit = 2.0, .exponent = 0.0, .beta = 2.0},
    {.stiffness = 1e4, .limit = 2.0, .exponent = 1.3, .beta = 0.1},
};

/// Logarithm of the ratio of the grid.
double step(int count, double smallest) { return -std::log(smallest) / (count - 1); }

/// Work of a loop of this amplitude, by the host, which moves the law through its own events.
double loop_work(const Law& law, double amplitude) {
  sim::LawHost host(law, {});
  host.move_to(amplitude);
  const double before = host.work();
  host.move_to(-amplitude);
  host.move_to(amplitude);
  REQUIRE_FALSE(host.broken());
  return host.work() - before;
}

/// 4 R A^(chi+3)/((chi+2)(chi+3))
double smooth_work(const IwanFourParameter& j, double amplitude) {
  return 4.0 * j.R() * std::pow(amplitude, j.exponent + 3.0) / ((j.exponent + 2.0) * (j.exponent + 3.0));
}

/// What sliding takes from the first loading: R x^(chi+2)/((chi+1)(chi+2)).
double smooth_slipping(const IwanFourParameter& j, double x) {
  return j.R() * std::pow(x, j.exponent + 2.0) / ((j.exponent + 1.0) * (j.exponent + 2.0));
}

}  // namespace

TEST_CASE("iwan_four_parameter conforms to the law contract", "[friction][iwan_four_parameter]") {
  const std::vector<std::string> none;
  for (const double beta : {0.0, 0.7}) {
    sim::LawCase c = sim::law_case("iwan_four_parameter", {{"stiffness", 1e4},
                                                           {"limit", 2.0},
                                                           {"exponent", -0.4},
                                                           {"beta", beta},
                                                           {"count", 12.0},
                                                           {"smallest", 0.02}});
    c.stroke = 0.02;
    CHECK(sim::nonconformities(c) == none);
  }
}

TEST_CASE("iwan_four_parameter: stiffness and macroslip force are those given, for any grid",
          "[iwan_four_parameter]") {
  for (const IwanFourParameter& joint : joints) {
    // By the density, as segalman2005 has them.
    const double power = joint.exponent + 1.0;
    CHECK(joint.R() * std::pow(joint.phi_max(), power) / power + joint.S() == Approx(joint.stiffness));
    CHECK(joint.R() * std::pow(joint.phi_max(), power + 1.0) / (power + 1.0) + joint.S() * joint.phi_max() ==
          Approx(joint.limit));
    for (const int count : {2, 17, 300}) {
      double stiffness = 0.0;
      double limit = 0.0;
      for (const auto& [k, f] : joint.elements(count, 1e-3)) {
        CHECK(f / k <= joint.phi_max() * (1.0 + 1e-14));
        stiffness += k;
        limit += f;
      }
      CHECK(stiffness == Approx(joint.stiffness).epsilon(1e-13));
      CHECK(limit == Approx(joint.limit).epsilon(1e-13));
    }
  }
}

TEST_CASE("iwan_four_parameter: the first loading is exact at the edges and within the stated error between them",
          "[iwan_four_parameter]") {
  const int count = 61;
  const double smallest = 1e-3;
  const double ln_q = step(count, smallest);
  for (const IwanFourParameter& joint : joints) {
    const Law law(Iwan(joint.elements(count, smallest)));
    sim::LawHost host(law, {});
    const double chi = joint.exponent;
    const double stated = (chi + 1.0) * (chi + 2.0) * ln_q * ln_q / 8.0;
    double worst = 0.0;
    for (double half_cell = -60.0; half_cell <= 0.0; half_cell += 0.25) {
      const double x = joint.phi_max() * std::exp(half_cell * ln_q);
      host.move_to(x);
      const double slipping = joint.stiffness * x - host.force();
      const double error = (smooth_slipping(joint, x) - slipping) / smooth_slipping(joint, x);
      if (half_cell == std::floor(half_cell)) {
        CHECK(std::abs(error) < 1e-7);
      } else {
        CHECK(error > -1e-7);
        worst = std::max(worst, error);
      }
    }
    // To leading order of ln q = 0.12.
    CHECK(worst < 1.15 * stated);
    CHECK(worst > 0.5 * stated);
    host.move_to(2.0 * joint.phi_max());
    CHECK(host.force() == Approx(joint.limit).epsilon(1e-12));
  }
}

TEST_CASE("iwan_four_parameter: the work of a loop goes by the power chi + 3, to the stated error",
          "[iwan_four_parameter]") {
  const int count = 100;
  const double smallest = 1e-4;
  const double ln_q = step(count, smallest);
  for (const IwanFourParameter& joint : joints) {
    CAPTURE(joint.exponent);
    const Law law(Iwan(joint.elements(count, smallest)));
    const double chi = joint.exponent;
    std::vector<double> amplitudes;
    std::vector<double> works;
    for (const int cells : {60, 45, 30, 15, 0}) {
      const double amplitude = joint.phi_max() * std::exp(-cells * ln_q);
      const double work = loop_work(law, amplitude);
      const double stated = (chi + 2.0) * ln_q * ln_q / 12.0 +
                            std::pow(smallest * joint.phi_max() / amplitude, chi + 3.0) / (chi + 2.0);
      CHECK(work / smooth_work(joint, amplitude) - 1.0 == Approx(stated).epsilon(0.05));
      amplitudes.push_back(amplitude);
      works.push_back(work);
    }
    // Over 5.6 decades of work, far from the smallest cell.
    const double exponent =
        std::log(works.back() / works.front()) / std::log(amplitudes.back() / amplitudes.front());
    CHECK(exponent == Approx(joint.exponent + 3.0).margin(1e-4));
  }
}

TEST_CASE("iwan_four_parameter: half way between edges the work of a loop is too small by the stated fraction",
          "[iwan_four_parameter]") {
  const int count = 300;
  const double smallest = 1e-4;
  const double ln_q = step(count, smallest);
  for (const IwanFourParameter& joint : joints) {
    const double chi = joint.exponent;
    const Law law(Iwan(joint.elements(count, smallest)));
    double worst = 0.0;
    for (double cells = 100.0; cells > 99.0; cells -= 0.125) {
      const double amplitude = joint.phi_max() * std::exp(-cells * ln_q);
      const double error = loop_work(law, amplitude) / smooth_work(joint, amplitude) - 1.0 -
                           std::pow(smallest * joint.phi_max() / amplitude, chi + 3.0) / (chi + 2.0);
      worst = std::min(worst, error);
      if (cells == 99.5) CHECK(error == worst);
    }
    CAPTURE(chi);
    CHECK(worst == Approx(-(chi + 2.0) * (3.0 * chi + 7.0) * ln_q * ln_q / 24.0).epsilon(0.06));
  }
}

TEST_CASE("iwan_four_parameter with chi = 0 and beta = 0 is the uniform iwan of the same stiffness and limit",
          "[iwan_four_parameter]") {
  const IwanFourParameter joint{.stiffness = 1e4, .limit = 2.0};
  CHECK(joint.phi_max() == Approx(2.0 * joint.limit / joint.stiffness));
  sim::LawHost power(Law(Iwan(joint.elements(400, 1e-3))), {});
  sim::LawHost uniform(Law(Iwan(Iwan::uniform(1e4, 2.0, 400))), {});
  for (const double x : {1e-4, 3.3e-4, -1e-4, 2e-4, -5e-4, 1e-5}) {
    power.move_to(x);
    uniform.move_to(x);
    // (ln q)^2/4 = 7.5e-5 of what slides, 2 N at most, and after a reversal twice that of half the way.
    CHECK(std::abs(power.force() - uniform.force()) < 4e-4);
  }
}

TEST_CASE("iwan_four_parameter: beyond phi_max the work grows by 4 F_S an amplitude", "[iwan_four_parameter]") {
  for (const IwanFourParameter& joint : joints) {
    const Law law(Iwan(joint.elements(100, 1e-4)));
    const double a = 1.5 * joint.phi_max();
    const double b = 3.0 * joint.phi_max();
    CHECK(loop_work(law, b) - loop_work(law, a) == Approx(4.0 * joint.limit * (b - a)).epsilon(1e-9));
  }
}

TEST_CASE("iwan_four_parameter: friction work in the standard system is that of its loop",
          "[iwan_four_parameter]") {
  const IwanFourParameter joint{.stiffness = 400.0, .limit = 20.0, .exponent = -0.5, .beta = 1.0};
  const test::SettledMotion motion = test::settled_motion(Law(Iwan(joint.elements(200, 1e-4))));
  const double amplitude = (motion.peak - motion.trough) / 2.0;
  REQUIRE(amplitude < joint.phi_max());
  CHECK(motion.friction_work == Approx(smooth_work(joint, amplitude)).epsilon(2e-3));
}

TEST_CASE("iwan_four_parameter: values out of range are refused", "[iwan_four_parameter]") {
  friction::ParameterValues values = {
      {"stiffness", 1e4}, {"limit", 2.0}, {"exponent", -1.0}, {"beta", 0.0}, {"smallest", 1.0}};
  const auto faults = friction::complete(IwanFourParameter::parameters(), values);
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].name == "exponent");
  CHECK(faults[0].allowed == "> -1 and <= 20");
  CHECK(faults[1].name == "smallest");
}
