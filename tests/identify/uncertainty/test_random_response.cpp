#include "identify/uncertainty/random_response.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/identify/random_response.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double D = 0.7;
const ForceParameters random_law{1.042, 5.0, 1568.0, 1.0};

double mean_square(const std::vector<double>& signal) {
  double sum = 0.0;
  for (const double value : signal) sum += value * value;
  return sum / static_cast<double>(signal.size());
}

}  // namespace

TEST_CASE("Synthetic records under white acceleration lose m D/2 to friction and are no longer than they need be") {
  const History measured = random_response(random_law.c, random_law.F0, D, 400.0, 1);
  const RandomResponse response{measured, random_law, D};
  // 2,000 periods of 6.17 Hz are 324 s.
  CHECK(response.share() == Approx(324.0 / 400.0).epsilon(0.01));
  double power = 0.0;
  constexpr int records = 4;
  for (int b = 0; b < records; ++b) {
    const Record record = response.record(b);
    REQUIRE(record.histories.size() == 1);
    const History& history = record.histories.front();
    CHECK(history.force.empty());
    for (const double v : history.v)
      power +=
          (random_law.c * v * v + random_law.F0 * std::abs(v)) / static_cast<double>(history.v.size()) / records;
  }
  // Ito's formula for the energy; mean squares over 1,300 s have a deviation of sqrt(2/(zeta W T)), 4 %, and half
  // of it is in the power.
  CHECK(power == Approx(0.5 * random_law.m * D).epsilon(0.08));
}

TEST_CASE("Synthetic records under a recorded drive have its power, and move by their own") {
  sim::Model model = driven_bearing(random_law.c, random_law.F0, 0.0);
  model.excitation = {};
  model.excitation.type = sim::ExcitationType::force_noise;
  model.excitation.noise = {.intensity = 2.0, .bandwidth = 380.0, .seed = 1};
  History measured = sampled(model, 100.0, 200.0);
  measured.v.clear();
  const RandomResponse response{measured, random_law, 2.0};
  CHECK(response.share() == 1.0);
  const History first = response.record(0).histories.front();
  const History second = response.record(1).histories.front();
  CHECK(first.v.empty());
  CHECK(first.force != second.force);
  CHECK(first.x == response.record(0).histories.front().x);
  // 12,000 independent nodes: 1.3 %; twice that for the stretches, which repeat some of them.
  CHECK(mean_square(first.force) == Approx(mean_square(measured.force)).epsilon(0.08));
  // 100 s are 60 correlation times of the amplitude: each mean square has a deviation of 20 %, their ratio one of
  // 28 %; the bound is two of these.
  CHECK(mean_square(first.x) == Approx(mean_square(measured.x)).epsilon(0.6));
}
