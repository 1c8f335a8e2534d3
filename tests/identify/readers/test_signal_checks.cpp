#include "identify/readers/signal_checks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "tests/identify/ledger/rig.hpp"

using namespace dualdamp;
using identify::Clipping;
using identify::clipping_of;
using identify::noisy_clipping_of;

namespace {

constexpr double per_swing = 60.0;

/// A decay of eight swings about zero.
std::vector<double> decay(double per_sample = per_swing) {
  std::vector<double> x;
  for (double swing = 0.0; swing < 8.0; swing += 1.0 / per_sample)
    x.push_back(std::exp(-0.05 * swing) * std::cos(2.0 * std::numbers::pi * swing + 1.0));
  return x;
}

std::vector<double> with_noise(std::vector<double> x, double deviation) {
  const core::RandomStream stream{3, 905};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += deviation * stream.normal(i);
  return x;
}

std::vector<double> clipped(std::vector<double> x, double low, double high) {
  for (double& value : x) value = std::clamp(value, low, high);
  return x;
}

std::vector<double> in_steps(std::vector<double> x, double step) {
  for (double& value : x) value = step > 0.0 ? step * std::round(value / step) : value;
  return x;
}

/// Half swings between -1 and 1, with a rest of `share` of the time at each end, where the mass arrives and leaves
/// without speed.
std::vector<double> sticks(double share, double per_sample = per_swing) {
  std::vector<double> x;
  for (double swing = 0.25; swing < 8.0; swing += 1.0 / per_sample) {
    const double part = std::fmod(swing, 1.0);
    const double sign = std::fmod(swing, 2.0) < 1.0 ? 1.0 : -1.0;
    x.push_back(sign * (part < 1.0 - share ? std::cos(std::numbers::pi * part / (1.0 - share)) : -1.0));
  }
  return x;
}

}  // namespace

TEST_CASE("signal checks: clipping is seen under the noise of what reads the sensor") {
  for (const double noise : {1e-4, 1e-3}) {
    CAPTURE(noise);
    const std::vector<double> x = with_noise(clipped(decay(), -0.8, 0.8), noise);
    CHECK(clipping_of(x).samples == 0);
    CHECK(noisy_clipping_of(x).places > 2);
    CHECK(std::abs(noisy_clipping_of(x).value) == Approx(0.8).margin(5.0 * noise));
  }
  const std::vector<double> once = clipped(decay(), -0.93, 2.0);
  CHECK(noisy_clipping_of(once).places == 1);
}

TEST_CASE("signal checks: tops of smooth, quantised and sticking motion are not clipped") {
  for (const double per_sample : {7.0, 60.0, 1000.0})
    for (const double noise : {0.0, 1e-4, 1e-3, 1e-2, 0.03})
      for (const double step : {0.0, 1e-3, 0.02}) {
        CAPTURE(per_sample, noise, step);
        std::vector<double> x = with_noise(decay(per_sample), noise);
        for (double& value : x) value = step > 0.0 ? step * std::round(value / step) : value;
        CHECK(noisy_clipping_of(x).samples == 0);
      }
  for (const double noise : {1e-4, 1e-3}) CHECK(noisy_clipping_of(with_noise(sticks(0.5), noise)).samples == 0);
}

TEST_CASE(
    "signal checks: without noise a plateau is clipped if the swing arrives with speed, not if the mass sticks") {
  for (const double per_sample : {20.0, 60.0, 1000.0})
    for (const double step : {0.0, 1e-5, 1e-3, 2.0 / 256.0}) {
      CAPTURE(per_sample, step);
      for (const double share : {0.05, 0.2, 0.5, 0.8}) {
        CAPTURE(share);
        constexpr double fewest = 8.0;  // samples of a half swing: of fewer, no parabola shows the speed at its end
        if ((1.0 - share) * per_sample < fewest) continue;
        CHECK(clipping_of(in_steps(sticks(share, per_sample), step)).samples == 0);
      }
      CHECK(clipping_of(in_steps(clipped(decay(per_sample), -0.8, 0.8), step)).places > 2);
      CHECK(clipping_of(in_steps(decay(per_sample), step)).samples == 0);
    }
}

