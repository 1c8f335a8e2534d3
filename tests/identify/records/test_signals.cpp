#include "identify/records/usable_histories.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/identify/histories.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
using std::numbers::pi;

namespace {

constexpr double sine_sample_rate = 1000.0;

std::vector<double> sine(double omega, std::size_t count) {
  std::vector<double> signal(count);
  for (std::size_t i = 0; i < count; ++i) signal[i] = std::sin(omega * static_cast<double>(i) / sine_sample_rate);
  return signal;
}

/// In-phase and quadrature amplitude over whole periods in the middle.
std::pair<double, double> response(const std::vector<double>& signal, double omega) {
  const auto period = static_cast<std::size_t>(std::lround(2.0 * pi * sine_sample_rate / omega));
  const std::size_t first = signal.size() / 4;
  double in_phase = 0.0;
  double quadrature = 0.0;
  for (std::size_t i = first; i < first + 4 * period; ++i) {
    const double angle = omega * static_cast<double>(i) / sine_sample_rate;
    in_phase += signal[i] * std::sin(angle);
    quadrature += signal[i] * std::cos(angle);
  }
  return {in_phase / (2.0 * static_cast<double>(period)), quadrature / (2.0 * static_cast<double>(period))};
}

}  // namespace

TEST_CASE("The zero-phase filter has Butterworth's gain squared and no lag") {
  const double cutoff = 50.0;
  const ZeroPhaseFilter filter(cutoff, sine_sample_rate);
  for (const double frequency : {5.0, 25.0, 50.0, 125.0, 250.0}) {
    const double omega = 2.0 * pi * frequency;
    const auto [gain, lag] = response(filter(sine(omega, 4000)), omega);
    // |H|^2 of the bilinear transform, twice: once forwards and once backwards.
    const double ratio = std::tan(pi * frequency / sine_sample_rate) / std::tan(pi * cutoff / sine_sample_rate);
    CHECK(gain == Approx(1.0 / (1.0 + std::pow(ratio, 4.0))).margin(1e-9));
    CHECK(lag == Approx(0.0).margin(1e-9));
  }
  // A ramp is continued by its reflection, so that it passes unchanged up to the ends.
  std::vector<double> ramp(400);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = 3.0 + 0.1 * static_cast<double>(i);
  const std::vector<double> passed = filter(ramp);
  for (std::size_t i = 0; i < ramp.size(); ++i) CHECK(passed[i] == Approx(ramp[i]).margin(1e-3));
  for (std::size_t i = filter.edge(); i + filter.edge() < ramp.size(); ++i)
    CHECK(passed[i] == Approx(ramp[i]).epsilon(1e-5));
}

TEST_CASE("The five-point average after a central difference has the gain of the paper's velocity") {
  const double omega = 2.0 * pi * 6.25;
  const double angle = omega / sine_sample_rate;
  const double expected = (1.0 + 2.0 * std::cos(angle) + 2.0 * std::cos(2.0 * angle)) / 5.0;
  CHECK(expected == Approx(0.998).margin(5e-4));  // the paper's, at 6.2 Hz and 1 kHz
  const auto [gain, lag] = response(five_point_average(sine(omega, 4000)), omega);
  CHECK(gain == Approx(expected).epsilon(1e-12));
  CHECK(lag == Approx(0.0).margin(1e-12));
  const auto [in_phase, speed] = response(central_difference(sine(omega, 4000), sine_sample_rate), omega);
  CHECK(speed == Approx(omega * std::sin(omega / sine_sample_rate) / (omega / sine_sample_rate)).epsilon(1e-12));
  CHECK(in_phase == Approx(0.0).margin(1e-9));
}

TEST_CASE("Differences are exact for parabolas, ends included") {
  std::vector<double> x(20);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double t = static_cast<double>(i) / sine_sample_rate;
    x[i] = 0.5 - 2.0 * t + 3.0 * t * t;
  }
  const std::vector<double> v = central_difference(x, sine_sample_rate);
  const std::vector<double> a = second_difference(x, sine_sample_rate);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(v[i] == Approx(-2.0 + 6.0 * static_cast<double>(i) / sine_sample_rate).epsilon(1e-10));
    CHECK(a[i] == Approx(6.0).epsilon(1e-6));  // rounding of x times the rate squared
  }
}

TEST_CASE("Unsound histories say what is wrong") {
  History history;
  CHECK(fault_of(history) == "the sample rate is not positive");
  history.sample_rate = sine_sample_rate;
  CHECK(fault_of(history).starts_with("the displacement x was not recorded: record it"));
  CHECK(fault_of(history).ends_with("'dualdamp fit coulomb' takes v or a alone"));
  history.x = sine(10.0, 10);
  CHECK(fault_of(history) == "there are fewer than 16 samples");
  history.x = sine(10.0, 100);
  CHECK(fault_of(history).empty());
  history.y = sine(10.0, 99);
  CHECK(fault_of(history) == "the signals are of different length");
  history.y = sine(10.0, 100);
  history.y[7] = unknown;
  CHECK(fault_of(history) == "a sample is not finite");
  history.y.clear();
  CHECK(fault_of_cutoff(history, 0.0).empty());
  CHECK_FALSE(fault_of_cutoff(history, -1.0).empty());
  CHECK_FALSE(fault_of_cutoff(history, 460.0).empty());
  CHECK(fault_of_cutoff(history, 5.0) ==
        "the record is too short for its filter: it has 100 samples, and a cut-off frequency of 5 Hz needs 1264");
}
