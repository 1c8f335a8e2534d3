#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "identify/records/plausibility.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using identify::testing::mentions;
using std::numbers::pi;

namespace {

/// Faults of a motion that starts at rest under a force of these tones [Hz], recorded `late` seconds late, with a
/// sign and with a wrong stiffness.
std::string faults_of_tones(const std::vector<double>& tones, double sign, double late, double stiffness = 1.0) {
  const double m = 1.3, c = 3.1, k = 1850.0, rate = 500.0;
  constexpr int finer = 20;
  const auto force = [&](double t) {
    double sum = 0.0;
    for (const double tone : tones) sum += 15.0 * std::sin(2.0 * pi * tone * t + tone);
    return sum;
  };
  History history{.sample_rate = rate};
  double x = 0.0, v = 0.0;
  for (int i = 0; i < 1500 * finer; ++i) {
    const double t = i / (rate * finer);
    if (i % finer == 0) {
      history.x.push_back(x);
      history.force.push_back(sign * force(t - late));
    }
    v += (force(t) - k * x - c * v - 1.1 * std::tanh(v / 1e-3)) / m / (rate * finer);
    x += v / (rate * finer);
  }
  std::string text;
  for (const core::Diagnostic& fault :
       gross_faults({.histories = {history}}, {m, k * stiffness, unknown}, {}, "f.csv"))
    text += core::format(fault) + "\n";
  return text;
}

}  // namespace

TEST_CASE("A force of the wrong sign away from resonance is refused, and a late one is not") {
  // At 4.1 and 7.3 Hz force and motion exchange four times the work that friction takes.
  for (const std::vector<double>& tones : {std::vector{4.1, 7.3}, {4.1}, {8.0}, {6.0}, {5.0, 5.5}}) {
    CAPTURE(tones);
    CHECK(mentions(faults_of_tones(tones, -1.0, 0.0), "one of them has the wrong sign"));
    CHECK(mentions(faults_of_tones(tones, -1.0, 0.0, 1.3), "one of them has the wrong sign"));
    for (const double late : {-0.015, -0.003, 0.0, 0.003, 0.015}) {
      CAPTURE(late);
      CHECK(faults_of_tones(tones, 1.0, late).empty());
    }
    for (const double stiffness : {0.25, 0.6, 0.9, 1.1, 1.6, 4.0}) {
      CAPTURE(stiffness);
      CHECK(faults_of_tones(tones, 1.0, 0.0, stiffness).empty());
    }
  }
}
