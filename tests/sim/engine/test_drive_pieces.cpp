#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "core/random.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/engine/drive_pieces.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using sim::ExcitationType;
using sim::Interpolation;
using sim::Model;
using sim::SampledSignal;
using test::pi;

namespace {

/// Evenly spaced samples of A cos(w t + phase).
std::shared_ptr<const SampledSignal> sampled_cosine(double amplitude, double omega, double phase, double h,
                                                    int count, Interpolation interpolation) {
  std::vector<double> t;
  std::vector<double> y;
  for (int i = 0; i <= count; ++i) {
    t.push_back(i * h);
    y.push_back(amplitude * std::cos(omega * t.back() + phase));
  }
  return std::make_shared<SampledSignal>(std::move(t), std::move(y), interpolation);
}

Model standard_case() {
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  return model;
}

/// The standard case with its base motion sampled `per_period` times a period, for `periods` periods.
Model sampled_case(int per_period, int periods, Interpolation interpolation) {
  Model model = standard_case();
  model.excitation = {
      .type = ExcitationType::base_samples,
      .samples = sampled_cosine(0.1, 10.0, 0.0, 0.2 * pi / per_period, periods * per_period, interpolation)};
  return model;
}

/// Largest distance of two motions at common sample times.
double distance(const sim::History& a, const sim::History& b) {
  REQUIRE(a.outcome.ok());
  REQUIRE(b.outcome.ok());
  REQUIRE(a.samples.size() == b.samples.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    largest = std::max(largest, std::abs(a.samples[i].x - b.samples[i].x));
  return largest;
}

}  // namespace

TEST_CASE("a sampled drive gives the motion of the standard case to the interpolation's error", "[drive]") {
  // The error of the drive is of order 2 or 4 in the spacing, and the motion depends smoothly on it. At 64 samples
  // a period it is h^2/8 y'' = 1.2e-4 m and 5 h^4/384 y'''' = 1.2e-7 m, at resonance with zeta = 0.2 up to 2.5
  // times that.
  constexpr int periods = 6;
  const sim::SimulateOptions options{.duration = periods * 0.2 * pi * (1.0 - 1e-12), .sample_rate = 200.0};
  const sim::History exact = sim::simulate(standard_case(), options);
  struct Accuracy {
    Interpolation interpolation;
    double order;
    double largest;
  };
  for (const Accuracy& row :
       {Accuracy{Interpolation::linear, 2.0, 3e-4}, Accuracy{Interpolation::cubic, 4.0, 3e-7}}) {
    double before = 0.0;
    for (const int per_period : {32, 64, 128, 256}) {
      const double error =
          distance(exact, sim::simulate(sampled_case(per_period, periods, row.interpolation), options));
      INFO(per_period << " samples a period, order " << row.order << ": error " << error);
      if (per_period == 64) CHECK(error < row.largest);
      if (before > 0.0) CHECK(std::abs(std::log2(before / error) - row.order) < 0.25);
      before = error;
    }
  }
}

TEST_CASE("a drive that begins late moves a mass at rest that no law holds", "[drive]") {
  for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear})
    for (const friction::Law& law :
         {test::law("contact_compliance", {{"kinetic", 5.0}, {"contact_stiffness", 1000.0}}),
          test::law("contact_compliance", {{"kinetic", 0.5}, {"contact_stiffness", 1000.0}})}) {
      Model model;
      model.oscillator = {.mass = 2.0, .stiffness = 800.0, .damping = 3.0};
      model.friction = {law};
      model.excitation = {
          .type = ExcitationType::force_samples,
          .samples = std::make_shared<SampledSignal>(std::vector<double>{0.0, 0.25, 0.5, 1.0},
                                                     std::vector<double>{0.0, 0.0, 50.0, 50.0}, interpolation)};
      const sim::History exact = sim::simulate(model, {.duration = 1.0, .sample_rate = 50.0});
      CHECK(exact.final.x > 0.03);
      model.solver.kind = sim::SolverKind::implicit_steps;
      CHECK(distance(exact, sim::simulate(model, {.duration = 1.0, .sample_rate = 50.0})) < 1e-7);
    }
}

