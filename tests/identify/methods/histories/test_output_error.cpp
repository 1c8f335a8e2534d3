#include "identify/methods/histories/output_error.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "friction_models/laws/viscous_saturating.hpp"
#include "identify/models/sampled_oscillator.hpp"
#include "identify/records/usable_histories.hpp"
#include "tests/identify/histories.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

History base_and_displacement(const sim::Model& model, double duration) {
  Normal normal(1);
  return displacement_only(sampled(model, duration, 1000.0), 0.0, normal);
}

}  // namespace

TEST_CASE("The motion between samples is that of the exact engine, through reversals and sticks") {
  // Interpolation of degree seven leaves (w T)^8 of the base motion, 1e-11 and less; at the record's ends more.
  for (const auto& [Y, omega] : {std::pair{4e-3, 38.79}, std::pair{4e-3, 20.0}, std::pair{2.8e-3, 20.0}}) {
    const sim::Model model = driven_bearing(bearing_c, bearing_F0, Y, omega);
    const History history = base_and_displacement(model, 3.0);
    SampledOscillator oscillator(history);
    Eigen::VectorXd x;
    REQUIRE(oscillator.run({1.042, bearing_c, 1568.0, bearing_F0, 3e-3, 0.0}, {}, x, nullptr));
    for (std::size_t i = 0; i < history.x.size(); ++i)
      REQUIRE(x[static_cast<Eigen::Index>(i)] == Approx(history.x[i]).margin(1e-14));
  }
}

TEST_CASE("Derivatives of the sampled motion are those of differences") {
  using By = SampledOscillator::By;
  const History history = base_and_displacement(driven_bearing(bearing_c, bearing_F0, 4e-3, 20.0), 1.0);
  SampledOscillator oscillator(history);
  const SampledOscillator::Parameters at{1.042, bearing_c, 1568.0, bearing_F0, 3e-3, 0.05};
  const std::vector<By> by{By::mass, By::damping, By::stiffness, By::friction, By::position, By::velocity};
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  REQUIRE(oscillator.run(at, by, x, &derivatives));
  const Eigen::MatrixXd& S = derivatives.x;
  double SampledOscillator::Parameters::* const members[] = {
      &SampledOscillator::Parameters::m,  &SampledOscillator::Parameters::c,  &SampledOscillator::Parameters::k,
      &SampledOscillator::Parameters::F0, &SampledOscillator::Parameters::x0, &SampledOscillator::Parameters::v0};
  for (std::size_t j = 0; j < by.size(); ++j) {
    const double scale = at.*members[j];
    const double step = 1e-6 * scale;
    SampledOscillator::Parameters high = at;
    SampledOscillator::Parameters low = at;
    high.*members[j] += step;
    low.*members[j] -= step;
    Eigen::VectorXd above;
    Eigen::VectorXd below;
    REQUIRE(oscillator.run(high, {}, above, nullptr));
    REQUIRE(oscillator.run(low, {}, below, nullptr));
    // Error of the central difference: step^2 times a third derivative, and rounding/step; where an event passes a
    // sample, the second derivative jumps and a difference is off by one step.
    const Eigen::VectorXd difference = (above - below) / (2.0 * step);
    const double size = S.col(static_cast<Eigen::Index>(j)).cwiseAbs().maxCoeff();
    CAPTURE(j);
    CHECK((difference - S.col(static_cast<Eigen::Index>(j))).cwiseAbs().maxCoeff() < 1e-5 * size);
  }
}

TEST_CASE("Exact data give the truth, with and without sticks") {
  for (const double omega : {38.79, 20.0}) {
    const Record record =
        record_of({base_and_displacement(driven_bearing(bearing_c, bearing_F0, 4e-3, omega), 5.0)});
    for (const double stiffness : {1568.0, unknown}) {
      const Estimate e = output_error(record, {1.042, stiffness}, {});
      REQUIRE(e.outcome.ok());
      CHECK(e.usable);
      CHECK(e.value.c == Approx(bearing_c).epsilon(1e-9));
      CHECK(e.value.F0 == Approx(bearing_F0).epsilon(1e-9));
      CHECK(e.warnings.empty());
    }
  }
}

TEST_CASE("A free decay needs no base motion, and two histories share their friction") {
  sim::Model decay = driven_bearing(bearing_c, bearing_F0, 0.0);
  decay.excitation = {};
  decay.initial = {40e-3, 0.0};
  sim::Model other = decay;
  other.initial = {-25e-3, 0.3};
  const Estimate e = output_error(record_of({base_and_displacement(decay, 1.0), base_and_displacement(other, 1.0)}),
                                  bearing_constants, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.used == std::vector<int>{1, 2});
  CHECK(e.value.c == Approx(bearing_c).epsilon(1e-9));
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(1e-9));
}

TEST_CASE("The speed of the first sample is found near a turn, where noise hides it") {
  // At 2 kHz eight samples span 3.5 ms: free, and under a drive that began long before.
  sim::Model free = driven_bearing(bearing_c, bearing_F0, 0.0);
  free.excitation = {};
  free.initial = {-20e-3, 0.05};
  sim::Model driven = driven_bearing(bearing_c, bearing_F0, 4e-3);
  driven.initial = {9e-3, 0.05};
  const double noise = 5e-5;
  for (const auto& [model, duration] : {std::pair(free, 0.6), std::pair(driven, 2.0)}) {
    Normal normal(4);
    const History history = displacement_only(sampled(model, duration, 2000.0), noise, normal);
    const Estimate e = output_error(record_of({history}), bearing_constants, {});
    REQUIRE(e.outcome.ok());
    CHECK(e.findings.empty());
    CHECK(e.value.c == Approx(bearing_c).epsilon(0.01));
    CHECK(e.value.F0 == Approx(bearing_F0).epsilon(0.01));
    // 1,200 samples leave the deviation with 2 %.
    CHECK(e.others.back().name == "residual_deviation");
    CHECK(e.others.back().value == Approx(noise).epsilon(0.08));
  }
}

