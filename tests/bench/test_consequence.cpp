// Which readings count in distance, harm and bounds, and with what deviation.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/bench/campaign.hpp"

using namespace dualdamp;
using bench::Consequence;

namespace {

/// Of a spring that softens, read by these sensors.
Consequence consequence_with(const std::string& sensors, const std::string& severity = "0.02") {
  constexpr std::size_t softening = 1;  // the truth comes first
  const std::string rig =
      "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 1600, damping: 4, friction: {law: coulomb, kinetic: 1}}\n"
      "excitation: {type: base_harmonic, frequency: natural}\n"
      "analysis: {type: stress_test, laws: [softening_spring], severities: [" +
      severity +
      "], methods: [resonance_two_point],\n"
      "  ranges: [{name: one, amplitudes: [4 mm, 5 mm]}], sensors: [{name: set, ";
  return bench::testing::Campaign(rig + sensors + "}]}\n").consequence(softening);
}

void check_equal(const Consequence& a, const Consequence& b) {
  CHECK(a.distance == Approx(b.distance).epsilon(1e-9));
  CHECK(a.harm() == Approx(b.harm()).epsilon(1e-9));
  CHECK(a.attainable_power == Approx(b.attainable_power).epsilon(1e-9));
  CHECK(a.cramer_rao_zeta == Approx(b.cramer_rao_zeta).epsilon(1e-9));
  CHECK(a.cramer_rao_F0 == Approx(b.cramer_rao_F0).epsilon(1e-9));
}

}  // namespace

TEST_CASE("consequence: a step of a reading counts as noise, of a deviation of the step over the root of 12") {
  // 34.641 um are 10 um times the root of 12; 6 um and 8 um add up to 10 um.
  const Consequence noise = consequence_with("x: {noise: 10 um}");
  CHECK(noise.distance > 1.0);
  check_equal(consequence_with("x: {resolution: 34.64101615137755 um}"), noise);
  check_equal(consequence_with("x: {noise: 6 um, resolution: 27.71281292110204 um}"), noise);
  const Consequence sampled = consequence_with("sample_rate: 200 Hz, x: {noise: 10 um}");
  CHECK(sampled.distance > 1.0);
  check_equal(consequence_with("sample_rate: 200 Hz, x: {resolution: 34.64101615137755 um}"), sampled);
  check_equal(consequence_with("sample_rate: 200 Hz, x: {noise: 10 um}, v: {resolution: 3.464101615137755 mm/s}"),
              consequence_with("sample_rate: 200 Hz, x: {noise: 10 um}, v: {noise: 1 mm/s}"));
}

TEST_CASE("consequence: without noise there is no distance, and harm that of equal weights") {
  const Consequence perfect = consequence_with("sample_rate: 200 Hz");
  CHECK(std::isnan(perfect.distance));
  CHECK(std::isnan(perfect.attainable_power));
  CHECK(std::isnan(perfect.cramer_rao_zeta));
  // All samples of x have one deviation: which one does not move the nearest motion.
  const Consequence noisy = consequence_with("sample_rate: 200 Hz, x: {noise: 10 um}");
  CHECK(perfect.harm_zeta == Approx(noisy.harm_zeta).epsilon(1e-6));
  CHECK(perfect.harm_F0 == Approx(noisy.harm_F0).epsilon(1e-6));
  CHECK(std::isfinite(consequence_with("").harm()));
}

TEST_CASE("consequence: the nearest motion of an extreme departure is found, without friction if need be") {
  // By a search over a grid of c and F0: 1.53 c, F0 below a hundredth, 7135 deviations. Steps cut off at a factor e
  // ended at F0/e, 7299 deviations away.
  const Consequence extreme = consequence_with("sample_rate: 200 Hz, x: {noise: 10 um}", "0.1");
  CHECK(extreme.distance < 7136.0);
  CHECK(extreme.distance > 7100.0);
  CHECK(extreme.harm_zeta == Approx(0.53).margin(0.03));
  CHECK(extreme.harm_F0 < -0.99);
}
