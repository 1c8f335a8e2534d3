#include "identify/records/faults/drive_gain.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "identify/records/plausibility.hpp"
#include "tests/identify/histories.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using identify::testing::mentions;

namespace {

/// A transient near resonance, whose readings of the drive are off by a factor.
History misread(double gain, bool as_force) {
  identify::testing::Normal normal(5);
  History history = identify::testing::displacement_only(
      identify::testing::sampled(identify::testing::driven_bearing(2.0, 1.5, 2e-3, 36.0), 5.0, 500.0), 1e-5,
      normal);
  for (double& y : history.y) y = gain * (y + 5e-6 * normal());
  if (!as_force) return history;
  for (const double y : history.y) history.force.push_back(identify::testing::bearing_constants.stiffness * y);
  history.y.clear();
  return history;
}

std::string drive_faults(double gain, bool as_force) {
  std::string text;
  const Record record{.histories = {misread(gain, as_force)}};
  for (const core::Diagnostic& fault : gross_faults(record, identify::testing::bearing_constants, {}, "data.csv"))
    text += core::format(fault) + "\n";
  return text;
}

/// From rest, under a drive that friction of nearly its size holds most of the time.
History nearly_stuck(double share, double omega, bool as_force) {
  identify::testing::Normal normal(5);
  constexpr double Y = 2e-3;
  const double stiffness = identify::testing::bearing_constants.stiffness;
  sim::Model model = identify::testing::driven_bearing(8.0, share * stiffness * Y, Y, omega);
  model.excitation.phase = 0.0;
  model.initial = {0.0, 0.0};
  History history = identify::testing::sampled(model, 5.0, 278.0);
  double square = 0.0;
  for (const double x : history.x) square += x * x;
  const double noise = 0.003 * std::sqrt(square / static_cast<double>(history.x.size()));
  history = identify::testing::displacement_only(std::move(history), noise, normal);
  for (double& y : history.y) y += 0.002 * Y * normal();
  if (!as_force) return history;
  for (const double y : history.y) history.force.push_back(stiffness * y);
  history.y.clear();
  return history;
}

}  // namespace

TEST_CASE("Friction that holds a nearly stuck mass is no gain of the drive") {
  for (const double share : {0.7, 0.8, 0.9}) {
    for (const double ratio : {0.76, 0.84, 0.92, 1.0, 1.08, 1.16}) {
      for (const bool as_force : {false, true}) {
        CAPTURE(share, ratio, as_force);
        const double omega = ratio * identify::testing::bearing_constants.natural_frequency();
        CHECK_FALSE(gain_of_drive(nearly_stuck(share, omega, as_force), identify::testing::bearing_constants));
      }
    }
  }
}

TEST_CASE("The balance of forces tells the gain of the drive") {
  for (const double gain : {10.0, 1000.0, 0.1}) {
    for (const bool as_force : {false, true}) {
      CAPTURE(gain, as_force);
      const std::optional<double> found =
          gain_of_drive(misread(gain, as_force), identify::testing::bearing_constants);
      REQUIRE(found);
      CHECK(*found == Approx(gain).epsilon(0.02));
    }
  }
  CHECK_FALSE(gain_of_drive(misread(1.0, true), identify::testing::bearing_constants));
  CHECK_FALSE(gain_of_drive(misread(1.03, true), identify::testing::bearing_constants));
}

TEST_CASE("A drive that is read too large is refused with its factor") {
  for (const bool as_force : {false, true}) {
    CAPTURE(as_force);
    CHECK(drive_faults(1.0, as_force).empty());
    CHECK(drive_faults(1.03, as_force).empty());
    for (const double gain : {10.0, 1000.0}) {
      CAPTURE(gain);
      const std::string text = drive_faults(gain, as_force);
      CHECK(mentions(text, "times too large for the motion x of the stated mass and stiffness"));
      CHECK(mentions(text, as_force ? "column force is about " : "column y is about "));
    }
  }
}
