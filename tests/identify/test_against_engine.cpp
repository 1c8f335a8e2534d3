// From a simulated experiment to an estimate: the methods read what the engine produced.

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "identify/methods/amplitudes/resonance_two_point.hpp"
#include "identify/methods/decays/free_decay.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/curves/curves.hpp"
#include "sim/motion/free_decay.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

/// The paper's bearing with the soft spring, at its undamped resonance.

sim::Model bearing_under(double zeta, double F0) {
  sim::Model model;
  model.oscillator = {mass, stiffness, 2.0 * zeta * std::sqrt(mass * stiffness), sim::DamperTo::ground};
  model.friction.emplace_back(friction::Coulomb(F0, F0));
  return model;
}

Record measure(const sim::Model& bearing, double frequency, const std::vector<double>& levels) {
  sim::Model model = bearing;
  model.excitation.type = sim::ExcitationType::base_harmonic;
  model.excitation.frequency = frequency;
  std::vector<std::pair<double, double>> list;
  for (const sim::CurvePoint& point : sim::xy_curve(model, levels).points) {
    REQUIRE(point.ok());
    list.emplace_back(point.Y, point.x);
  }
  return identify::testing::pairs(list);
}

}  // namespace

TEST_CASE("A simulated resonance test returns its friction") {
  const double zeta = 0.12, F0 = 3.7;
  const double x_f = F0 / stiffness;
  const Record record =
      measure(bearing_under(zeta, F0), natural, {2.0 * x_f, 2.3 * x_f, 2.6 * x_f, 2.9 * x_f, 3.2 * x_f});
  const KnownConstants constants{mass, stiffness, natural};
  // What is left is the method's own error, the neglect of H: below 1 % at r = 1, and known in advance from Eq (3).
  for (const auto& method : {resonance_least_squares_method, resonance_two_point_method}) {
    const Estimate e = method.run(record, constants);
    REQUIRE(e.outcome.ok());
    CHECK(e.usable);
    CHECK(e.warnings.empty());
    CHECK(e.value.zeta == Approx(zeta).epsilon(3e-3));
    CHECK(e.value.F0 == Approx(F0).epsilon(1e-2));
  }
}

TEST_CASE("The foot of a simulated stick-slip curve is found and left out") {
  const double zeta = 0.142, F0 = 3.69;
  const double x_f = F0 / stiffness;
  const sim::analytic::DenHartog d = sim::analytic::den_hartog(zeta, 1.0);
  const double boundary = x_f / sim::analytic::non_sticking_boundary(d);  // of the input, 1.588 x_f
  std::vector<double> levels = {1.30 * x_f, 1.42 * x_f, 1.54 * x_f};      // below it
  for (int i = 0; i < 6; ++i) levels.push_back(boundary * (1.02 + 0.12 * i));
  const Record record = measure(bearing_under(zeta, F0), natural, levels);
  const Estimate e = resonance_least_squares(record, {mass, stiffness, natural}, {});
  REQUIRE(e.outcome.ok());
  REQUIRE(e.excluded.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(e.excluded[i].number == static_cast<int>(i) + 1);
  CHECK(e.value.zeta == Approx(zeta).epsilon(1e-2));
  CHECK(e.value.F0 == Approx(F0).epsilon(1e-2));
  // With the foot in, the line would be flatter: that is what the gate is for.
  double n = 0.0, mean_Y = 0.0, mean_x = 0.0, S_YY = 0.0, S_xY = 0.0;
  for (const Pair& pair : record.pairs->pairs) {
    n += 1.0;
    const double dY = pair.Y - mean_Y;
    mean_Y += dY / n;
    mean_x += (pair.x - mean_x) / n;
    S_YY += dY * (pair.Y - mean_Y);
    S_xY += dY * (pair.x - mean_x);
  }
  CHECK(0.5 * S_YY / S_xY > 1.015 * zeta);
}

TEST_CASE("A simulated free decay returns its friction to rounding") {
  const double zeta = 0.0819, F0 = 3.52;
  sim::Model model = bearing_under(zeta, F0);
  model.initial.position = 40e-3;
  const sim::FreeDecay motion = sim::free_decay(model, 6);
  DecayRecord record;
  for (const sim::Extreme& extreme : motion.extremes) {
    record.extremes.push_back(extreme.x + 0.4e-3);  // the sensor is off
    record.times.push_back(extreme.t);
  }
  REQUIRE(record.extremes.size() >= 5);
  const Estimate e = free_decay({std::nullopt, record}, {mass, stiffness, 0.0}, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.warnings.empty());
  CHECK(e.value.zeta == Approx(zeta).epsilon(1e-11));
  CHECK(e.value.F0 == Approx(F0).epsilon(1e-11));
  CHECK(e.decay->offset == Approx(0.4e-3).epsilon(1e-10));
}
