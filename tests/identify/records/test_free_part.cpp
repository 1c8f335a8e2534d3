#include "identify/records/free_part.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/identify/histories.hpp"
#include "tests/identify/records/bearing_records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double X = 60e-3;
constexpr double rate = 500.0;

sim::Model lightly_damped(double position, double velocity) {
  sim::Model model = soft_bearing();
  model.oscillator.damping = 2.0 * 0.03 * std::sqrt(mass * stiffness);
  model.initial = {position, velocity};
  return model;
}

/// Samples of the free motion after `held` samples at its first position.
History after_hold(const sim::Model& model, std::size_t held, double samples_a_second = rate,
                   double duration = 2.0) {
  History history = sampled(model, duration, samples_a_second);
  history.y.clear();
  history.x.insert(history.x.begin(), held, history.x[0]);
  history.v.insert(history.v.begin(), held, 0.0);
  history.a.insert(history.a.begin(), held, 0.0);
  return history;
}

void make_noisy(History& history, double share, std::uint64_t seed) {
  Normal normal(seed);
  const std::vector<std::pair<std::vector<double>*, double>> sizes = {
      {&history.x, X}, {&history.v, X * natural}, {&history.a, X * natural * natural}};
  for (const auto& [signal, size] : sizes)
    for (double& value : *signal) value += share * size * normal();
}

}  // namespace

TEST_CASE("A mass that is held before its release moves freely from the release on") {
  const double half_swing = M_PI / natural * rate;
  for (const double length : {0.7, 3.0, 20.0})
    for (const double share : {1e-6, 2e-3, 0.02}) {
      const auto held = static_cast<std::size_t>(length * half_swing);
      History history = after_hold(lightly_damped(X, 0.0), held);
      make_noisy(history, share, 3);
      CAPTURE(length, share);
      const FreePart part = free_part(history);
      CHECK(part.fault.empty());
      // It leaves the band of the noise within a third of a half swing.
      CHECK(part.first >= held);
      CHECK(part.first < held + static_cast<std::size_t>(0.35 * half_swing));
      History cut = history;
      const std::string warning = leave_out_hold(cut);
      CHECK(warning.find("the free motion lasts from t = ") == 0);
      CHECK(cut.x.size() == history.x.size() - part.first);
      CHECK(cut.a.size() == cut.x.size());
      CHECK(cut.x.back() == history.x.back());  // the rest at the end is data
      CHECK(cut.start == Approx(history.start + static_cast<double>(part.first) / rate));
      CHECK(leave_out_hold(cut).empty());
    }
}

TEST_CASE("A hold is seen by any signal that was measured") {
  const std::size_t held = 200;
  for (int only = 0; only < 2; ++only) {
    History history = after_hold(lightly_damped(X, 0.0), held);
    make_noisy(history, 2e-3, 5);
    history.x.clear();
    if (only == 1) history.v.clear();
    CAPTURE(only);
    const FreePart part = free_part(history);
    CHECK(part.fault.empty());
    CHECK(part.first > held);  // at the end of its largest swing: a blow might have begun the motion
    CHECK(static_cast<double>(part.first) < held + 2.1 * M_PI / natural * rate);
  }
}

TEST_CASE("A mass that comes to rest without turning back was held too") {
  const std::size_t held = 300;
  History history = after_hold(lightly_damped(1.5 * soft_x_f, 0.0), held);
  Normal normal(7);
  for (double& x : history.x) x += 1e-3 * soft_x_f * normal();
  const FreePart part = free_part(history);
  CHECK(part.first >= held);
  CHECK(part.first < held + 12);
}

TEST_CASE("A record whose free motion begins at its first sample has no hold") {
  int tried = 0;
  for (const double samples : {17.0, 40.0, 200.0})
    for (const double share : {1e-6, 0.004, 0.02, 0.04, 0.08, 0.15})
      for (int phase = 0; phase < 8; ++phase)
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
          const double angle = 0.25 * M_PI * phase;
          const double hertz = samples * natural / (2.0 * M_PI);
          History history = sampled(lightly_damped(X * std::cos(angle), X * natural * std::sin(angle)), 2.0, hertz);
          history.y.clear();
          make_noisy(history, share, seed);
          for (int only = 0; only < 3; ++only, ++tried) {
            if (only > 0) (only == 1 ? history.x : history.v).clear();
            CAPTURE(samples, share, phase, seed, only);
            CHECK(free_part(history).held == 0);
            CHECK(leave_out_hold(history).empty());
          }
        }
  CHECK(tried == 1728);
}

TEST_CASE("A mass that friction holds to the end has no free motion that begins later") {
  History history = after_hold(lightly_damped(0.5 * soft_x_f, 0.0), 100);
  Normal normal(11);
  for (double& x : history.x) x += 1e-3 * soft_x_f * normal();
  CHECK(free_part(history).held == 0);
}

TEST_CASE("A rest before a motion that is no free vibration is told and left") {
  const std::size_t held = 400;
  History history = after_hold(lightly_damped(0.0, 0.0), held);
  for (std::size_t i = held; i < history.x.size(); ++i)
    history.x[i] = X * std::sin(natural * static_cast<double>(i - held) / rate);
  Normal normal(13);
  for (double& x : history.x) x += 1e-3 * X * normal();
  const std::size_t size = history.x.size();
  const std::string warning = leave_out_hold(history);
  CHECK(warning.find("the mass does not move until t = 0.8") == 0);
  CHECK(warning.find("state the drive") != std::string::npos);
  CHECK(history.x.size() == size);
}
