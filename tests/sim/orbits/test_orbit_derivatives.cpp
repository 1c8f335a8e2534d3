// The monodromy matrix of the exact engine against difference quotients of the period map, on random systems with a
// static limit that depends on position, static above kinetic, compliant contacts and harmonics.

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "friction_models/registry.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace dualdamp;
using friction::ParameterValues;
using sim::ForcingPeriod;
using sim::Monodromy;

void add_law(sim::Model& model, std::string_view name, ParameterValues values) {
  for (friction::Law& law : test::laws_of(name, std::move(values))) model.friction.push_back(std::move(law));
}

/// The steady orbit of this model sticks at a static limit that falls with |x|.
sim::Model position_dependent_limit() {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.629};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.0283, .frequency = 2.757};
  add_law(model, "coulomb", {{"kinetic", 0.782}, {"static", 2.231}, {"position_slope", -90.69}});
  return model;
}

/// m = 1 kg, k = 1 N/m, friction about as large as the drive, so that most motions stick.
sim::Model random_model(test::Random& random) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = random.logarithmic(1e-3, 1.0)};
  model.excitation = {
      .type = random.chance(0.5) ? sim::ExcitationType::base_harmonic : sim::ExcitationType::force_harmonic,
      .amplitude = 1.0,
      .frequency = random.logarithmic(0.1, 3.0),
      .phase = random.angle()};
  if (random.chance(0.3))
    model.excitation.harmonics.push_back(
        {.order = 2 + random.pick(4), .amplitude = random.uniform(0.05, 0.5), .phase = random.angle()});
  const double kinetic = random.uniform(0.1, 0.9);
  const double ratio = random.chance(0.7) ? random.uniform(1.0, 2.0) : 1.0;
  ParameterValues values = {{"kinetic", kinetic}, {"static", ratio * kinetic}};
  const bool compliant = random.chance(0.3);
  if (compliant) values.set("contact_stiffness", random.logarithmic(0.5, 50.0));
  if (random.chance(0.7)) values.set("position_slope", random.uniform(-0.9, 0.9) * kinetic);
  add_law(model, compliant ? "contact_compliance" : "coulomb", values);
  return model;
}

/// Column `j` of the derivative by central differences, where the period keeps its mode and two widths agree.
std::optional<Eigen::VectorXd> quotient(sim::PeriodMap& map, const ForcingPeriod& period, Eigen::Index j) {
  const auto difference = [&](double h) -> std::optional<Eigen::VectorXd> {
    const Eigen::VectorXd change = h * Eigen::VectorXd::Unit(sim::coordinates(period.begin).size(), j);
    const sim::State above = map.from(sim::displaced(period.begin, change), Monodromy::without).end;
    const sim::State below = map.from(sim::displaced(period.begin, -change), Monodromy::without).end;
    if (!same_mode(above, period.end) || !same_mode(below, period.end)) return std::nullopt;
    return Eigen::VectorXd((sim::coordinates(above) - sim::coordinates(below)) / (2.0 * h));
  };
  const auto wide = difference(4e-6);
  const auto narrow = difference(1e-6);
  // Truncation falls with h^2 and rounding is 1e-10; otherwise an event appears or disappears in between.
  if (!wide || !narrow || (*wide - *narrow).norm() > 1e-6 * (1.0 + narrow->norm())) return std::nullopt;
  return narrow;
}

}  // namespace

TEST_CASE("a release whose limit depends on position passes a perturbation on as the motion does") {
  const sim::Model model = position_dependent_limit();
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  REQUIRE_FALSE(state.sticks.empty());
  CHECK(state.stable());
  CHECK(state.warnings.empty());
  double radius = 0.0;
  for (const std::complex<double>& multiplier : state.multipliers) radius = std::max(radius, std::abs(multiplier));
  // The difference quotient of the period map in the only direction that remains after a stick: the trace.
  sim::PeriodMap map(model);
  const ForcingPeriod period = map.from(state.start, Monodromy::with);
  double trace = 0.0;
  for (Eigen::Index j = 0; j < 2; ++j) {
    const auto column = quotient(map, period, j);
    REQUIRE(column);
    trace += (*column)[j];
  }
  CHECK(radius == Approx(std::abs(trace)).epsilon(1e-6));
  // The smooth engine's own derivative.
  sim::Model integrated = model;
  integrated.solver.kind = sim::SolverKind::explicit_steps;
  sim::PeriodMap smooth(integrated);
  CHECK((smooth.from(state.start, Monodromy::with).monodromy - period.monodromy).norm() <
        1e-5 * period.monodromy.norm());
}

