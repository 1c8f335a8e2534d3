// Curves that are stepped through, against an integration of the motion level by level with independent code.

#include "sim/curves/stepped_curves.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "friction_models/laws/coulomb.hpp"

namespace {

using namespace dualdamp;

/// A hardening spring without friction: three steady states between the two jumps.
sim::Model duffing() {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.1, .cubic_stiffness = 0.5};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.3, .frequency = 1.0};
  return model;
}

std::vector<double> levels(double from, double to, int count) {
  std::vector<double> list;
  for (int i = 0; i < count; ++i) list.push_back(from + (to - from) * i / (count - 1));
  return list;
}

/// The motion of `duffing()` by fourth-order Runge-Kutta steps, continued from level to level at the end of a
/// forcing period.
class Integration {
 public:
  explicit Integration(const sim::Model& model) : o_(model.oscillator), amplitude_(model.excitation.amplitude) {}

  /// Half the distance between the extremes of the last of many periods.
  double amplitude_at(double omega) {
    constexpr int periods = 400;
    constexpr int steps = 300;
    const double h = 2.0 * std::numbers::pi / omega / steps;
    double peak = 0.0;
    double trough = 0.0;
    for (int period = 0; period < periods; ++period) {
      peak = trough = state_[0];
      for (int i = 0; i < steps; ++i) {
        const double before = state_[0];
        const double before_v = state_[1];
        step(i * h, h, omega);
        // The extreme between two steps by the cubic through both ends.
        const double extreme = before_v * state_[1] < 0.0 ? extreme_of(before, before_v, h) : state_[0];
        peak = std::max({peak, state_[0], extreme});
        trough = std::min({trough, state_[0], extreme});
      }
    }
    return 0.5 * (peak - trough);
  }

 private:
  using State = std::array<double, 2>;

  [[nodiscard]] State slope(const State& s, double t, double omega) const {
    const double force = amplitude_ * std::cos(omega * t) - o_.damping * s[1] - o_.stiffness * s[0] -
                         o_.cubic_stiffness * s[0] * s[0] * s[0];
    return {s[1], force / o_.mass};
  }

  void step(double t, double h, double omega) {
    const auto moved = [&](const State& k, double by) {
      return State{state_[0] + by * k[0], state_[1] + by * k[1]};
    };
    const State k1 = slope(state_, t, omega);
    const State k2 = slope(moved(k1, h / 2), t + h / 2, omega);
    const State k3 = slope(moved(k2, h / 2), t + h / 2, omega);
    const State k4 = slope(moved(k3, h), t + h, omega);
    for (std::size_t i = 0; i < 2; ++i) state_[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }

  [[nodiscard]] double extreme_of(double x, double v, double h) const {
    double best = x;
    constexpr int parts = 64;
    for (int i = 1; i < parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      const double here = (1 + 2 * s) * (1 - s) * (1 - s) * x + s * (1 - s) * (1 - s) * h * v +
                          s * s * (3 - 2 * s) * state_[0] - s * s * (1 - s) * h * state_[1];
      if (std::abs(here) > std::abs(best)) best = here;
    }
    return best;
  }

  sim::Oscillator o_;
  double amplitude_;
  State state_ = {0.0, 0.0};
};

/// Where consecutive points differ by more than half of the larger one.
std::vector<std::size_t> jumps(const std::vector<sim::CurvePoint>& points) {
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (std::abs(points[i].x - points[i - 1].x) > 0.4 * std::max(points[i].x, points[i - 1].x)) found.push_back(i);
  return found;
}

}  // namespace

TEST_CASE("stepped curves: a cubic spring jumps where an integration of the motion does", "[sim][stepped]") {
  const sim::Model model = duffing();
  const sim::Curve curve = sim::stepped_frequency_response(model, levels(1.0, 1.8, 41), sim::Stepping::both);
  REQUIRE(curve.points.size() == 82);
  Integration integration(model);
  for (const sim::CurvePoint& point : curve.points) {
    CAPTURE(point.omega);
    REQUIRE(point.ok());
    CHECK(point.stable);
    CHECK(point.x == Approx(integration.amplitude_at(point.omega)).epsilon(1e-6));
  }
  // One jump up the frequencies, another one down, at a lower frequency: between them lies the hysteresis.
  const std::vector<std::size_t> at = jumps(curve.points);
  REQUIRE(at.size() == 2);
  CHECK(at[0] < 41);
  CHECK(at[1] > 41);
  CHECK(curve.points[at[0]].omega > curve.points[at[1]].omega + 0.1);
}

TEST_CASE("stepped curves: where one orbit attracts all motions the curve is the ordinary one", "[sim][stepped]") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  const std::vector<double> amplitudes = levels(0.03, 0.3, 28);
  const sim::Curve ordinary = sim::xy_curve(model, amplitudes);
  const sim::Curve both = sim::stepped_xy_curve(model, amplitudes, sim::Stepping::both);
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const sim::CurvePoint& expected = ordinary.points[i];
    for (const sim::CurvePoint& point : {both.points[i], both.points[both.points.size() - 1 - i]}) {
      CAPTURE(expected.Y);
      CHECK(point.Y == expected.Y);
      CHECK(point.x == Approx(expected.x).epsilon(1e-12).margin(1e-16));
      CHECK(point.stops == expected.stops);
      CHECK(point.sticks == expected.sticks);
    }
  }
}

TEST_CASE("stepped curves: levels are stepped through in order, whatever the order of the list", "[sim][stepped]") {
  CHECK(sim::stepped({2.0, 1.0, 3.0}, sim::Stepping::up) == std::vector{1.0, 2.0, 3.0});
  CHECK(sim::stepped({2.0, 1.0, 3.0}, sim::Stepping::down) == std::vector{3.0, 2.0, 1.0});
  CHECK(sim::stepped({2.0, 1.0, 3.0}, sim::Stepping::both) == std::vector{1.0, 2.0, 3.0, 3.0, 2.0, 1.0});
}

TEST_CASE("stepped curves: static friction above kinetic breaks away higher than it comes to rest",
          "[sim][stepped]") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 1.0, .frequency = 9.0};
  model.friction.emplace_back(friction::Coulomb(1.0, 3.0));
  const sim::Curve curve = sim::stepped_xy_curve(model, levels(0.5, 5.0, 46), sim::Stepping::both);
  double first_up = 0.0;
  double last_down = 0.0;
  for (std::size_t i = 0; i < 46; ++i)
    if (first_up == 0.0 && curve.points[i].x > 1e-3) first_up = curve.points[i].Y;
  for (std::size_t i = 46; i < 92; ++i)
    if (curve.points[i].x > 1e-3) last_down = curve.points[i].Y;
  // At rest the pull is the drive itself: it breaks away above 3 N.
  CHECK(first_up == Approx(3.1));
  CHECK(last_down < 2.6);
}
