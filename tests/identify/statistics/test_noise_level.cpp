#include "identify/statistics/noise_level.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace dualdamp::identify;

namespace {

/// As many values as `count`, which go round `levels` steps of 0.25.
std::vector<double> staircase(int levels, int count) {
  std::vector<double> signal;
  for (int i = 0; i < count; ++i) signal.push_back(0.25 * (i % levels));
  return signal;
}

}  // namespace

TEST_CASE("The noise of a jump, of an alternation and of a smooth curve is that of its differences") {
  std::vector<double> jump(25, 0.0);
  jump[12] = 3.0;
  // The squares of the coefficients add up to the gain: what is left is 9 over the number of differences.
  CHECK(noise_level(jump, 2) == Approx(3.0 / std::sqrt(23.0)).epsilon(1e-12));
  CHECK(noise_level(jump, 4) == Approx(3.0 / std::sqrt(21.0)).epsilon(1e-12));
  CHECK(robust_noise_level(jump) == 0.0);  // most differences are zero, and these are too large beside them

  std::vector<double> alternating, line, cubic;
  for (int i = 0; i < 20; ++i) {
    alternating.push_back(i % 2 == 0 ? 1.0 : -1.0);
    line.push_back(3.0 * i - 7.0);
    cubic.push_back(0.5 * i * i * i - 3.0 * i * i + 2.0);
  }
  CHECK(noise_level(alternating, 2) == Approx(4.0 / std::sqrt(6.0)).epsilon(1e-12));
  CHECK(noise_level(alternating, 4) == Approx(16.0 / std::sqrt(70.0)).epsilon(1e-12));
  CHECK(robust_noise_level(alternating) == Approx(16.0 / std::sqrt(70.0)).epsilon(1e-12));
  CHECK(noise_level(line, 2) == Approx(0.0).margin(1e-12));
  CHECK(noise_level(cubic, 4) == Approx(0.0).margin(1e-10));
  // The fewest samples have one difference.
  CHECK(noise_level(std::vector<double>{0.0, 1.0, 0.0}, 2) == Approx(2.0 / std::sqrt(6.0)).epsilon(1e-12));
  CHECK(noise_level(std::vector<double>{0.0, 1.0}, 2) == 0.0);
  CHECK(noise_level(std::vector<double>{0.0, 0.0, 1.0, 0.0, 0.0}, 4) ==
        Approx(6.0 / std::sqrt(70.0)).epsilon(1e-12));
  CHECK(noise_level(std::vector<double>{0.0, 0.0, 1.0, 0.0}, 4) == 0.0);
}

TEST_CASE("A converter has a step where there are enough levels, and not more than half as many as samples") {
  CHECK(converter_step(staircase(40, 100)) == Approx(0.25).epsilon(1e-12));
  CHECK(converter_step(staircase(50, 100)) == Approx(0.25).epsilon(1e-12));
  CHECK(converter_step(staircase(51, 100)) == 0.0);  // most values differ
  CHECK(converter_step(staircase(32, 100)) == Approx(0.25).epsilon(1e-12));
  CHECK(converter_step(staircase(31, 100)) == 0.0);  // as a drive that switches
  CHECK(converter_step(staircase(31, 100), 31) == Approx(0.25).epsilon(1e-12));
  CHECK(converter_step({}) == 0.0);
  // Of steps that differ the smallest; the last bits of a value are none.
  std::vector<double> uneven = staircase(40, 100);
  for (double& value : uneven)
    if (value > 5.0) value += 3.0;
  uneven.front() += 1e-11;
  CHECK(converter_step(uneven) == Approx(0.25).epsilon(1e-9));
}
