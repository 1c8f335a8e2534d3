#include "identify/records/sensor_zero.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/analytic/free_decay.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr double decay_zeta = 0.04;
constexpr double decay_x_f = 1.5e-3;
constexpr double release = 40e-3;

DecayRecord decay_with(double zero) {
  DecayRecord decay;
  decay.extremes = sim::analytic::free_decay_extremes(decay_zeta, decay_x_f, release, 20);
  for (double& extreme : decay.extremes) extreme += zero;
  return decay;
}

History driven_cosine(double amplitude, double mean, double force = 0.0) {
  History history;
  history.sample_rate = 100.0;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * std::numbers::pi * 0.02 * i;
    history.x.push_back(5.0 * amplitude * std::cos(angle - 1.0) + mean);
    (force > 0.0 ? history.force : history.y).push_back((force > 0.0 ? force : amplitude) * std::cos(angle));
  }
  return history;
}

}  // namespace

TEST_CASE("What friction may do is left, what it cannot is taken for the sensor's zero") {
  for (const double zero : {-0.5, -20e-3, 20e-3, 0.5}) {
    DecayRecord decay = decay_with(zero);
    History history;
    history.x = decay.extremes;
    CAPTURE(zero);
    CHECK_FALSE(remove_zero(history, decay).empty());
    // The middle of three extremes is off by a quarter of their second difference, below x_f.
    for (std::size_t i = 0; i < decay.extremes.size(); ++i) {
      CHECK(decay.extremes[i] == Approx(decay_with(0.0).extremes[i]).margin(decay_x_f));
      CHECK(history.x[i] == decay.extremes[i]);
    }
  }
  // Friction of another size in each direction moves the middle by less than x_f.
  for (const double zero : {-decay_x_f, 0.0, 0.9 * decay_x_f}) {
    DecayRecord decay = decay_with(zero);
    History history;
    history.x = decay.extremes;
    CHECK(remove_zero(history, decay).empty());
    CHECK(decay.extremes == decay_with(zero).extremes);
  }
}

TEST_CASE("The zero of a driven motion beside the drive's own") {
  constexpr double Y = 1e-3;
  constexpr double stiffness = 900.0;
  History base = driven_cosine(Y, 0.25);
  CHECK_FALSE(remove_zero(base, unknown).empty());
  for (std::size_t i = 0; i < base.x.size(); ++i)
    CHECK(base.x[i] == Approx(driven_cosine(Y, 0.0).x[i]).margin(1e-9));
  // The base itself is far off: the spring is not.
  History both = driven_cosine(Y, 0.25);
  for (double& y : both.y) y += 0.25;
  CHECK(remove_zero(both, unknown).empty());
  // Within the motion, and where nothing tells the equilibrium.
  History near = driven_cosine(Y, 4e-3);
  CHECK(remove_zero(near, unknown).empty());
  History forced = driven_cosine(Y, 0.25, 1.0);
  CHECK(remove_zero(forced, unknown).empty());
  CHECK(remove_zero(forced, 0.0).empty());
  CHECK_FALSE(remove_zero(forced, stiffness).empty());
}