TEST_CASE("a noise and the same nodes given as samples make the same motion", "[drive]") {
  for (const bool base : {true, false}) {
    Model noise;
    noise.oscillator = {.mass = 1.3, .stiffness = 120.0, .damping = 0.9, .damper_to = sim::DamperTo::base};
    noise.friction.emplace_back(friction::Coulomb(0.8, 1.0));
    noise.excitation = {.type = base ? ExcitationType::base_noise : ExcitationType::force_noise,
                        .noise = {.intensity = base ? 4e-5 : 0.3, .bandwidth = 60.0, .seed = 4}};
    const sim::Noise& given = noise.excitation.noise;
    const core::RandomStream draws{.seed = given.seed, .stream = sim::noise_stream};
    std::vector<double> t;
    std::vector<double> y;
    for (int n = 0; n <= 400; ++n) {
      t.push_back(n * given.spacing());
      y.push_back(std::sqrt(given.intensity / given.spacing()) * draws.normal(static_cast<std::uint64_t>(n)));
    }
    Model sampled = noise;
    sampled.excitation = {.type = base ? ExcitationType::base_samples : ExcitationType::force_samples,
                          .samples = std::make_shared<SampledSignal>(t, y, Interpolation::linear)};
    const sim::SimulateOptions options{.duration = 0.999 * t.back()};
    const sim::History a = sim::simulate(noise, options);
    const sim::History b = sim::simulate(sampled, options);
    REQUIRE(a.events.size() == b.events.size());
    REQUIRE(a.events.size() > 20);
    // Spacings of the nodes differ from h by the rounding of n h: 400 eps of it.
    CHECK(std::abs(a.final.x - b.final.x) < 1e-12 * 400 * std::abs(a.final.x));
    CHECK(std::abs(a.energy.input - b.energy.input) < 1e-9 * std::abs(a.energy.input));
  }
}

TEST_CASE("both engines follow sampled drives alike", "[drive]") {
  test::Random random(31);
  for (int round = 0; round < 24; ++round) {
    const Interpolation interpolation = round % 3 == 0   ? Interpolation::step
                                        : round % 3 == 1 ? Interpolation::linear
                                                         : Interpolation::cubic;
    Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = random.uniform(0.2, 3.0)};
    const bool base = random.chance(0.5);
    if (interpolation != Interpolation::step && random.chance(0.5))
      model.oscillator.damper_to = sim::DamperTo::base;
    std::vector<double> t{0.0};
    std::vector<double> y{0.0};
    while (t.back() < 6.0) {
      t.push_back(t.back() + random.uniform(0.02, 0.3));
      y.push_back(random.uniform(-1.0, 1.0) * (base ? 0.05 : 5.0));
    }
    const bool repeats = interpolation == Interpolation::step && random.chance(0.5);
    model.excitation = {.type = base ? ExcitationType::base_samples : ExcitationType::force_samples,
                        .samples = std::make_shared<SampledSignal>(t, y, interpolation, repeats)};
    model.friction.emplace_back(friction::Coulomb(0.8, 1.0));
    const sim::SimulateOptions options{.duration = 9.0};
    const sim::History exact = sim::simulate(model, options);
    model.solver.kind = sim::SolverKind::explicit_steps;
    const sim::History smooth = sim::simulate(model, options);
    INFO("round " << round);
    REQUIRE(exact.outcome.ok());
    REQUIRE(smooth.outcome.ok());
    CHECK(exact.events.size() > 5);
    CHECK(std::abs(exact.energy.defect) < 1e-11 * (exact.energy.friction + exact.energy.viscous));
    CHECK(std::abs(exact.final.x - smooth.final.x) < 1e-8);
    REQUIRE(exact.events.size() == smooth.events.size());
    for (std::size_t i = 0; i < exact.events.size(); ++i)
      CHECK(std::abs(exact.events[i].t - smooth.events[i].t) < 1e-7);
  }
}

TEST_CASE("motions under samples follow brute-force integration event by event", "[drive]") {
  test::Random random(52);
  std::size_t compared = 0;
  for (int round = 0; round < 40; ++round) {
    const double wn = random.logarithmic(2.0, 20.0);
    Model model;
    model.oscillator = {.mass = 1.0, .stiffness = wn * wn, .damping = 2.0 * wn * random.logarithmic(0.01, 1.5)};
    const bool base = random.chance(0.5);
    const bool steps = random.chance(0.3);
    if (!steps && random.chance(0.5)) model.oscillator.damper_to = sim::DamperTo::base;
    std::vector<double> t{0.0};
    std::vector<double> y{0.0};
    const double size = base ? 0.1 : 0.1 * wn * wn;
    while (t.back() < 40.0 / wn) {
      t.push_back(t.back() + random.uniform(0.1, 2.0) / wn);
      y.push_back(random.uniform(-1.0, 1.0) * size);
    }
    model.excitation = {
        .type = base ? ExcitationType::base_samples : ExcitationType::force_samples,
        .samples = std::make_shared<SampledSignal>(t, y, steps ? Interpolation::step : Interpolation::linear)};
    const double kinetic = 0.1 * wn * wn * random.logarithmic(0.02, 0.5);
    const double static_level = kinetic * random.uniform(1.0, 1.5);
    model.friction.emplace_back(friction::Coulomb(kinetic, static_level));
    const double duration = 45.0 / wn;
    test::PlainFriction plain;
    plain.add_coulomb(kinetic, static_level);
    const test::BruteForce expected = test::follow(model, plain, duration);
    const sim::History found = sim::simulate(model, {.duration = duration});
    INFO("round " << round << (base ? " base" : " force") << (steps ? " steps" : ""));
    REQUIRE(found.outcome.ok());
    bool alike = true;
    for (std::size_t i = 0; i < std::min(found.events.size(), expected.events.size()) && alike; ++i) {
      alike = found.events[i].kind == expected.events[i].kind &&
              std::abs(found.events[i].t - expected.events[i].t) < 1e-8 / wn;
      // Two events within one step of the integration may be missed there; nothing else may differ.
      const bool close = i + 1 < found.events.size() && found.events[i + 1].t - found.events[i].t < 0.02 / wn;
      if (!alike && close) break;
      CHECK(alike);
      ++compared;
    }
    if (alike) {
      CHECK(found.events.size() == expected.events.size());
      CHECK(std::abs(found.final.x - expected.x) < 1e-9);
    }
  }
  CHECK(compared > 300);
}

