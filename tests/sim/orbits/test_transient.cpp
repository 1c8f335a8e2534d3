/// The transient against the closed form, and where it does not settle.

#include "sim/orbits/transient.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "core/diagnostics.hpp"
#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;
using namespace dualdamp::sim;

namespace {

Model model(double damping, double amplitude) {
  Model result;
  result.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = damping};
  result.excitation = {.type = ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = 10.0};
  result.friction = {friction::Law(friction::Coulomb(2.0, 2.0))};
  return result;
}

}  // namespace

TEST_CASE("transient: it settles on Den Hartog's orbit", "[transient]") {
  const Transient transient = follow_transient(model(4.0, 0.1));
  REQUIRE(transient.outcome.ok());
  CHECK(transient.settled);
  CHECK(transient.peak == Approx(0.186078097956786199).epsilon(1e-9));
  CHECK(transient.trough == Approx(-transient.peak).epsilon(1e-9));
  CHECK(transient.stops == 0);
  CHECK(transient.periods < 100);
}

TEST_CASE("transient: a motion that sticks stops as often as its steady state", "[transient]") {
  Model slow = model(4.0, 0.05);
  slow.excitation.frequency = 3.0;
  const Transient transient = follow_transient(slow);
  const SteadyState state = steady_state(slow);
  CHECK(transient.settled);
  CHECK(state.stops_per_cycle > 0);
  CHECK(transient.stops == state.stops_per_cycle);
  CHECK(transient.peak == Approx(state.peak).epsilon(1e-12));
}

TEST_CASE("transient: a subharmonic motion settles over its own period, not over a forcing period", "[transient]") {
  Model subharmonic;
  subharmonic.oscillator = {.mass = 0.008529171435, .stiffness = 0.09238674538297, .damping = 8.673479922e-4};
  subharmonic.excitation = {.type = ExcitationType::base_harmonic,
                            .amplitude = 0.3272648471676,
                            .frequency = 0.22099544102879,
                            .phase = 4.9645380994};
  subharmonic.friction = {
      friction::Law(friction::ContactCompliance(0.006211558892169, 0.01112964547049, 0.4251325299917, 0.0))};
  const SteadyState state = steady_state(subharmonic);
  REQUIRE(state.outcome.ok());
  REQUIRE(state.period_ratio == 3);
  CHECK_FALSE(follow_transient(subharmonic, {.max_periods = 300}).settled);
  const Transient transient = follow_transient(subharmonic, {.max_periods = 300, .period_ratio = 3});
  CHECK(transient.settled);
  CHECK(transient.periods % 3 == 0);
  CHECK(transient.peak == Approx(state.peak).epsilon(1e-9));
  CHECK(transient.trough == Approx(state.trough).epsilon(1e-9));
}

TEST_CASE("transient: a motion that winds slowly about its orbit has not settled where it turns", "[transient]") {
  // Floquet multipliers 0.9855 exp(+-0.0121 i): one turn takes 519 periods.
  sim::Model winding;
  winding.oscillator = {.mass = 18.51781894093475, .stiffness = 2466043.1789296954, .damping = 0.23379331987142407};
  winding.excitation = {.type = sim::ExcitationType::base_harmonic,
                        .amplitude = 0.00450114147373048,
                        .frequency = 121084.48955011295,
                        .phase = 2.7452865322734437};
  winding.friction = {friction::Law(friction::Coulomb(80.74603083615801, 80.74603083615801))};
  const Transient transient = follow_transient(winding);
  REQUIRE(transient.settled);
  const double amplitude = sim::steady_state(winding).amplitude;
  CHECK(transient.peak == Approx(amplitude).epsilon(4e-9));
  CHECK(transient.trough == Approx(-amplitude).epsilon(4e-9));
}

TEST_CASE("transient: a fast decay does not hide a slow one of far larger rest", "[transient]") {
  // An overdamped oscillator: of its own motion one part falls by exp(-17.7) in a period, the other by 3.4e-6 of
  // itself. After ten periods the peak is 6e-7 off, which takes some millions of periods.
  sim::Model overdamped;
  overdamped.oscillator = {
      .mass = 0.26008628435605097, .stiffness = 0.17707148198916256, .damping = 487.52632245983006};
  overdamped.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.34607974855929846, .frequency = 664.088960624806};
  const Transient transient = follow_transient(overdamped, {.max_periods = 500, .settled = 1e-8});
  CHECK_FALSE(transient.settled);
  CHECK(transient.peak - sim::steady_state(overdamped).peak == Approx(-1.03e-13).epsilon(0.05));
}

TEST_CASE("transient: a slow decay that a fast one still hides is waited for", "[transient]") {
  // The parts fall by a factor of 2.8 and by 5e-5 of themselves in a period. When the fast one would seem to have
  // settled, 2e-5 of the motion are left of the slow one.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 5e-5 * 1.03, .damping = 1.03};
  model.excitation = {.type = sim::ExcitationType::force_harmonic,
                      .amplitude = 1.0,
                      .frequency = 2.0 * std::numbers::pi,
                      .phase = 0.3};
  const SteadyState state = steady_state(model);
  model.initial = {.position = state.start.x + 2e-5 * state.peak, .velocity = state.start.v + 3.0 * state.peak};
  const Transient transient = follow_transient(model, {.max_periods = 500, .settled = 1e-8});
  CHECK_FALSE(transient.settled);
}

TEST_CASE("transient: a motion that grows does not settle", "[transient]") {
  // Undamped at resonance with F0 below pi/4 k Y.
  const Transient transient = follow_transient(model(0.0, 0.1), {.max_periods = 100});
  CHECK_FALSE(transient.settled);
  CHECK(transient.periods == 100);
}

TEST_CASE("transient: it ends when the caller has had enough, and needs a period", "[transient]") {
  int asked = 0;
  const Transient transient = follow_transient(model(0.0, 0.1), {.give_up = [&] { return ++asked == 5; }});
  CHECK(asked == 5);
  CHECK_FALSE(transient.settled);
  Model free = model(4.0, 0.1);
  free.excitation = {};
  CHECK_THROWS_AS(follow_transient(free), core::InputError);
}
