#include "identify/statistics/finer_samples.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/constants.hpp"
#include "core/random.hpp"

using namespace dualdamp;

namespace {

constexpr double first_angle = 0.3;

std::vector<double> sine_of(double samples_in_period, double noise = 0.0) {
  constexpr std::size_t count = 400;
  const core::RandomStream draws{7, 1};
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(std::sin(core::two_pi * static_cast<double>(i) / samples_in_period + first_angle) +
                     noise * draws.normal(i));
  return values;
}

}  // namespace

TEST_CASE("finer drive: the error of a spline is that of the closed form", "[identify][fit]") {
  // y'''' h^4/384 half way between samples, to the leading order of the angle between them.
  for (const double samples : {14.0, 20.0, 50.0}) {
    const double angle = core::two_pi / samples;
    const identify::SplineError error = identify::spline_error(sine_of(samples));
    CHECK(error.miss == Approx(std::pow(angle, 4) / 384.0).epsilon(0.01 + 0.2 * angle * angle));
    CHECK(error.is_resolved());
  }
}

TEST_CASE("finer drive: values between the samples are those of the drive", "[identify][fit]") {
  for (const double samples : {7.0, 10.0, 25.0}) {
    const std::optional<identify::FinerSamples> finer = identify::finer_samples(sine_of(samples));
    REQUIRE(finer);
    CHECK(finer->factor == (samples < 20.0 ? 4 : 2));
    const auto factor = static_cast<std::size_t>(finer->factor);
    REQUIRE(finer->values.size() == 399 * factor + 1);
    const double rate = samples * static_cast<double>(factor);
    double largest = 0.0;
    for (std::size_t i = 6 * factor; i + 6 * factor < finer->values.size(); ++i) {
      const double angle = core::two_pi * static_cast<double>(i) / rate + first_angle;
      largest = std::max(largest, std::abs(finer->values[i] - std::sin(angle)));
    }
    // Half way between samples a polynomial of 12 misses a sine by 924/2^24 of its 12th difference.
    const double difference = std::pow(2.0 * std::sin(std::numbers::pi / samples), 12);
    CHECK(largest < 1.1 * 924.0 / std::pow(2.0, 24) * difference + 1e-14);
  }
}

TEST_CASE("finer drive: both ends are alike", "[identify][fit]") {
  std::vector<double> samples = sine_of(10.0);
  const std::optional<identify::FinerSamples> forward = identify::finer_samples(samples);
  std::ranges::reverse(samples);
  std::optional<identify::FinerSamples> backward = identify::finer_samples(samples);
  REQUIRE((forward && backward));
  std::ranges::reverse(backward->values);
  REQUIRE(forward->values.size() == backward->values.size());
  for (std::size_t i = 0; i < forward->values.size(); ++i)
    CHECK(forward->values[i] == Approx(backward->values[i]).margin(1e-12));
}

TEST_CASE("finer drive: samples that need no others, or do not show what lies between them, stay",
          "[identify][fit]") {
  CHECK(!identify::finer_samples(sine_of(40.0)));
  CHECK(!identify::finer_samples(sine_of(3.0)));
  CHECK(!identify::finer_samples(sine_of(40.0, 0.01)));
  CHECK(!identify::finer_samples(std::vector<double>(100, 2.0)));
  CHECK(!identify::finer_samples({0.0, 1.0, 0.0}));
  std::vector<double> square;
  for (int i = 0; i < 400; ++i) square.push_back(i / 20 % 2 == 0 ? 1.0 : -1.0);
  CHECK(!identify::finer_samples(square));
  CHECK(!identify::spline_error(square).is_resolved());
}