TEST_CASE("a chirp is within 1e-9 of its formula, whatever its sweep", "[drive]") {
  for (const sim::ChirpLaw law : {sim::ChirpLaw::linear, sim::ChirpLaw::exponential}) {
    for (const auto& [from, to, duration] :
         {std::array{2.0, 200.0, 10.0}, std::array{200.0, 2.0, 3.0}, std::array{30.0, 30.0, 1.0},
          std::array{0.5, 300.0, 0.4}, std::array{300.0, 0.5, 0.4}}) {
      const sim::Excitation excitation{.type = ExcitationType::base_chirp,
                                       .amplitude = 1.0,
                                       .phase = 0.3,
                                       .chirp = {.from = from, .to = to, .duration = duration, .law = law}};
      const double growth = std::log(to / from) / duration;
      const auto exact = [&](double t) {
        const double turned = law == sim::ChirpLaw::linear ? from * t + 0.5 * (to - from) / duration * t * t
                              : growth == 0.0              ? from * t
                                                           : from * std::expm1(growth * t) / growth;
        return std::cos(0.3 + turned);
      };
      const auto pieces = sim::make_pieces(excitation);
      double worst = 0.0;
      double t = 0.0;
      for (long n = 0; t < duration; ++n) {
        const sim::PolynomialPiece piece = pieces->piece(n);
        if (!std::isfinite(piece.duration)) break;
        t = pieces->begin(n);
        for (const double part : {0.0, 0.25, 0.5, 0.75}) {
          const double s = part * piece.duration;
          const auto& d = piece.derivatives;
          const double y = d[0] + s * (d[1] + s * (d[2] / 2.0 + s * d[3] / 6.0));
          worst = std::max(worst, std::abs(y - exact(t + s)));
        }
        t += piece.duration;
      }
      INFO("from " << from << " to " << to << " within " << duration);
      CHECK(std::abs(t - duration) < 1e-9 * duration);
      CHECK(worst < 1.02e-9);
    }
  }
}

TEST_CASE("a drive that has ended keeps its last value", "[drive]") {
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 5.0};
  model.excitation = {.type = ExcitationType::force_samples,
                      .samples = std::make_shared<SampledSignal>(
                          std::vector{0.0, 0.5, 1.0}, std::vector{0.0, 7.0, 3.0}, Interpolation::linear)};
  const sim::History history = sim::simulate(model, {.duration = 20.0, .sample_rate = 1.0});
  // exp(-2.5 * 19) of the transient is left.
  CHECK(std::abs(history.final.x - 0.03) < 1e-15);
  CHECK(history.samples.at(7).external == 3.0);
}

TEST_CASE("a base that jumps does work on the spring", "[drive]") {
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 5.0};
  model.excitation = {.type = ExcitationType::base_samples,
                      .samples = std::make_shared<SampledSignal>(std::vector{0.0, 10.0, 20.0},
                                                                 std::vector{0.0, 0.1, 0.1}, Interpolation::step)};
  const sim::History history = sim::simulate(model, {.duration = 20.0});
  // k y^2/2 at the jump; all of it goes into the damper.
  CHECK(history.energy.input == Approx(0.5).epsilon(1e-13));
  CHECK(history.energy.viscous == Approx(0.5).epsilon(1e-9));
  CHECK(std::abs(history.energy.defect) < 1e-14);
  // With the damper between them there is no such motion.
  model.oscillator.damper_to = sim::DamperTo::base;
  CHECK_THROWS_WITH(sim::simulate(model, {.duration = 1.0}), Catch::Contains("infinite force"));
}

