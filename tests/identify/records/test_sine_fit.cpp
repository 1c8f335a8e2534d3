#include "identify/records/sine_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;

namespace {

constexpr double wave_sample_rate = 1000.0;

/// offset + sum A_k cos(k w t + phi_k)
std::vector<double> wave(std::size_t samples, double omega, double offset, const std::vector<Harmonic>& harmonics) {
  std::vector<double> signal(samples, offset);
  for (std::size_t i = 0; i < samples; ++i)
    for (std::size_t k = 0; k < harmonics.size(); ++k)
      signal[i] += harmonics[k].amplitude *
                   std::cos(static_cast<double>(k + 1) * omega * static_cast<double>(i) / wave_sample_rate +
                            harmonics[k].phase);
  return signal;
}

const std::vector<Harmonic> distorted = {{2.0, 0.7}, {0.01, -3.0}, {0.3, 2.5}};

}  // namespace

TEST_CASE("A signal of the model is returned, in a record of any length") {
  // 1.07 to 60 periods; the shortest leaves the normal equations with a condition of about 1e3.
  for (const std::size_t samples : {175, 200, 1000, 9999}) {
    CAPTURE(samples);
    const SineFit fit = fit_sine(wave(samples, 38.79, 5.0, distorted), wave_sample_rate, 38.79, {.harmonics = 3});
    REQUIRE(fit.outcome.ok());
    CHECK(fit.offset == Approx(5.0).epsilon(1e-11));
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(fit.harmonics[k].amplitude == Approx(distorted[k].amplitude).margin(2e-11));
      CHECK(fit.harmonics[k].phase == Approx(distorted[k].phase).margin(1e-9));
    }
    CHECK(fit.noise < 1e-11);
  }
}

TEST_CASE("A frequency is refined from a guess half a period off over the record") {
  const std::vector<double> signal = wave(5000, 38.79, 5.0, distorted);
  for (const double error : {-0.5, -0.1, 0.0, 0.3, 0.5}) {
    const double guess = 38.79 + error * 2.0 * std::numbers::pi / 5.0;
    const SineFit fit = fit_sine(signal, wave_sample_rate, guess, {.harmonics = 3, .refine = true});
    REQUIRE(fit.outcome.ok());
    CHECK(fit.omega == Approx(38.79).epsilon(1e-12));
    CHECK(fit.harmonics[2].phase == Approx(2.5).margin(1e-9));
  }
  // Crossings are counted over 30.9 periods: interpolation errs by less than a hundredth of a sample in 162.
  CHECK(guess_frequency(signal, wave_sample_rate) == Approx(38.79).epsilon(1e-4));
}

TEST_CASE("Standard errors against the closed form and against 400 noisy records") {
  constexpr std::size_t samples = 1620;  // ten periods within 0.01 %
  constexpr double sigma = 0.1;
  const std::vector<double> clean = wave(samples, 38.79, 5.0, {{2.0, 0.7}});
  testing::Normal normal(7);
  testing::Cloud cloud;
  testing::Cloud frequencies;
  SineFit fit;
  double noise = 0.0;
  constexpr int records = 400;
  for (int i = 0; i < records; ++i) {
    std::vector<double> signal = clean;
    for (double& value : signal) value += sigma * normal();
    fit = fit_sine(signal, wave_sample_rate, 38.7, {.refine = true});
    cloud.add(fit.harmonics[0].amplitude, fit.harmonics[0].phase);
    frequencies.add(fit.omega, fit.noise);
    noise += fit.noise / records;
    // Residuals without correlation: that of two neighbours is below 4/sqrt(n) but once in 16,000 records.
    CHECK(std::abs(fit.correlation) < 4.0 / std::sqrt(samples));
  }
  constexpr double n = samples;
  CHECK(fit.harmonics[0].amplitude_std == Approx(fit.noise * std::sqrt(2.0 / n)).epsilon(0.01));
  CHECK(fit.omega_std == Approx(fit.noise / 2.0 * std::sqrt(24.0 / (n * n * n)) * wave_sample_rate).epsilon(0.01));
  // The phase at the first sample: that in the middle and half a record of the frequency's error, 1 + 3 times the
  // variance.
  const double phase_std = sigma / 2.0 * std::sqrt(8.0 / n);
  // A standard deviation of 400 values is itself known to 1/sqrt(800) = 3.5 %: 14 % is four of these.
  CHECK(std::sqrt(cloud.var_a()) == Approx(fit.harmonics[0].amplitude_std).epsilon(0.14));
  CHECK(std::sqrt(cloud.var_b()) == Approx(phase_std).epsilon(0.14));
  CHECK(std::sqrt(frequencies.var_a()) == Approx(fit.omega_std).epsilon(0.14));
  CHECK(noise == Approx(sigma).epsilon(0.01));
  CHECK(cloud.mean_a == Approx(2.0).margin(4.0 * fit.harmonics[0].amplitude_std / std::sqrt(records)));
  CHECK(cloud.mean_b == Approx(0.7).margin(4.0 * phase_std / std::sqrt(records)));
}

TEST_CASE("What a fit leaves over is correlated when the model lacks a harmonic") {
  const SineFit fit = fit_sine(wave(5000, 38.79, 0.0, distorted), wave_sample_rate, 38.79);
  CHECK(fit.correlation > 0.9);
  // Over many periods the missing harmonics are the noise: sqrt((0.3^2 + 0.01^2)/2).
  CHECK(fit.noise == Approx(0.2122).epsilon(0.01));
}

TEST_CASE("Peak to peak and mean square speed of the fitted waveform") {
  // cos t + b cos 3t + phases: by brute force over a million points, whose curvature leaves 5e-12.
  for (const double third : {0.0, 0.1, 0.3, 0.9}) {
    const std::vector<Harmonic> harmonics = {{1.0, 0.4}, {0.0, 0.0}, {third, 1.9}};
    const std::vector<double> signal = wave(6000, 10.0, 2.0, harmonics);
    const SineFit fit = fit_sine(signal, wave_sample_rate, 10.0, {.harmonics = 3});
    REQUIRE(fit.outcome.ok());
    double low = 1e9;
    double high = -1e9;
    constexpr int points = 1'000'000;
    for (int i = 0; i < points; ++i) {
      const double t = 2.0 * std::numbers::pi * i / points;
      const double value = std::cos(t + 0.4) + third * std::cos(3.0 * t + 1.9);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    CHECK(half_peak_to_peak(fit) == Approx(0.5 * (high - low)).epsilon(1e-9));
    CHECK(mean_square_derivative(fit) == Approx(0.5 * (100.0 + 900.0 * third * third)).epsilon(1e-9));
  }
}

TEST_CASE("Records that allow no fit") {
  const std::vector<double> signal = wave(1000, 38.79, 0.0, distorted);
  CHECK(fit_sine(std::span(signal).first(150), wave_sample_rate, 38.79).outcome.reason ==
        "the record is shorter than one period");
  CHECK(fit_sine(std::span(signal).first(4), wave_sample_rate, 3000.0).outcome.reason ==
        "there are fewer samples than unknowns");
  CHECK_FALSE(fit_sine(signal, wave_sample_rate, 1600.0, {.harmonics = 2}).outcome.ok());
  CHECK_FALSE(fit_sine(signal, wave_sample_rate, unknown).outcome.ok());
  const std::vector<double> flat(1000, 3.0);
  CHECK_FALSE(fit_sine(flat, wave_sample_rate, 38.79, {.refine = true}).outcome.ok());
  CHECK(std::isnan(guess_frequency(flat, wave_sample_rate)));
  CHECK(std::isnan(guess_frequency({}, wave_sample_rate)));
}
