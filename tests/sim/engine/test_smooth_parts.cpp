/// The parts of the smooth engine, each alone: guards, the search for a crossing, steps, the derivative.

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/engine/smooth/event_search.hpp"
#include "sim/engine/smooth/guards.hpp"
#include "sim/engine/smooth/motion_derivative.hpp"
#include "sim/engine/smooth/steps.hpp"
#include "tests/support/make_law.hpp"

namespace {

using namespace dualdamp;
using friction::Direction;
using sim::EventSearch;
using sim::Steps;
using test::law;

/// m = 1 kg, k = 100 N/m, no damping, no drive.
sim::Model free_system(friction::Law friction) {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.0};
  model.excitation = {.type = sim::ExcitationType::none};
  model.friction = {std::move(friction)};
  return model;
}

/// The flow of an interval in one direction.
struct IntervalAlone {
  IntervalAlone(sim::Model system, Direction direction)
      : model(std::move(system)), drive(model.oscillator, model.excitation), flow(model, drive, past) {
    for (const friction::Law& each : model.friction) memories.push_back(each.start({}));
    drive.reset(0.0);
    past.clear(0.0, 0.0);
    flow.freeze(memories, direction, 0.0);
    flow.set_scales(0.1, 1.0);
  }

  sim::Model model;
  sim::Drive drive;
  sim::VelocityHistory past;
  sim::Flow flow;
  std::vector<friction::Memory> memories;
};

/// A dense output with this velocity over the parts of a step.
class GivenVelocity final : public sim::Stepper {
 public:
  explicit GivenVelocity(std::function<double(double)> velocity) : velocity_(std::move(velocity)) {}
  [[nodiscard]] bool step(const sim::VectorField&, std::span<const double>, double, double, std::span<const double>,
                          std::span<double>, std::span<double>) override {
    return false;
  }
  void at(double part, std::span<double> x) const override {
    x[0] = 0.0;
    x[1] = velocity_(part);
  }
  [[nodiscard]] int order() const override { return 1; }
  [[nodiscard]] double stiffness() const override { return 0.0; }

 private:
  std::function<double(double)> velocity_;
};

struct FirstHit {
  std::optional<EventSearch::Hit> hit;
  std::vector<core::Grazing> grazings;
};

/// What the search finds on a step of 1 s of a slip with this velocity.
FirstHit first_hit_on(std::function<double(double)> velocity) {
  const IntervalAlone slip(free_system(law("coulomb", {{"kinetic", 2.0}})), Direction::forward);
  const GivenVelocity stepper(std::move(velocity));
  std::vector<double> begin(2);
  std::vector<double> end(2);
  stepper.at(0.0, begin);
  stepper.at(1.0, end);
  EventSearch search(slip.model, slip.flow);
  search.begin_interval(begin, 0.0, 0.0);
  const auto hit = search.find({slip.flow, stepper, begin, end, 0.0, 1.0, 1.0});
  return {hit, search.grazings()};
}

/// Friction of a level, from a velocity `lag` [s] ago.
struct LateLevel {
  double lag;
  [[nodiscard]] double force(const friction::Memory&, const friction::Instant& now, Direction) const {
    return now.past_velocity;
  }
  [[nodiscard]] double delay() const { return lag; }
};

}  // namespace

TEST_CASE("smooth parts: guards of a slip and of a stick", "[sim][smooth]") {
  const sim::Model model = free_system(law("coulomb", {{"kinetic", 2.0}, {"static", 3.0}}));
  const std::vector<double> X = {0.02, -0.5};

  const IntervalAlone slip(model, Direction::backward);
  sim::Guards guards(slip.model, slip.flow);
  guards.list(X, 0.0);
  REQUIRE(sim::is<sim::SlipEnd>(guards.ending(0)));
  CHECK(guards.value(0, X, 0.0) == 0.5);
  // -v' = k x - F: the friction of 2 N drives a backward slip forward.
  CHECK(guards.rate(0, X, 0.0, 1.0) == Approx(100.0 * 0.02 - 2.0).margin(1e-12));

  const IntervalAlone stick(model, Direction::none);
  sim::Guards held(stick.model, stick.flow);
  const std::vector<double> rest = {0.02, 0.0};
  held.list(rest, 0.0);
  REQUIRE(held.size() >= 2);
  // The spring pulls by -2 N, and 3 N hold.
  CHECK(held.value(0, rest, 0.0) == Approx(5.0));
  CHECK(held.value(1, rest, 0.0) == Approx(1.0));
}

