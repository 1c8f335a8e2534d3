#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/batch/batch.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/orbits/batch_steady_states.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp::sim;
using dualdamp::core::OutcomeKind;
using dualdamp::test::Random;

namespace friction = dualdamp::friction;
using friction::Affine;
using friction::Direction;
using friction::Instant;
using friction::Memory;

namespace {

/// One oscillator by the parameters of the theory.
struct Drawn {
  double zeta = 0.0;
  double r = 1.0;
  double friction = 0.2;      ///< kinetic force over the drive's largest force
  double static_ratio = 1.0;  ///< static over kinetic
};

void add(OscillatorBatch& batch, const Drawn& drawn, double mass = 1.0, double stiffness = 100.0,
         double amplitude = 0.1) {
  const double natural = std::sqrt(stiffness / mass);
  const double force = batch.type == ExcitationType::force_harmonic ? amplitude : stiffness * amplitude;
  batch.mass.push_back(mass);
  batch.stiffness.push_back(stiffness);
  batch.damping.push_back(2.0 * drawn.zeta * std::sqrt(mass * stiffness));
  batch.kinetic.push_back(drawn.friction * force);
  batch.static_level.push_back(drawn.static_ratio * drawn.friction * force);
  batch.amplitude.push_back(amplitude);
  batch.frequency.push_back(drawn.r * natural);
}

/// Any oscillator of the class, including sticking and near-resonant ones; `slippery`: most do not stick.
OscillatorBatch random_batch(std::uint64_t seed, int count, bool slippery,
                             ExcitationType type = ExcitationType::base_harmonic,
                             DamperTo damper_to = DamperTo::ground) {
  Random random(seed);
  OscillatorBatch batch;
  batch.type = type;
  batch.damper_to = damper_to;
  for (int i = 0; i < count; ++i) {
    Drawn drawn;
    drawn.zeta = random.chance(0.05) ? 0.0 : random.uniform(0.0, 0.95);
    drawn.r = slippery ? random.uniform(0.6, 1.6) : random.logarithmic(0.1, 10.0);
    drawn.friction = slippery ? random.logarithmic(1e-3, 0.3) : random.logarithmic(1e-3, 0.9);
    const double mass = random.logarithmic(0.1, 10.0);
    const double stiffness = random.logarithmic(10.0, 1e4);
    add(batch, drawn, mass, stiffness, random.logarithmic(0.01, 10.0));
  }
  return batch;
}

Model model_of(const OscillatorBatch& batch, std::size_t i) {
  Model model;
  model.oscillator = {.mass = batch.mass[i],
                      .stiffness = batch.stiffness[i],
                      .damping = batch.damping[i],
                      .damper_to = batch.damper_to};
  model.excitation = {.type = batch.type, .amplitude = batch.amplitude[i], .frequency = batch.frequency[i]};
  model.friction.emplace_back(dualdamp::friction::Coulomb(batch.kinetic[i], batch.static_level[i]));
  return model;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

double turns_apart(double a, double b) {
  const double gap = std::abs(a - b);
  return std::min(gap, std::abs(gap - 2.0 * std::numbers::pi));
}

}  // namespace

TEST_CASE("Batches give the same bits for every width and number of threads") {
  // Each orbit takes some fifteen arguments through exp, sincos and atan2: more than 1e5 of each are compared here.
  // 10,007 is prime: the last pack is never full.
  const OscillatorBatch batch = random_batch(1, 10'007, true);
  const BatchSteadyStates reference = steady_states(batch, {.width = 1, .threads = 1});
  BatchMotions motions{.position = std::vector<double>(batch.size(), 0.0), .velocity = batch.amplitude};
  BatchMotions expected = motions;
  pass_periods(batch, 5, expected, {.width = 1, .threads = 1});
  for (const int width : batch_widths()) {
    for (const int threads : {1, 0}) {
      INFO("width " << width << ", threads " << threads);
      const BatchSteadyStates other = steady_states(batch, {.width = width, .threads = threads});
      CHECK(same_bits(other.peak, reference.peak));
      CHECK(same_bits(other.trough, reference.trough));
      CHECK(same_bits(other.lag, reference.lag));
      CHECK(same_bits(other.radius, reference.radius));
      CHECK(other.stops == reference.stops);
      CHECK(other.engine == reference.engine);
      BatchMotions here = motions;
      pass_periods(batch, 5, here, {.width = width, .threads = threads});
      CHECK(same_bits(here.position, expected.position));
      CHECK(same_bits(here.velocity, expected.velocity));
      CHECK(same_bits(here.amplitude, expected.amplitude));
      CHECK(here.reversals == expected.reversals);
      CHECK(here.engine == expected.engine);
    }
  }
  // So that the comparison is one of packs, not of the engine with itself.
  CHECK(std::count(reference.engine.begin(), reference.engine.end(), 0) > 9'000);
  CHECK(std::count(expected.engine.begin(), expected.engine.end(), 0) > 9'000);
}

TEST_CASE("Steady states of batches are those of the exact engine") {
  const auto compare = [](const OscillatorBatch& batch) {
    const BatchSteadyStates states = steady_states(batch);
    int in_packs = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const SteadyState state = steady_state(model_of(batch, i));
      INFO("zeta " << batch.damping[i] / (2.0 * std::sqrt(batch.mass[i] * batch.stiffness[i])) << " r "
                   << batch.frequency[i] / std::sqrt(batch.stiffness[i] / batch.mass[i]));
      REQUIRE(states.outcome[i] == state.outcome.kind);
      if (!state.outcome.ok()) continue;
      // Both close to 1e-14 of the amplitude; 1/(1 - multiplier) amplifies that, 2.5 % apart from resonance.
      CHECK(states.peak[i] == Approx(state.peak).epsilon(1e-13));
      CHECK(states.trough[i] == Approx(state.trough).epsilon(1e-13));
      CHECK(turns_apart(states.lag[i], state.phase) < 1e-12);
      CHECK(states.stops[i] == state.stops_per_cycle);
      double radius = 0.0;
      for (const std::complex<double>& value : state.multipliers) radius = std::max(radius, std::abs(value));
      CHECK(std::abs(states.radius[i] - radius) < 1e-12);
      if (states.engine[i] != 0) continue;
      ++in_packs;
      CHECK(state.sticks.empty());
    }
    CHECK(in_packs > static_cast<int>(batch.size()) / 10);
  };
  compare(random_batch(2, 200, false));
  compare(random_batch(3, 200, true, ExcitationType::base_harmonic, DamperTo::base));
  compare(random_batch(4, 200, true, ExcitationType::force_harmonic));
}

TEST_CASE("Orbits of batches are Den Hartog's, and where he has none the engine is asked") {
  Random random(5);
  OscillatorBatch batch;
  std::vector<double> ratios;  // amplitude over x_f
  for (int i = 0; i < 4000; ++i) {
    const double zeta = random.uniform(0.0, 0.9);
    const double r = random.logarithmic(0.3, 5.0);
    const auto functions = analytic::den_hartog(zeta, r);
    const double limit = analytic::non_sticking_boundary(functions);
    // Up to 1e-6 beside the boundary, on both sides.
    const double beside = random.logarithmic(1e-6, 0.5);
    const double friction = limit * (random.chance(0.1) ? 1.0 + beside : 1.0 - beside);
    const double lag = functions.H * functions.H;
    ratios.push_back(friction < limit ? std::sqrt(1.0 / std::pow(functions.q * friction, 2) - lag) - functions.G
                                      : 0.0);
    add(batch, {.zeta = zeta, .r = r, .friction = friction});
  }
  const BatchSteadyStates states = steady_states(batch);
  long skipped = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (ratios[i] == 0.0) {
      CHECK(states.engine[i] == 1);  // it sticks
      continue;
    }
    skipped += states.engine[i];
    if (states.outcome[i] != OutcomeKind::done) continue;
    // The formula itself loses digits where G and a small amplitude cancel, and near resonance in q.
    const double x_f = batch.kinetic[i] / batch.stiffness[i];
    INFO("zeta " << batch.damping[i] / 20.0 << " r " << batch.frequency[i] / 10.0 << " ratio " << ratios[i]);
    CHECK(std::abs(states.peak[i] - ratios[i] * x_f) < 1e-12 * states.peak[i]);
  }
  // Cases for the engine: close to the boundary or to undamped resonance.
  CHECK(skipped < 200);
}

TEST_CASE("The standard case in a batch has Den Hartog's amplitude to the last bits") {
  OscillatorBatch batch;
  add(batch, {.zeta = 0.2, .r = 1.0, .friction = 0.2});
  const BatchSteadyStates states = steady_states(batch);
  CHECK(states.engine[0] == 0);
  CHECK(std::abs(states.peak[0] / 0.186078097956786198557 - 1.0) < 1e-15);
  CHECK(states.trough[0] == -states.peak[0]);
}

TEST_CASE("Motions of batches are those of the exact engine, transients included") {
  Random random(6);
  OscillatorBatch batch;
  BatchMotions motions;
  for (int i = 0; i < 1500; ++i) {
    add(batch, {.zeta = random.uniform(0.0, 0.9),
                .r = random.logarithmic(0.2, 5.0),
                .friction = random.logarithmic(1e-3, 0.3),
                .static_ratio = random.chance(0.3) ? random.uniform(1.0, 1.5) : 1.0});
    motions.position.push_back(random.uniform(-0.3, 0.3));
    motions.velocity.push_back(random.uniform(-3.0, 3.0));
  }
  const BatchMotions starts = motions;
  constexpr int periods = 6;
  pass_periods(batch, periods, motions);
  int in_packs = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (motions.engine[i] != 0) continue;
    ++in_packs;
    ExactEngine engine(model_of(batch, i));
    engine.start(starts.position[i], starts.velocity[i]);
    long reversals = 0;
    double size = 0.0;
    double turning = 0.0;
    double amplitude = 0.0;
    while (engine.periods_passed() < periods) {
      const Interval* interval = engine.next_in_period();
      REQUIRE(interval != nullptr);
      CHECK(interval->ending != EventKind::stop);
      size = std::max(size, std::abs(engine.position()));
      if (interval->ending != EventKind::reversal) continue;
      amplitude = 0.5 * std::abs(engine.position() - turning);
      turning = engine.position();
      ++reversals;
    }
    INFO("zeta " << batch.damping[i] / 20.0 << " r " << batch.frequency[i] / 10.0);
    CHECK(motions.reversals[i] == reversals);
    // The motion contracts in the energy norm, so that errors of reversals do not grow.
    CHECK(std::abs(motions.position[i] - engine.position()) < 1e-13 * size);
    CHECK(std::abs(motions.velocity[i] - engine.velocity()) < 1e-13 * size * std::max(10.0, batch.frequency[i]));
    CHECK(std::abs(motions.amplitude[i] - amplitude) < 1e-13 * size);
  }
  CHECK(in_packs > 750);
}

TEST_CASE("What packs cannot certify goes to the exact engine") {
  OscillatorBatch batch;
  add(batch, {.zeta = 0.2, .r = 1.0, .friction = 0.2, .static_ratio = 1.1});  // other orbits may exist
  add(batch, {.zeta = 0.2, .r = 0.2, .friction = 0.8});                       // sticks
  add(batch, {.zeta = 0.2, .r = 1.0, .friction = 1.5});                       // never moves
  add(batch, {.zeta = 1.0, .r = 1.0, .friction = 0.2});                       // critically damped
  add(batch, {.zeta = 1.7, .r = 1.0, .friction = 0.2});                       // overdamped
  add(batch, {.zeta = 1e-4, .r = 1.0, .friction = 0.85});                     // near undamped resonance
  add(batch, {.zeta = 0.0, .r = 0.5, .friction = 0.1});                       // a continuum of orbits
  add(batch, {.zeta = 0.0, .r = 1.0, .friction = 0.5});                       // grows without bound
  const BatchSteadyStates states = steady_states(batch);
  CHECK(std::count(states.engine.begin(), states.engine.end(), 1) == static_cast<long>(batch.size()));
  CHECK(states.stops[1] > 0);
  CHECK(states.peak[2] == 0.0);
  CHECK(states.outcome[7] == OutcomeKind::no_steady_state);
}

namespace {

// Coulomb friction that is not in the registry, and similar laws that are not Coulomb friction.
struct OtherCoulomb {
  static Affine affine_force(const Memory&, const Instant&, Direction direction) {
    return {.constant = 2.0 * friction::sign(direction)};
  }
  static Affine affine_limit(const Memory&, const Instant&) { return {.constant = 3.0}; }
};

struct Viscous {
  static Affine affine_force(const Memory&, const Instant&, Direction) { return {.velocity = 2.0}; }
};

struct OneWay {
  static Affine affine_force(const Memory&, const Instant&, Direction direction) {
    return {.constant = direction == Direction::forward ? 2.0 : -1.0};
  }
  static Affine affine_limit(const Memory&, const Instant&) { return {.constant = 2.0}; }
};

struct NeverHolds {
  static Affine affine_force(const Memory&, const Instant&, Direction direction) {
    return {.constant = 2.0 * friction::sign(direction)};
  }
};

const friction::Coulomb plain_coulomb(1.0, 1.5);

/// A driven oscillator with these laws.
template <class... Laws>
Model driven_with(const Laws&... laws) {
  Model model;
  model.oscillator = {.mass = 2.0, .stiffness = 50.0, .damping = 1.0, .damper_to = DamperTo::base};
  model.excitation = {.type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 7.0, .phase = 1.0};
  (model.friction.emplace_back(laws), ...);
  return model;
}

}  // namespace

TEST_CASE("A law that does what Coulomb's does is for batches, whatever its name") {
  const std::optional<OscillatorBatch> batch = batch_of(driven_with(plain_coulomb, OtherCoulomb{}), 3);
  REQUIRE(batch.has_value());
  CHECK(batch->size() == 3);
  CHECK(batch->type == ExcitationType::base_harmonic);
  CHECK(batch->damper_to == DamperTo::base);
  CHECK(batch->mass == std::vector<double>(3, 2.0));
  CHECK(batch->stiffness == std::vector<double>(3, 50.0));
  CHECK(batch->damping == std::vector<double>(3, 1.0));
  CHECK(batch->kinetic == std::vector<double>(3, 3.0));
  CHECK(batch->static_level == std::vector<double>(3, 4.5));
  CHECK(batch->amplitude == std::vector<double>(3, 0.1));
  CHECK(batch->frequency == std::vector<double>(3, 7.0));
}

TEST_CASE("A law that does something else is not for batches") {
  CHECK_FALSE(batch_of(driven_with(Viscous{}), 1));
  CHECK_FALSE(batch_of(driven_with(OneWay{}), 1));
  CHECK_FALSE(batch_of(driven_with(NeverHolds{}), 1));
  CHECK_FALSE(batch_of(driven_with(friction::ContactCompliance(1.0, 1.0, 1e4, 0.0)), 1));
  CHECK_FALSE(batch_of(driven_with(plain_coulomb, friction::ContactCompliance(1.0, 1.0, 1e4, 0.0)), 1));
  for (const char* modifier : {"drift", "position_slope"})
    CHECK_FALSE(
        batch_of(driven_with(friction::modified(friction::Law(plain_coulomb), {{modifier, 0.1}}, {1.0, 1.5})), 1));
}

TEST_CASE("Batches are for plain springs and for drives of one harmonic without offset") {
  Model distorted = driven_with(plain_coulomb);
  distorted.excitation.harmonics = {{.order = 3, .amplitude = 0.01}};
  CHECK_FALSE(batch_of(distorted, 1));
  Model hardening = driven_with(plain_coulomb);
  hardening.oscillator.cubic_stiffness = 1.0;
  CHECK_FALSE(batch_of(hardening, 1));
  Model pushed = driven_with(plain_coulomb);
  pushed.excitation.type = ExcitationType::force_harmonic;
  CHECK(batch_of(pushed, 1));
  pushed.excitation.offset = 0.5;
  CHECK_FALSE(batch_of(pushed, 1));
  Model free = driven_with(plain_coulomb);
  free.excitation.type = ExcitationType::none;
  CHECK_FALSE(batch_of(free, 1));
}

TEST_CASE("Packs leave out an orbit whose neighbours are steady within 1e-6, as the engine does") {
  // Undamped at r = 1/2 every Floquet multiplier is 1 (a continuum of orbits); near it their distance from the
  // circle is proportional to c.
  OscillatorBatch batch;
  for (const double zeta : {1e-9, 1e-8, 1e-5}) add(batch, {.zeta = zeta, .r = 0.5, .friction = 0.1});
  const auto orbits = sliding_orbits(batch);
  CHECK_FALSE(orbits[0]);
  CHECK_FALSE(orbits[1]);
  REQUIRE(orbits[2]);
  CHECK(orbits[2]->radius < 1.0 - 1e-6);
  CHECK(orbits[2]->radius > 1.0 - 1e-3);
}

TEST_CASE("An empty batch has no steady states") {
  CHECK(steady_states(OscillatorBatch{}).peak.empty());
  BatchMotions motions;
  pass_periods(OscillatorBatch{}, 3, motions);
  CHECK(motions.position.empty());
}