TEST_CASE("signal checks: the velocity tells an imposed stop from clipping") {
  // Ramps between -1 and 1 with a stop at each end; and a decay whose sensor clips, while the velocity goes on.
  std::vector<double> x;
  std::vector<double> v;
  const core::RandomStream stream{5, 1};
  for (std::uint64_t i = 0; i < 800; ++i) {
    const double part = std::fmod(static_cast<double>(i), 100.0) / 100.0;
    const double sign = i / 100 % 2 == 0 ? 1.0 : -1.0;
    x.push_back(sign * std::min(1.0, 4.0 * part - 1.0));
    v.push_back((part < 0.5 ? sign * 4.0 : 0.0) + 0.01 * stream.normal(i));
  }
  REQUIRE(clipping_of(x).samples > 0);
  CHECK(identify::is_still_at(clipping_of(x), v));
  const std::vector<double> moves = decay();
  std::vector<double> speed;
  for (std::size_t i = 0; i < moves.size(); ++i)
    speed.push_back(moves[std::min(i + 1, moves.size() - 1)] - moves[i]);
  for (const double limit : {0.3, 0.6, 0.9}) {
    const Clipping clipping = clipping_of(clipped(moves, -limit, limit));
    REQUIRE(clipping.samples > 0);
    CHECK_FALSE(identify::is_still_at(clipping, speed));
  }
}

namespace {

/// A slow triangular drive of amplitude 1, or one whose ramps end at stops, and the motion that it carries along
/// against a friction of 0.25: the mass stays where the drive turns, and until it has fallen by twice the friction.
struct Carried {
  std::vector<double> drive;
  std::vector<double> x;
};

Carried carried(bool stops) {
  Carried both;
  double x = -0.75;
  constexpr int quarter = 200;
  for (int i = 0; i < 16 * quarter; ++i) {
    const double part = std::fmod(static_cast<double>(i), 4.0 * quarter) / quarter;
    const double ramp = part < 2.0 ? part - 1.0 : 3.0 - part;
    const double force = stops ? std::clamp(1.5 * ramp, -1.0, 1.0) : ramp;
    x = std::clamp(x, force - 0.25, force + 0.25);
    both.drive.push_back(force);
    both.x.push_back(x);
  }
  return both;
}

}  // namespace

TEST_CASE("signal checks: a plateau that begins where the drive stops or turns is a rest of the mass") {
  for (const bool stops : {false, true})
    for (const double noise : {0.0, 1e-3}) {
      CAPTURE(stops, noise);
      const Carried motion = carried(stops);
      const std::vector<double> drive = with_noise(motion.drive, 1e-3);
      const auto left = [&](const std::vector<double>& exact) {
        const std::vector<double> x = with_noise(exact, noise);
        const Clipping found = noise > 0.0 ? noisy_clipping_of(x) : clipping_of(x);
        REQUIRE(found.places > 2);
        return identify::without_sticks(found, x, drive, 2).places;
      };
      CHECK(left(motion.x) == 0);
      CHECK(left(clipped(motion.x, -0.6, 0.6)) > 2);
    }
  // A harmonic drive turns at any phase of the motion.
  const std::vector<double> x = clipped(decay(), -0.8, 0.8);
  const Clipping found = clipping_of(x);
  for (double phase = 0.0; phase < 6.3; phase += 0.1) {
    CAPTURE(phase);
    std::vector<double> drive;
    for (std::size_t i = 0; i < x.size(); ++i)
      drive.push_back(std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / per_swing + phase));
    CHECK(identify::without_sticks(found, x, with_noise(drive, 1e-3), 2).places == found.places);
  }
}

