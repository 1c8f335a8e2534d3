#include "identify/records/spikes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr double decay_sample_rate = 200.0;

/// A decay that ends in noise, with that share of its first amplitude as noise.
std::vector<double> decay(double noise, std::uint64_t seed) {
  const core::RandomStream stream{seed, 0};
  std::vector<double> signal;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double t = static_cast<double>(i) / decay_sample_rate;
    signal.push_back(std::exp(-t) * std::cos(30.0 * t) + noise * stream.normal(i));
  }
  return signal;
}

}  // namespace

TEST_CASE("A spike of one sample is found and replaced") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    History history;
    history.sample_rate = decay_sample_rate;
    history.x = decay(0.001, seed);
    const std::vector<double> clean = history.x;
    history.x[3] += 0.3;
    history.x[700] -= 0.05;
    history.x[1997] += 0.02;
    std::vector<History> histories = {history};
    CHECK(treat_spikes(histories, false).size() == 1);
    CHECK(histories[0].x == history.x);
    const std::vector<std::string> said = treat_spikes(histories, true);
    REQUIRE(said.size() == 1);
    CHECK(said[0].starts_with("x holds 3 spikes, the first at t = 0.015 s"));
    for (const std::size_t i : {3U, 700U, 1997U}) CHECK(std::abs(histories[0].x[i] - clean[i]) < 0.01);
    CHECK(histories[0].x[4] == clean[4]);
  }
}

TEST_CASE("Reversals of friction are no spikes, though nothing hides them") {
  for (const double rate_of_samples : {20.0, 50.0, 200.0, 1000.0}) {
    // Half swings about a middle that friction shifts to and fro, at 1 Hz.
    std::vector<double> x;
    std::vector<double> v;
    const double w = 2.0 * std::acos(-1.0);
    constexpr double x_f = 0.02;
    double amplitude = 1.0;
    for (int half = 0; half < 20; ++half, amplitude -= 2.0 * x_f) {
      const double side = half % 2 == 0 ? 1.0 : -1.0;
      for (int i = 0; i < static_cast<int>(rate_of_samples / 2.0); ++i) {
        const double t = i / rate_of_samples;
        x.push_back(side * (x_f + (amplitude - x_f) * std::cos(w * t)));
        v.push_back(-side * w * (amplitude - x_f) * std::sin(w * t));
      }
    }
    CAPTURE(rate_of_samples);
    CHECK(spikes_of(x).empty());
    CHECK(spikes_of(v).empty());
  }
}

TEST_CASE("The start and the end of a blow are no spikes") {
  constexpr double rate = 2000.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double length : {0.004, 0.008, 0.02}) {
      const core::RandomStream stream{seed, 1};
      const double begin = 0.2 + 1e-4 * static_cast<double>(seed % 5);  // also between two samples
      std::vector<double> force;
      for (std::uint64_t i = 0; i < 2000; ++i) {
        const double share = (static_cast<double>(i) / rate - begin) / length;
        const bool strikes = share > 0.0 && share < 1.0;
        force.push_back((strikes ? 160.0 * std::sin(std::acos(-1.0) * share) : 0.0) + 0.2 * stream.normal(i));
      }
      CAPTURE(seed, length);
      CHECK(spikes_of(force).empty());
      force[1000] += 20.0;
      CHECK(spikes_of(force).size() == 1);
    }
}

TEST_CASE("A step is no spike wherever the record begins or ends") {
  // The acceleration of half swings: it steps where friction changes its sign, at each turn.
  for (const double noise : {0.0, 1e-3}) {
    const core::RandomStream stream{7, 3};
    std::vector<double> a;
    for (std::uint64_t i = 0; i < 800; ++i) {
      const double place = static_cast<double>(i) * std::acos(-1.0) / 100.3;
      const double side = std::sin(place) > 0.0 ? 1.0 : -1.0;
      a.push_back((1.0 - 1e-3 * static_cast<double>(i)) * std::cos(place) + 0.1 * side + noise * stream.normal(i));
    }
    for (std::ptrdiff_t cut = 0; cut < 400; ++cut) {
      CAPTURE(noise, cut);
      CHECK(spikes_of({a.begin(), a.end() - cut}).empty());
      CHECK(spikes_of({a.begin() + cut, a.end()}).empty());
      // A spike beside the end is still one.
      std::vector<double> spoilt(a.begin(), a.begin() + 400 + cut);
      spoilt[spoilt.size() - 3] += 2.0;
      CHECK(spikes_of(spoilt).size() == 1);
    }
  }
}

TEST_CASE("Noise, steps, peaks and rounding are no spikes") {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    CHECK(spikes_of(decay(0.001, seed)).empty());
    CHECK(spikes_of(decay(0.0, seed)).empty());
    std::vector<double> rounded = decay(0.0, seed);
    for (double& value : rounded) value = 0.01 * std::round(value / 0.01);
    CHECK(spikes_of(rounded).empty());
    std::vector<double> stepped = decay(0.001, seed);
    for (std::size_t i = 0; i < stepped.size(); ++i) stepped[i] += (i / 40) % 2 == 0 ? 1.0 : -1.0;
    CHECK(spikes_of(stepped).empty());
    std::vector<double> coarse;
    for (int i = 0; i < 400; ++i) coarse.push_back(std::sin(0.9 * i + static_cast<double>(seed)));
    CHECK(spikes_of(coarse).empty());
  }
}
