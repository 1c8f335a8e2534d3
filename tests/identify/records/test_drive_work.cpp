#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "identify/records/faults/sign_faults.hpp"
#include "identify/records/plausibility.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using identify::testing::mentions;
using std::numbers::pi;

namespace {

/// Faults of a motion that starts at rest under a force of these tones [Hz], recorded `late` seconds late, with a
/// sign and with a wrong stiffness.
std::string faults_of_tones(const std::vector<double>& tones, double sign, double late, double stiffness = 1.0) {
  const double m = 1.3, c = 3.1, k = 1850.0, rate = 500.0;
  constexpr int finer = 20;
  const auto force = [&](double t) {
    double sum = 0.0;
    for (const double tone : tones) sum += 15.0 * std::sin(2.0 * pi * tone * t + tone);
    return sum;
  };
  History history{.sample_rate = rate};
  double x = 0.0, v = 0.0;
  for (int i = 0; i < 1500 * finer; ++i) {
    const double t = i / (rate * finer);
    if (i % finer == 0) {
      history.x.push_back(x);
      history.force.push_back(sign * force(t - late));
    }
    v += (force(t) - k * x - c * v - 1.1 * std::tanh(v / 1e-3)) / m / (rate * finer);
    x += v / (rate * finer);
  }
  std::string text;
  for (const core::Diagnostic& fault :
       gross_faults({.histories = {history}}, {m, k * stiffness, unknown}, {}, "f.csv"))
    text += core::format(fault) + "\n";
  return text;
}

}  // namespace

TEST_CASE("A force of the wrong sign away from resonance is refused, and a late one is not") {
  // At 4.1 and 7.3 Hz force and motion exchange four times the work that friction takes.
  for (const std::vector<double>& tones : {std::vector{4.1, 7.3}, {4.1}, {8.0}, {6.0}, {5.0, 5.5}}) {
    CAPTURE(tones);
    CHECK(mentions(faults_of_tones(tones, -1.0, 0.0), "one of them has the wrong sign"));
    CHECK(mentions(faults_of_tones(tones, -1.0, 0.0, 1.3), "one of them has the wrong sign"));
    for (const double late : {-0.015, -0.003, 0.0, 0.003, 0.015}) {
      CAPTURE(late);
      CHECK(faults_of_tones(tones, 1.0, late).empty());
    }
    for (const double stiffness : {0.25, 0.6, 0.9, 1.1, 1.6, 4.0}) {
      CAPTURE(stiffness);
      CHECK(faults_of_tones(tones, 1.0, 0.0, stiffness).empty());
    }
  }
}

TEST_CASE("plausibility: the force of a loop gives no energy out of friction", "[identify]") {
  // A force of mass, spring and friction along two tones. A nearly elastic loop has losses of either sign: by
  // noise, or by a delay of a hundredth of a period.
  const auto faults = [](double friction, double sign, double late, bool has_x, std::uint64_t seed) {
    const core::RandomStream draws{seed, 940};
    constexpr double rate = 500.0;
    History history{.sample_rate = rate};
    const auto x = [](double t) { return 0.01 * std::cos(8.2 * t) + 0.004 * std::cos(18.2 * t + 1.0); };
    const auto v = [](double t) { return -0.082 * std::sin(8.2 * t) - 0.0728 * std::sin(18.2 * t + 1.0); };
    const auto a = [](double t) { return -0.6724 * std::cos(8.2 * t) - 1.325 * std::cos(18.2 * t + 1.0); };
    for (int i = 0; i < 1500; ++i) {
      const double t = i / rate;
      if (has_x)
        history.x.push_back(x(t - late));
      else
        history.v.push_back(v(t));
      const double force = 2.0 * a(t) + 600.0 * x(t) + friction * (v(t) > 0.0 ? 1.0 : -1.0) + 0.7;
      history.force.push_back(sign * force + 0.1 * draws.normal(static_cast<std::uint64_t>(i)));
    }
    std::string text;
    for (const core::Diagnostic& fault : gross_faults_of_loops({.histories = {history}}, {}, "loop.csv"))
      text += core::format(fault);
    return text;
  };
  for (const bool has_x : {true, false}) {
    CAPTURE(has_x);
    CHECK_THAT(faults(1.0, -1.0, 0.0, has_x, 1),
               Catch::Contains("loop.csv") && Catch::Contains("takes") && Catch::Contains("wrong sign"));
    CHECK(faults(1.0, 1.0, 0.0, has_x, 1).empty());
  }
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CHECK(faults(0.0, 1.0, 0.0, true, seed).empty());
    CHECK(faults(0.02, 1.0, -0.005, true, seed).empty());
    CHECK(faults(0.02, 1.0, 0.005, true, seed).empty());
  }
}

TEST_CASE("plausibility: a force that drives steady states is ahead of them", "[identify]") {
  const auto faults = [](double factor, double turn, double stiffness) {
    PairRecord record;
    for (int i = 0; i < 8; ++i) {
      const double omega = 25.0 + 2.0 * i, F = 3.0, c = 4.0;
      const double re = 1000.0 - omega * omega, im = c * omega;
      record.pairs.push_back({.Y = F,
                              .x = F / std::hypot(re, im),
                              .number = i + 1,
                              .omega = omega,
                              .phase = factor * std::atan2(im, re) + turn});
    }
    std::string text;
    for (const core::Diagnostic& fault :
         gross_faults_under_force(record, {.mass = 1.0, .stiffness = stiffness}, "pairs.csv"))
      text += core::format(fault);
    return text;
  };
  for (const double stiffness : {1000.0, unknown}) {
    CHECK(faults(1.0, 0.0, stiffness).empty());
    CHECK_THAT(faults(-1.0, 0.0, stiffness),
               Catch::Contains("x leads the force") && Catch::Contains("phase has the wrong sign"));
    CHECK_THAT(faults(1.0, pi, stiffness), Catch::Contains("x or Y has the wrong sign"));
  }
  CHECK_THAT(faults(-1.0, 0.0, 1000.0), !Catch::Contains("x or Y has the wrong sign"));
  CHECK_THAT(faults(1.0, pi, 1000.0), !Catch::Contains("phase has the wrong sign"));
}