TEST_CASE("signal checks: a mass that turns around shortly before a long stick is not clipped") {
  // Two tones move the base. The mass moves for a tenth of a period between sticks of two thirds of one.
  identify::testing::Rig rig;
  rig.zeta = 0.0381;
  rig.F0 = 7.0775;
  rig.on_base = true;
  const double w = rig.omega();
  const auto drive = [&](double t) {
    return 6.0 * std::sin(0.85823 * w * t + 1.5701) + 4.0 * std::sin(1.81055 * w * t + 3.2007);
  };
  const double period = 2.0 * std::numbers::pi / w;
  const std::vector<double> x = identify::testing::motion_of(rig, drive, 10.0 * period, 92.0 / period).x;
  const auto [low, high] = std::ranges::minmax(x);
  for (const double noise : {1e-5, 8e-5, 4e-4}) {
    CAPTURE(noise);
    CHECK(noisy_clipping_of(with_noise(x, noise * (high - low))).places == 0);
  }
  // Its readings in steps of a converter, and cut off.
  std::vector<double> rounded = x;
  for (double& value : rounded) value = 1e-6 * std::round(value / 1e-6);
  CHECK(clipping_of(rounded).places == 0);
  CHECK(clipping_of(clipped(x, 0.5 * low, 0.5 * high)).places > 1);
}

TEST_CASE("signal checks: long sticks under a slow drive, read in coarse steps, are not clipped") {
  // A stick between sines of the drive ends where the next one exceeds friction: the mass stands for most of the
  // time, and the drive ahead decides how fast it arrives.
  int refused = 0;
  int seen = 0;
  constexpr int records = 40;
  for (int i = 0; i < records; ++i) {
    const core::RandomStream stream{6, static_cast<std::uint32_t>(9010 + i)};
    const auto uniform = [&](std::uint64_t n, double low, double high) {
      return low + (high - low) * stream.uniform(n);
    };
    identify::testing::Rig rig;
    rig.zeta = uniform(0, 0.1, 0.3);
    rig.F0 = uniform(1, 0.5, 3.0) * rig.m;
    const double w = uniform(2, 0.1, 0.6) * rig.omega();
    const double force = uniform(3, 1.1, 1.3) * rig.F0;
    const double third = uniform(4, 0.2, 0.3);
    const auto drive = [=](double t) {
      return force * (std::sin(w * t) + third * std::sin(3.0 * w * t + 1.0)) * std::min(1.0, 0.1 * w * t);
    };
    const double period = 2.0 * std::numbers::pi / w;
    const double rate = uniform(5, 50.0, 400.0) / period;
    const std::vector<double> x = identify::testing::motion_of(rig, drive, 8.0 * period, rate).x;
    const auto [low, high] = std::ranges::minmax(x);
    const double step = uniform(6, 0.0026, 0.003) * (high - low);
    refused += clipping_of(in_steps(x, step)).samples > 0 ? 1 : 0;
    seen += clipping_of(in_steps(clipped(x, 0.7 * low, 0.7 * high), step)).samples > 0 ? 1 : 0;
  }
  CHECK(refused <= 1);
  CHECK(seen >= records - 1);
}

TEST_CASE("a number of the logger among the samples is found by its distance and its repetition") {
  std::vector<double> motion(200);
  for (std::size_t i = 0; i < motion.size(); ++i) motion[i] = 40.0 * std::cos(0.1 * static_cast<double>(i));
  CHECK(identify::placeholders_in(motion).empty());
  std::vector<double> spike = motion;
  spike[50] = 1e4;
  CHECK(identify::placeholders_in(spike).empty());  // a spike, which the methods handle
  std::vector<double> missing = motion;
  missing[50] = missing[120] = -9999.0;
  CHECK(identify::placeholders_in(missing) == std::vector<std::size_t>{50, 120});
  missing[70] = missing[71] = 9.9e37;  // and too much
  CHECK_FALSE(identify::placeholders_in(missing).empty());
  std::vector<double> clipped = motion;
  for (double& x : clipped) x = std::min(x, 30.0);
  CHECK(identify::placeholders_in(clipped).empty());
}