TEST_CASE("a law with modes sees no switching that pieces of a drive only seem to make", "[drive]") {
  // Pieces of a fast chirp: the coefficients of s^2 and s^3 are 1e6 and 1e11 times the motion, which must not count
  // as rounding of the motion at s = 0.
  Model model;
  model.oscillator = {.mass = 0.01, .stiffness = 8800.0, .damping = 6e-4};
  model.excitation = {.type = ExcitationType::base_chirp,
                      .amplitude = 0.04,
                      .phase = 5.6,
                      .chirp = {.from = 3750.0, .to = 630.0, .duration = 0.0105}};
  model.initial = {.position = -0.048, .velocity = 0.0};
  for (const auto& friction :
       {test::law("bristle", {{"stiffness", 330.0}, {"snap_distance", 0.0157}, {"count", 1.0}, {"seed", 246.0}}),
        test::law("contact_compliance", {{"kinetic", 20.0}, {"contact_stiffness", 2000.0}}),
        test::law("contact_compliance", {{"kinetic", 20.0}, {"static", 25.0}, {"contact_stiffness", 2000.0}})}) {
    model.friction = {friction};
    model.solver = {};
    const sim::SimulateOptions options{.duration = 0.02};
    const sim::History exact = sim::simulate(model, options);
    model.solver = {sim::SolverKind::explicit_steps, 1e-13};
    const sim::History smooth = sim::simulate(model, options);
    REQUIRE(exact.outcome.ok());
    REQUIRE(smooth.outcome.ok());
    CHECK(exact.events.size() > 5);
    REQUIRE(exact.events.size() == smooth.events.size());
    for (std::size_t i = 0; i < exact.events.size(); ++i) {
      CHECK(exact.events[i].kind == smooth.events[i].kind);
      CHECK(std::abs(exact.events[i].t - smooth.events[i].t) < 1e-9);
    }
  }
}

TEST_CASE("the energy account under a cubic drive holds where the mass only creeps", "[drive]") {
  // The damper of 2e6 N s/m decides the motion: x' = k (y - x)/c, whose square is of degree six in time; the only
  // slow rate is k/c = 0.05/s.
  Model model;
  model.oscillator = {.mass = 0.93, .stiffness = 1e5, .damping = 2e6};
  std::vector<double> t{0.0};
  std::vector<double> y{0.0};
  test::Random random(7);
  while (t.back() < 0.04) {
    t.push_back(t.back() + random.uniform(2e-4, 2e-3));
    y.push_back(random.uniform(-0.025, 0.025));
  }
  model.excitation = {.type = ExcitationType::base_samples,
                      .samples = std::make_shared<SampledSignal>(t, y, Interpolation::cubic)};
  model.friction.emplace_back(friction::Coulomb(1e-3, 1e-3));
  const sim::SimulateOptions options{.duration = t.back()};
  const sim::History exact = sim::simulate(model, options);
  model.solver = {sim::SolverKind::implicit_steps, 1e-13};
  const sim::History smooth = sim::simulate(model, options);
  REQUIRE(exact.outcome.ok());
  REQUIRE(smooth.outcome.ok());
  CHECK(std::abs(exact.energy.defect) < 1e-10 * exact.energy.viscous);
  CHECK(exact.energy.viscous == Approx(smooth.energy.viscous).epsilon(1e-9));
  CHECK(exact.energy.input == Approx(smooth.energy.input).epsilon(1e-9));
}

TEST_CASE("sampled drive: a piece that sets a resting mass in motion releases it", "[sim][engine]") {
  // No law holds the mass here, so no guard lets it go: it rests while all forces on it cancel, up to a step of the
  // drive at 1 s. The motion was the same without the release in its list of events.
  Model model = standard_case();
  model.excitation = {.type = ExcitationType::base_samples,
                      .samples = std::make_shared<SampledSignal>(
                          std::vector{0.0, 0.5, 1.0, 1.5}, std::vector{0.0, 0.0, -0.1, 0.1}, Interpolation::step)};
  model.friction = {test::law("contact_compliance", {{"kinetic", 2.0}, {"contact_stiffness", 1e4}})};
  const sim::History history = sim::simulate(model, {.duration = 1.4});
  REQUIRE(history.outcome.ok());
  REQUIRE(history.events.size() > 1);
  CHECK(history.events.front().kind == sim::EventKind::release);
  CHECK(history.events.front().t == 1.0);
  CHECK(history.events.front().x == 0.0);
  CHECK(history.final.x < 0.0);
  CHECK(std::ranges::count(history.events, sim::EventKind::release, &sim::Event::kind) == 1);
}