TEST_CASE("smooth parts: the search finds pairs of crossings between its points", "[sim][smooth]") {
  const auto between = [](double a, double b) { return [=](double p) { return (p - a) * (p - b); }; };
  for (const auto& [a, b] : std::vector<std::pair<double, double>>{
           {0.35, 0.40}, {0.05, 0.0503}, {0.95, 0.9502}, {0.499, 0.501}, {0.3, 2.0}}) {
    CAPTURE(a, b);
    const FirstHit found = first_hit_on(between(a, b));
    REQUIRE(found.hit);
    CHECK(found.hit->guard == 0);
    CHECK(found.hit->part == Approx(a).epsilon(1e-9));
    CHECK(found.grazings.empty());
  }
  CHECK_FALSE(first_hit_on([](double p) { return 1.0 + p; }).hit);

  // Within the error of the dense output of zero: a grazing.
  const FirstHit touch = first_hit_on([](double p) { return (p - 0.4) * (p - 0.4) + 1e-12; });
  CHECK_FALSE(touch.hit);
  REQUIRE(touch.grazings.size() == 1);
  CHECK(touch.grazings.front().s == Approx(0.4));
}

TEST_CASE("smooth parts: steps follow a linear motion, and are repeated shorter", "[sim][smooth]") {
  const IntervalAlone slip(free_system(law("coulomb", {{"kinetic", 2.0}})), Direction::forward);
  Steps steps(slip.model, slip.drive, slip.flow);
  steps.begin_motion();
  steps.begin_interval(-0.1, 0.5, slip.memories);
  // About -F/k with w = 10 rad/s.
  const auto position = [](double t) { return -0.02 - 0.08 * std::cos(10.0 * t) + 0.05 * std::sin(10.0 * t); };
  double t = 0.0;
  while (t < 0.2) {
    REQUIRE(steps.advance(t, t, 0.2 - t) == Steps::Result::taken);
    CHECK(steps.length() <= steps.longest(t));
    CHECK(steps.end()[0] == Approx(position(t + steps.length())).margin(1e-11));
    if (t + steps.length() >= 0.2) break;
    t += steps.length();
    steps.go_on(false);
  }
  REQUIRE(steps.repeat(0.5 * steps.length()));
  CHECK(steps.end()[0] == Approx(position(t + steps.length())).margin(1e-11));

  Steps::Result result = Steps::Result::taken;
  long count = 0;
  while (result == Steps::Result::taken && count < 2 * Steps::most_at_instant) {
    result = steps.advance(t, t, 1e-6);
    ++count;
  }
  CHECK(result == Steps::Result::too_many);
  CHECK(steps.stand_still());
  CHECK(count > Steps::most_at_instant);
}

TEST_CASE("smooth parts: a step that meets a turn ends just beyond it", "[sim][smooth]") {
  const IntervalAlone slip(free_system(law("coulomb", {{"kinetic", 2.0}})), Direction::forward);
  Steps steps(slip.model, slip.drive, slip.flow);
  steps.begin_motion();
  steps.begin_interval(0.1, 0.12, slip.memories);
  // About -F/k: v = 0.12 cos(w t) - 1.2 sin(w t).
  const double turn = std::atan(0.1) / 10.0;
  double t = 0.0;
  while (t < 0.4 * turn) {
    REQUIRE(steps.advance(t, t, 0.4 * turn - t) == Steps::Result::taken);
    t += steps.length();
    steps.go_on(false);
  }
  REQUIRE(steps.advance(t, t, 1.0) == Steps::Result::taken);
  CHECK(steps.end()[1] < 0.0);
  CHECK(t + steps.length() < turn + 0.1 * steps.length());
}