TEST_CASE("two contacts that let go at one instant pass a perturbation on each at its own") {
  // Both start at x = 1/128 m from where they stick, with the same bits.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  add_law(model, "contact_compliance", {{"kinetic", 0.5}, {"static", 1.0}, {"contact_stiffness", 128.0}});
  add_law(model, "contact_compliance", {{"kinetic", 1.5}, {"static", 2.0}, {"contact_stiffness", 256.0}});
  for (const sim::SolverKind kind : {sim::SolverKind::automatic, sim::SolverKind::explicit_steps}) {
    model.solver = {kind, 1e-13};
    sim::PeriodMap map(model);
    const ForcingPeriod period = map.from_start(0.0, 0.0, Monodromy::with);
    REQUIRE(period.monodromy.cols() == 4);
    for (Eigen::Index j = 0; j < period.monodromy.cols(); ++j) {
      if (j == 1) continue;  // it starts from rest
      Eigen::VectorXd change = Eigen::VectorXd::Zero(period.monodromy.cols());
      constexpr double step = 1e-7;
      change[j] = step;
      const ForcingPeriod above = map.from(sim::displaced(period.begin, change), Monodromy::without);
      const ForcingPeriod below = map.from(sim::displaced(period.begin, -change), Monodromy::without);
      const Eigen::VectorXd quotient = (sim::coordinates(above.end) - sim::coordinates(below.end)) / (2.0 * step);
      INFO("column " << j << ": " << period.monodromy.col(j).transpose() << ", by differences "
                     << quotient.transpose());
      CHECK((quotient - period.monodromy.col(j)).norm() < 1e-4 * quotient.norm());
    }
  }
}

TEST_CASE("the order of laws in parallel does not matter to the monodromy matrix") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 7.0};
  add_law(model, "contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 300.0}, {"contact_damping", 5.0}});
  add_law(model, "coulomb", {{"kinetic", 1.0}});
  sim::Model reversed = model;
  std::ranges::reverse(reversed.friction);
  const sim::SteadyState first = sim::steady_state(model);
  const sim::SteadyState second = sim::steady_state(reversed);
  REQUIRE(first.outcome.ok());
  REQUIRE(second.outcome.ok());
  REQUIRE(first.multipliers.size() == second.multipliers.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < first.multipliers.size(); ++i) {
    CHECK(std::abs(first.multipliers[i] - second.multipliers[i]) < 1e-9);
    largest = std::max(largest, std::abs(first.multipliers[i]));
  }
  CHECK(largest > 1e-3);
}

TEST_CASE("monodromy matrices of random systems are the difference quotients of their period maps") {
  test::Random random(20261122);
  int columns = 0;
  int compared = 0;
  int stuck = 0;
  for (long i = 0; i < test::case_count("DUALDAMP_DERIVATIVE_CASES", 600); ++i) {
    const sim::Model model = random_model(random);
    sim::PeriodMap map(model);
    (void)map.from_start(random.uniform(-1.0, 1.0), 0.0, Monodromy::without);
    ForcingPeriod period = map.next(Monodromy::with);
    REQUIRE(map.outcome().ok());
    CAPTURE(i, model.excitation.frequency, model.oscillator.damping);
    const bool rests = period.begin.direction == friction::Direction::none;
    for (Eigen::Index j = 0; j < period.monodromy.cols(); ++j) {
      // The speed of a mass that sticks cannot be perturbed.
      if (rests && j == 1) continue;
      ++columns;
      const auto expected = quotient(map, period, j);
      if (!expected) continue;
      ++compared;
      stuck += period.monodromy.topLeftCorner(2, 2).determinant() == 0.0 ? 1 : 0;
      CHECK((period.monodromy.col(j) - *expected).norm() < 1e-5 * (1.0 + expected->norm()));
    }
  }
  CHECK(compared > 0.9 * columns);
  CHECK(stuck > 0.1 * columns);
}

TEST_CASE("a derivative that is not finite does not attract") {
  ForcingPeriod period;
  period.monodromy = Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  CHECK_FALSE(period.radius() < 1.0);
  CHECK_FALSE(period.free_radius() < 1.0);
  period.monodromy = Eigen::Matrix3d::Identity() * 0.5;
  period.monodromy(2, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(period.radius() < 1.0);
}

TEST_CASE("the derivative over a period has the same digits in any units of length, force and time") {
  struct Units {
    double force, length, time;
  };
  const auto period_in = [](const Units& u) {
    sim::Model model;
    model.oscillator = {.mass = u.force * u.time * u.time / u.length,
                        .stiffness = 100.0 * u.force / u.length,
                        .damping = 4.0 * u.force * u.time / u.length};
    model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = 0.1 * u.length, .frequency = 3.0 / u.time};
    add_law(model, "contact_compliance",
            {{"kinetic", 2.0 * u.force},
             {"static", 2.5 * u.force},
             {"contact_stiffness", 1000.0 * u.force / u.length},
             {"contact_damping", u.force * u.time / u.length}});
    sim::PeriodMap map(model);
    static_cast<void>(map.from_start(0.0, 0.0, Monodromy::without));
    return map.next(Monodromy::with);
  };
  const ForcingPeriod first = period_in({1.0, 1.0, 1.0});
  REQUIRE(first.monodromy.cols() == 3);
  // In microseconds the unit perturbations of position and speed were so different that entries were 1e-8 off.
  for (const Units u :
       {Units{1.0, 0x1p-53, 1.0}, Units{0x1p60, 0x1p53, 1.0}, Units{1.0, 1.0, 0x1p-20}, Units{1.0, 1.0, 0x1p30}}) {
    CAPTURE(u.force, u.length, u.time);
    const ForcingPeriod other = period_in(u);
    CHECK(other.end.x / u.length == first.end.x);
    const auto size = sim::sizes_of_coordinates(first, 3.0);
    const auto other_size = sim::sizes_of_coordinates(other, 3.0 / u.time);
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j)
        CHECK(other.monodromy(i, j) * other_size[j] / other_size[i] == first.monodromy(i, j) * size[j] / size[i]);
  }
}
