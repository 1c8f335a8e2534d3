#include "identify/methods/histories/stochastic_averaging.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "tests/identify/estimates.hpp"
#include "tests/identify/random_response.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double D = 0.7;

}  // namespace

TEST_CASE("The mean power of friction is m D/2") {
  // Ito's formula for the energy; 400 s have a deviation of sqrt(2/(zeta W T)) in the mean square.
  const History history = random_response(5.0, 1.0, D, 400.0, 1);
  double power = 0.0;
  for (const double v : history.v) power += (5.0 * v * v + std::abs(v)) / static_cast<double>(history.v.size());
  CHECK(power == Approx(0.5 * 1.042 * D).epsilon(0.06));
}

TEST_CASE("The distribution of the amplitude gives friction and damping within its bias") {
  // Bias of the averaging, up to 8 % of F0, and four standard errors.
  for (const auto& [c, F0] : {std::pair{2.0, 1.0}, std::pair{5.0, 2.0}}) {
    const Estimate e = stochastic_averaging(record_of({random_response(c, F0, D, 800.0, 7)}), bearing_constants);
    REQUIRE(e.outcome.ok());
    CHECK(e.usable);
    CHECK(std::abs(e.value.F0 - F0) < 0.08 * F0 + 4.0 * e.std->F0);
    CHECK(std::abs(e.value.c - c) < 0.15 * c + 4.0 * e.std->c);
    CHECK(e.std->F0 < 0.15 * F0);
    CHECK(further(e, "intensity").value == Approx(D).epsilon(0.03));
  }
}

TEST_CASE("Without recorded velocity the intensity comes from second differences") {
  History history = random_response(5.0, 2.0, D, 400.0, 3);
  const Estimate with = stochastic_averaging(record_of({history}), bearing_constants);
  history.v.clear();
  const Estimate without = stochastic_averaging(record_of({history}), bearing_constants);
  REQUIRE(with.outcome.ok());
  REQUIRE(without.outcome.ok());
  // Means over a sample interval of 2 ms, W T = 0.08: some per cent.
  CHECK(without.value.F0 == Approx(with.value.F0).epsilon(0.05));
}

TEST_CASE("Friction too small to be seen and short records are told") {
  const Estimate faint =
      stochastic_averaging(record_of({random_response(5.0, 0.05, D, 400.0, 5)}), bearing_constants);
  REQUIRE(faint.outcome.ok());
  CHECK((!faint.usable || !faint.warnings.empty()));
  const Estimate brief =
      stochastic_averaging(record_of({random_response(5.0, 1.0, D, 20.0, 5)}), bearing_constants);
  CHECK_FALSE(brief.outcome.ok());
  CHECK(brief.reason.find("400 natural periods") != std::string::npos);
}

TEST_CASE("A record without samples in a natural period has no amplitude") {
  // The motion follows a slow force, as in a test for hysteresis at a fraction of the natural frequency.
  for (const double samples : {0.3, 3.0, 7.5}) {
    CAPTURE(samples);
    History history;
    history.sample_rate = samples * bearing_constants.natural_frequency() / core::two_pi;
    for (int i = 0; i < 4000; ++i) {
      history.force.push_back(3.0 * std::sin(0.01 * i));
      history.x.push_back(history.force.back() / bearing_constants.stiffness);
    }
    const Estimate e = stochastic_averaging(record_of({history}), bearing_constants);
    REQUIRE_FALSE(e.outcome.ok());
    CHECK(e.reason.find("at least 8 samples") != std::string::npos);
  }
}

TEST_CASE("An excitation that is not white must be recorded") {
  sim::Model model = driven_bearing(5.0, 2.0, 0.0);
  model.excitation = {};
  model.excitation.type = sim::ExcitationType::force_noise;
  model.excitation.noise = {.intensity = 0.76, .bandwidth = 100.0 * std::numbers::pi, .seed = 1};
  History history = sampled(model, 400.0, 200.0);
  const Estimate with = stochastic_averaging(record_of({history}), bearing_constants);
  REQUIRE(with.outcome.ok());
  CHECK(with.usable);
  // Bias of the averaging, 3 % of F0 and a fifth of c, and four standard errors.
  CHECK(std::abs(with.value.F0 - 2.0) < 0.06 + 4.0 * with.std->F0);
  CHECK(std::abs(with.value.c - 5.0) < 1.0 + 4.0 * with.std->c);
  history.force.clear();
  const Estimate without = stochastic_averaging(record_of({history}), bearing_constants);
  REQUIRE(without.outcome.ok());
  CHECK_FALSE(without.usable);
  CHECK(without.reason.find("record it") != std::string::npos);
}