TEST_CASE("smooth parts: few steps about a turn are refused where friction depends on the ratio of speeds",
          "[sim][smooth]") {
  sim::Model model = free_system(law("rate_state", {{"normal_force", 10.0},
                                                    {"mu0", 0.2},
                                                    {"a", 0.02},
                                                    {"b", 0.015},
                                                    {"slip_distance", 1e-3},
                                                    {"reference_velocity", 0.01}}));
  model.solver = {sim::SolverKind::implicit_steps, 2e-7};
  IntervalAlone slip(model, Direction::forward);
  Steps steps(slip.model, slip.drive, slip.flow);
  steps.begin_motion();
  steps.begin_interval(0.0, 1.0, slip.memories);
  double t = 0.0;
  const auto evaluations_until = [&](double speed) {
    const long before = slip.flow.responses();
    for (;;) {
      REQUIRE(steps.advance(t, t, 1.0) == Steps::Result::taken);
      if (steps.end()[1] < speed) return slip.flow.responses() - before;
      t += steps.length();
      steps.go_on(false);
    }
  };
  // 30 steps; 1120 evaluations where each step may be as long as the last one.
  CHECK(evaluations_until(0.0) < 700);
  // The turn: where the last step ends if it is shortened to it.
  double low = 0.0;
  double high = steps.length();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    REQUIRE(steps.repeat(middle));
    (steps.end()[1] > 0.0 ? low : high) = middle;
  }
  t += steps.length();
  const double x = steps.end()[0];
  steps.go_on(true);
  slip.flow.scatter(steps.begin(), slip.memories);
  slip.flow.freeze(slip.memories, Direction::backward, 0.0);
  steps.begin_interval(x, 0.0, slip.memories);
  steps.propose(0.0);
  // 7 steps; 215 evaluations where nothing is known at the turn.
  CHECK(evaluations_until(-0.01) < 170);
}

TEST_CASE("smooth parts: steps end at the kinks of a delayed velocity", "[sim][smooth]") {
  constexpr double lag = 0.03;
  const IntervalAlone slip(free_system(friction::Law(LateLevel{lag})), Direction::forward);
  Steps steps(slip.model, slip.drive, slip.flow);
  steps.begin_motion();
  CHECK(steps.longest(0.0) == lag);
  steps.begin_interval(0.0, 1.0, slip.memories);
  REQUIRE(steps.advance(0.0, 0.0, 0.01) == Steps::Result::taken);
  const double stop = steps.length();
  steps.go_on(true);
  CHECK(steps.begin()[1] == 0.0);
  CHECK(steps.longest(stop + 0.02) == Approx(0.01));
  CHECK(steps.longest(stop + 0.05) == Approx(0.01));  // the kink of the kink
  steps.shift(0.025, stop);
  CHECK(steps.longest(stop) == Approx(0.005));
}

TEST_CASE("smooth parts: the derivative over a step is the exponential of a linear field", "[sim][smooth]") {
  const IntervalAlone slip(free_system(law("coulomb", {{"kinetic", 2.0}})), Direction::forward);
  Steps steps(slip.model, slip.drive, slip.flow);
  steps.begin_motion();
  steps.begin_interval(-0.1, 0.5, slip.memories);
  sim::MotionDerivative derivative(slip.model, slip.drive, slip.past, steps.shortest_period());
  derivative.reset(slip.memories, Direction::forward);
  REQUIRE(steps.advance(0.0, 0.0, 0.05) == Steps::Result::taken);
  derivative.pass(steps.last());
  const double h = steps.length();
  const Eigen::MatrixXd matrix = derivative.matrix({.now = {.t = h, .x = steps.end()[0], .v = steps.end()[1]},
                                                    .local_time = h,
                                                    .direction = Direction::forward,
                                                    .memories = slip.memories});
  REQUIRE(matrix.rows() == 2);
  CHECK(matrix(0, 0) == Approx(std::cos(10.0 * h)).margin(1e-9));
  CHECK(matrix(0, 1) == Approx(std::sin(10.0 * h) / 10.0).margin(1e-9));
  CHECK(matrix(1, 0) == Approx(-10.0 * std::sin(10.0 * h)).margin(1e-8));
  CHECK(matrix(1, 1) == Approx(std::cos(10.0 * h)).margin(1e-9));
}
