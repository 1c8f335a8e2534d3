/// Motions that grow beyond the range of double precision, under both engines.

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "friction_models/laws/coulomb.hpp"
#include "sim/engine/engine.hpp"

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