TEST_CASE("Heavily damped releases are found among the minima of their fit") {
  // A minimum for each number of half swings, and one without Coulomb friction, which costs three times the noise.
  const double mass = 1.042;
  const double stiffness = 1568.0;
  for (const auto& [zeta, F0] : {std::pair(0.763, 1.08), std::pair(0.789, 1.48), std::pair(0.841, 2.79),
                                 std::pair(0.854, 1.88), std::pair(1.2, 2.0)}) {
    const double c = 2.0 * zeta * std::sqrt(mass * stiffness);
    sim::Model model = driven_bearing(c, F0, 0.0);
    model.excitation = {};
    model.initial = {100.0 * F0 / stiffness, 0.0};
    const History clean = sampled(model, 1.5, 1000.0);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      Normal normal(seed);
      const double noise = 0.1 * F0 / stiffness;
      const Estimate e = output_error(record_of({displacement_only(clean, noise, normal)}), bearing_constants, {});
      CAPTURE(zeta, seed, e.value.F0);
      REQUIRE(e.outcome.ok());
      CHECK(e.value.c == Approx(c).epsilon(5e-3));
      CHECK(e.value.F0 == Approx(F0).epsilon(0.05));
      CHECK(e.others.back().value == Approx(noise).epsilon(0.1));
    }
  }
}

TEST_CASE("A history shorter than the filters of other methods is fitted") {
  sim::Model model = driven_bearing(bearing_c, bearing_F0, 0.0);
  model.excitation = {};
  model.initial = {20e-3, 0.0};
  const History history = base_and_displacement(model, 0.06);
  REQUIRE_FALSE(fault_of_cutoff(history, cutoffs_for(history, {}).back()).empty());
  const Estimate e = output_error(record_of({history}), bearing_constants, {});
  CAPTURE(e.reason);
  REQUIRE(e.outcome.ok());
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(1e-6));
}

TEST_CASE("Intervals cover the truth under noise, with a tenth of the regression's error") {
  const History clean = sampled(driven_bearing(bearing_c, bearing_F0, 4e-3), 2.0, 500.0);
  int covered = 0;
  const int cases = 60;
  for (int seed = 0; seed < cases; ++seed) {
    Normal normal(static_cast<std::uint64_t>(seed));
    const Record record = record_of({displacement_only(clean, 2e-5, normal)});
    const Estimate e = output_error(record, bearing_constants, {});
    REQUIRE(e.outcome.ok());
    CHECK(std::abs(e.value.c / bearing_c - 1.0) < 0.02);
    covered += e.interval95->c[0] <= bearing_c && bearing_c <= e.interval95->c[1] ? 1 : 0;
    covered += e.interval95->F0[0] <= bearing_F0 && bearing_F0 <= e.interval95->F0[1] ? 1 : 0;
  }
  // Binomial at 0.95: three standard deviations of 120 correlated cases are 8 %.
  CHECK(covered >= static_cast<int>(0.87 * 2 * cases));
}

TEST_CASE("A wrong law, and a wrong stiffness, are told") {
  Normal normal(3);
  sim::Model saturating = driven_bearing(0.0, 3.16, 6e-3);
  saturating.friction.emplace_back(friction::ViscousSaturating(18.7, 0.69));
  const Estimate bent = output_error(record_of({displacement_only(sampled(saturating, 5.0, 500.0), 1e-6, normal)}),
                                     bearing_constants, {});
  REQUIRE(bent.outcome.ok());
  CHECK_FALSE(bent.usable);
  REQUIRE(bent.lack_of_fit);
  CHECK(bent.lack_of_fit->fired);
  const Record sound = record_of(
      {displacement_only(sampled(driven_bearing(bearing_c, bearing_F0, 4e-3), 5.0, 500.0), 1e-6, normal)});
  CHECK(output_error(sound, bearing_constants, {}).usable);
  const Estimate wrong = output_error(sound, {1.042, 1568.0 * 1.05}, {});
  REQUIRE(wrong.outcome.ok());
  CHECK_FALSE(wrong.usable);
  CHECK(wrong.reason.find("not noise alone") != std::string::npos);
}

TEST_CASE("What is missing is said") {
  const Record record = record_of({base_and_displacement(driven_bearing(bearing_c, bearing_F0, 4e-3), 1.0)});
  CHECK(output_error(record, {1.042, 0.0}, {}).reason ==
        "the method needs a spring: without one the position drifts");
  CHECK(output_error(record, {-1.0, 1568.0}, {}).reason == "the mass must be positive and finite");
  CHECK_FALSE(output_error(record, {unknown, unknown}, {}).outcome.ok());
  Record still = record;
  for (double& x : still.histories[0].x) x = 0.001;
  CHECK(output_error(still, bearing_constants, {}).reason == "the mass moves in no history");
}

TEST_CASE("A record too long to be fitted in reasonable time is refused, and how it would go is said") {
  History history{.sample_rate = 1000.0};
  for (int i = 0; i < 300'001; ++i) {
    history.y.push_back(std::sin(0.03 * i));
    history.x.push_back(std::cos(0.03 * i));
  }
  Record record;
  record.histories = {history};
  const Estimate e = output_error(record, {1.0, 100.0, unknown}, {});
  CHECK_FALSE(e.outcome.ok());
  CHECK(e.reason.find("at most 300000 samples, and the record has 300001") != std::string::npos);
}
