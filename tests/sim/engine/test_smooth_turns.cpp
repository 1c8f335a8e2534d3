/// Bristles that yield at a level which falls within a small part of the speed: at a reversal this lasts for a
/// short time only. Compared with the same equations in fixed small steps, which are accurate to 3e-10.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>

#include "sim/engine/engine.hpp"
#include "sim/orbits/period_map.hpp"
#include "tests/support/make_law.hpp"

namespace {

using namespace dualdamp;
using sim::Monodromy;
using sim::SolverKind;

constexpr double drive_rate = 0.9;
constexpr double dashpot = 0.01;
constexpr double kinetic_level = 0.3;
constexpr double static_level = 0.45;
constexpr double bristle_damping = 0.3;

struct Bristles {
  double stiffness;
  double stribeck_velocity;
};

sim::Model model_with(Bristles bristles) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = dashpot};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = drive_rate};
  model.friction = {test::law("lugre", {{"kinetic", kinetic_level},
                                        {"static", static_level},
                                        {"stribeck_velocity", bristles.stribeck_velocity},
                                        {"sigma0", bristles.stiffness},
                                        {"sigma1", bristle_damping}})};
  return model;
}

using BristleState = std::array<double, 3>;  // x, v, z

/// One forcing period of the equations of canudas1995, by the classical Runge-Kutta method.
BristleState by_small_steps(Bristles bristles, BristleState from, int steps) {
  const auto rates = [&](const BristleState& at, double t) -> BristleState {
    const auto [x, v, z] = at;
    const double ratio = v / bristles.stribeck_velocity;
    const double level = kinetic_level + (static_level - kinetic_level) * std::exp(-ratio * ratio);
    const double yielding = v - bristles.stiffness * std::abs(v) * z / level;
    const double friction = bristles.stiffness * z + bristle_damping * yielding;
    return {v, std::cos(drive_rate * t) - x - dashpot * v - friction, yielding};
  };
  const auto along = [](const BristleState& at, double s, const BristleState& by) -> BristleState {
    return {at[0] + s * by[0], at[1] + s * by[1], at[2] + s * by[2]};
  };
  const double h = 2.0 * std::acos(-1.0) / drive_rate / steps;
  BristleState at = from;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const BristleState a = rates(at, t);
    const BristleState b = rates(along(at, 0.5 * h, a), t + 0.5 * h);
    const BristleState c = rates(along(at, 0.5 * h, b), t + 0.5 * h);
    const BristleState d = rates(along(at, h, c), t + h);
    for (std::size_t k = 0; k < at.size(); ++k) at[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
  }
  return at;
}

/// For a motion after two forcing periods.
sim::State running(const sim::Model& model) {
  sim::PeriodMap map(model);
  static_cast<void>(map.from_start(0.5, 0.0, Monodromy::without));
  return map.next(Monodromy::without).end;
}

}  // namespace

TEST_CASE("smooth engine: a step does not pass over what a turn shows of the friction at low speed",
          "[sim][smooth]") {
  constexpr Bristles bristles = {.stiffness = 1e2, .stribeck_velocity = 1e-2};
  sim::Model model = model_with(bristles);
  const sim::State start = running(model);
  const BristleState expected = by_small_steps(bristles, {start.x, start.v, start.memories[0].state[0]}, 400'000);
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::explicit_steps, SolverKind::implicit_steps}) {
    for (const double tolerance : {1e-8, 1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12}) {
      model.solver = {kind, tolerance};
      sim::PeriodMap map(model);
      const sim::State end = map.from(start, Monodromy::without).end;
      CAPTURE(tolerance, static_cast<int>(kind));
      CHECK(std::abs(end.x - expected[0]) < 2.0 * tolerance + 1e-9);
      CHECK(std::abs(end.v - expected[1]) < 2.0 * tolerance + 1e-9);
    }
  }
}

TEST_CASE("smooth engine: the derivative passes a turn at which the bristles' level falls within 1e-4 of the speed",
          "[sim][smooth][derivative]") {
  constexpr Bristles bristles = {.stiffness = 1e3, .stribeck_velocity = 1e-4};
  sim::Model model = model_with(bristles);
  const sim::State start = running(model);
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::explicit_steps, SolverKind::implicit_steps}) {
    model.solver = {kind, 1e-11};
    sim::PeriodMap map(model);
    const sim::ForcingPeriod period = map.from(start, Monodromy::with);
    for (const Eigen::Index j : {0, 1}) {
      const Eigen::VectorXd change = 1e-4 * Eigen::VectorXd::Unit(sim::coordinates(start).size(), j);
      const sim::State above = map.from(sim::displaced(start, change), Monodromy::without).end;
      const sim::State below = map.from(sim::displaced(start, -change), Monodromy::without).end;
      CAPTURE(static_cast<int>(kind), j);
      CHECK(std::abs(period.monodromy(0, j) - (above.x - below.x) / 2e-4) < 1e-5);
      CHECK(std::abs(period.monodromy(1, j) - (above.v - below.v) / 2e-4) < 1e-5);
    }
  }
}
