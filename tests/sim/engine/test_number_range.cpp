/// Motions that grow beyond the range of double precision, under both engines.

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;

TEST_CASE("a motion that leaves the range of double precision gives out numbers up to its end, and says so") {
  // Negative damping, 100 times critical: the motion grows by a factor of e in 1.8 ms.
  sim::Model model;
  model.oscillator = {.mass = 0.13, .stiffness = 1648.0, .damping = -72.0};
  model.friction.emplace_back(friction::Coulomb(0.08, 0.18));
  model.initial = {.position = 1e-3, .velocity = 0.0};
  for (const sim::SolverKind kind :
       {sim::SolverKind::automatic, sim::SolverKind::explicit_steps, sim::SolverKind::implicit_steps}) {
    CAPTURE(static_cast<int>(kind));
    model.solver.kind = kind;
    const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
    long intervals = 0;
    bool finite = true;
    while (const sim::Interval* interval = engine->next(2.0)) {
      ++intervals;
      for (const double part : {0.0, 0.1, 0.5, 0.9, 1.0}) {
        const sim::Sample sample = interval->at(part * interval->duration);
        finite = finite && std::isfinite(sample.x) && std::isfinite(sample.v) && std::isfinite(sample.a);
      }
    }
    // The exact engine has no event in this motion: its first interval is the one that leaves the range.
    CHECK((intervals > 0) == (kind != sim::SolverKind::automatic));
    CHECK(finite);
    CHECK(engine->outcome().kind == core::OutcomeKind::not_finite);
    CHECK(engine->outcome().reason == "the motion left the range of double precision");
  }
}

TEST_CASE("a motion beside a fast decay leaves the range of double precision at once") {
  // A slip grows by a factor of e in 1.3 s beside a contact that decays within 1e-16 s. Near the end of the range,
  // after 942 s, panels as narrow as that decay do not advance beyond the rounding of time: the search took 8 s.
  sim::Model model;
  model.oscillator = {.mass = 762.7311862185226, .stiffness = 61.90184528425616, .damping = -656.6481953624643};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.7857855280727175,
                      .frequency = 0.00041027930849503794,
                      .phase = 1.1502662378786754};
  model.friction = {test::law("contact_compliance", {{"kinetic", 0.0002355008624421857},
                                                     {"contact_stiffness", 324673442.69351846},
                                                     {"contact_damping", 5.056484589506709e-08}})};
  const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
  while (engine->next(1000.0) != nullptr) {
  }
  CHECK(engine->outcome().kind == core::OutcomeKind::not_finite);
  CHECK(engine->outcome().reason == "the motion left the range of double precision");
  CHECK(engine->work() < 10'000);
  // Before that it is followed as any other: by the faster of the two growing parts.
  const std::unique_ptr<sim::Engine> shorter = sim::make_engine(model);
  while (shorter->next(800.0) != nullptr) {
  }
  CHECK(shorter->outcome().ok());
  const sim::Oscillator& rig = model.oscillator;
  const double growth =
      (-rig.damping + std::sqrt(rig.damping * rig.damping - 4.0 * rig.mass * rig.stiffness)) / (2.0 * rig.mass);
  CHECK(shorter->velocity() / shorter->position() == Approx(growth).epsilon(1e-9));
}

TEST_CASE("A mass that enters a stiff stop at high speed does not leave it at once by rounding", "[exact]") {
  // Negative damping: at 1e15 m the two positions of the stop are within rounding of one. In the stop the speed
  // grows in each half turn by exp(-c/(2 m) pi/w), w^2 = (k + kc)/m - (c/(2 m))^2.
  sim::Model model;
  model.oscillator = {.mass = 537.0738972389337, .stiffness = 19503600.44648999, .damping = -762101.6871458865};
  model.friction = {test::law("gap_spring", {{"stiffness", 9232883926.624079}, {"gap", 0.013356579743242492}})};
  model.excitation = {.type = sim::ExcitationType::force_harmonic,
                      .amplitude = 4277111.6159095755,
                      .frequency = 2.9162033631650153,
                      .phase = 0.9265619075038918};
  const sim::History history = sim::simulate(model, {.duration = 0.3});
  INFO(history.outcome.reason);
  REQUIRE(history.outcome.ok());
  const double growth = 762101.6871458865 / (2.0 * 537.0738972389337);
  const double half_turn =
      std::numbers::pi / std::sqrt((19503600.44648999 + 9232883926.624079) / 537.0738972389337 - growth * growth);
  std::vector<sim::Event> turns;
  for (const sim::Event& event : history.events)
    if (event.kind == sim::EventKind::reversal && event.t > 0.1) turns.push_back(event);
  CHECK(turns.size() == static_cast<std::size_t>(std::lround(0.2 / half_turn)));
  for (std::size_t i = 1; i < turns.size(); ++i) {
    CHECK(turns[i].t - turns[i - 1].t == Approx(half_turn).epsilon(1e-9));
    CHECK(turns[i].x / turns[i - 1].x == Approx(-std::exp(growth * half_turn)).epsilon(1e-9));
  }
}
