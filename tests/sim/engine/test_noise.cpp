#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/random.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/engine/drive.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"

using namespace dualdamp;
using sim::ExcitationType;
using sim::Model;

namespace {

Model noisy(ExcitationType type, double intensity, double bandwidth, std::uint64_t seed) {
  Model model;
  model.oscillator = {.mass = 1.3, .stiffness = 120.0, .damping = 0.9};
  model.excitation = {.type = type, .noise = {.intensity = intensity, .bandwidth = bandwidth, .seed = seed}};
  return model;
}

/// The definition of the noise, independently of the code.
double node(const sim::Noise& noise, std::uint64_t n) {
  const core::RandomStream draws{.seed = noise.seed, .stream = sim::noise_stream};
  return std::sqrt(noise.intensity * noise.bandwidth / std::numbers::pi) * draws.normal(n);
}

struct Point {
  long double x = 0.0L;
  long double v = 0.0L;
};

/// x'' = (f + g s - c v - k x)/m over s = h by its Taylor series, in long double.
Point pass_cell(const sim::Oscillator& o, const Point& start, long double f, long double g, long double h) {
  constexpr int orders = 60;
  std::array<long double, orders> x{start.x, start.v};  // x^(n) h^n / n!
  x[1] *= h;
  Point end{x[0] + x[1], start.v};
  for (int n = 0; n + 2 < orders; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const long double drive = n == 0 ? f : (n == 1 ? g * h : 0.0L);
    const long double force = drive - o.stiffness * x[i] - o.damping * (n + 1) * x[i + 1] / h;
    x[i + 2] = force * h * h / (o.mass * (n + 1.0L) * (n + 2.0L));
    end.x += x[i + 2];
    end.v += (n + 2.0L) * x[i + 2] / h;
  }
  return end;
}

/// End of the motion of a linear oscillator from rest after so many whole cells.
Point linear_response(const Model& model, int cells) {
  const sim::Noise& noise = model.excitation.noise;
  const sim::Oscillator& o = model.oscillator;
  const bool base = model.excitation.type == ExcitationType::base_noise;
  const double h = noise.spacing();
  Point point;
  for (int n = 0; n < cells; ++n) {
    const auto number = static_cast<std::uint64_t>(n);
    const double value = node(noise, number);
    const double slope = (node(noise, number + 1) - value) / h;
    const double rate_force = base && o.damper_to == sim::DamperTo::base ? o.damping * slope : 0.0;
    const double gain = base ? o.stiffness : 1.0;
    point = pass_cell(o, point, gain * value + rate_force, gain * slope, h);
  }
  return point;
}

}  // namespace

TEST_CASE("a linear oscillator follows a noise as its Taylor series does", "[noise]") {
  // Rounding of 400 cells: 400 eps relative to the motion would be 1e-13.
  constexpr int cells = 400;
  for (const ExcitationType type : {ExcitationType::base_noise, ExcitationType::force_noise}) {
    for (const sim::DamperTo damper_to : {sim::DamperTo::ground, sim::DamperTo::base}) {
      Model model = noisy(type, type == ExcitationType::base_noise ? 1e-4 : 0.3, 60.0, 7);
      model.oscillator.damper_to = damper_to;
      const Point expected = linear_response(model, cells);
      const double duration = cells * model.excitation.noise.spacing();
      const sim::History history = sim::simulate(model, {.duration = duration});
      REQUIRE(history.outcome.ok());
      CHECK(std::abs(history.final.x - static_cast<double>(expected.x)) < 1e-13);
      CHECK(std::abs(history.final.v - static_cast<double>(expected.v)) < 1e-12);
      CHECK(std::abs(history.energy.defect) < 1e-12 * std::abs(history.energy.viscous));
    }
  }
}

TEST_CASE("nodes are no events, and stops anywhere change nothing", "[noise]") {
  Model model = noisy(ExcitationType::force_noise, 0.3, 50.0, 11);
  model.friction.emplace_back(friction::Coulomb(0.8, 1.0));
  const sim::History history = sim::simulate(model, {.duration = 20.0, .sample_rate = 37.0});
  REQUIRE(history.outcome.ok());
  REQUIRE(history.events.size() > 50);
  for (const sim::Event& event : history.events) CHECK(event.kind != sim::EventKind::switching);
  // A run that is interrupted at arbitrary times ends within the rounding of the interruptions.
  const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
  for (int i = 1; i <= 400; ++i) {
    while (engine->next(i * 0.05) != nullptr) {
    }
  }
  CHECK(std::abs(engine->position() - history.final.x) < 1e-11);
  CHECK(std::abs(engine->velocity() - history.final.v) < 1e-10);
  // What is sampled is the excitation of the definition.
  const sim::Noise& noise = model.excitation.noise;
  for (const sim::Sample& sample : history.samples) {
    const double part = sample.t / noise.spacing();
    const auto n = static_cast<std::uint64_t>(part);
    const double share = part - static_cast<double>(n);
    const double expected = (1.0 - share) * node(noise, n) + share * node(noise, n + 1);
    CHECK(std::abs(sample.external - expected) < 1e-10);
  }
}

TEST_CASE("both engines follow a noise alike", "[noise]") {
  // The smooth engine to its tolerance, amplified by a motion with stops and releases over 10 s.
  for (const sim::DamperTo damper_to : {sim::DamperTo::ground, sim::DamperTo::base}) {
    Model model = noisy(ExcitationType::base_noise, 4e-5, 40.0, 3);
    model.oscillator.damper_to = damper_to;
    model.friction.emplace_back(friction::Coulomb(0.8, 1.0));
    const sim::History exact = sim::simulate(model, {.duration = 10.0});
    model.solver.kind = sim::SolverKind::explicit_steps;
    const sim::History smooth = sim::simulate(model, {.duration = 10.0});
    REQUIRE(exact.outcome.ok());
    REQUIRE(smooth.outcome.ok());
    REQUIRE(exact.events.size() == smooth.events.size());
    for (std::size_t i = 0; i < exact.events.size(); ++i) {
      CHECK(exact.events[i].kind == smooth.events[i].kind);
      CHECK(std::abs(exact.events[i].t - smooth.events[i].t) < 1e-8);
    }
    CHECK(std::abs(exact.final.x - smooth.final.x) < 1e-9);
  }
}

TEST_CASE("the spectral density of a noise is its intensity times sinc^4", "[noise]") {
  // Mean of `blocks` periodograms of one frequency, each exponentially distributed: its relative deviation is
  // 1/sqrt(blocks) = 1.6 %; an error of 5 % has a probability of a fifth of a percent.
  constexpr int blocks = 4000;
  constexpr int cells = 64;
  const Model model = noisy(ExcitationType::force_noise, 2.5, 50.0, 5);
  const sim::Noise& noise = model.excitation.noise;
  sim::Drive drive(model.oscillator, model.excitation);
  const double h = noise.spacing();
  for (const int harmonic : {0, 4, 16, 32}) {
    const double omega = 2.0 * std::numbers::pi * harmonic / (cells * h);
    long entered = 0;
    double power = 0.0;
    for (int block = 0; block < blocks; ++block) {
      std::complex<double> transform = 0.0;
      for (int cell = 0; cell < cells; ++cell) {
        drive.enter(entered++);
        // Six panels of Simpson's rule a cell: error (w h / 12)^4/180 < 1e-4 at the highest frequency.
        constexpr int points = 12;
        for (int i = 0; i <= points; ++i) {
          const double weight = i == 0 || i == points ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
          const double s = h * i / points;
          transform +=
              weight * h / (3.0 * points) * drive.at(s).external * std::polar(1.0, -omega * (cell * h + s));
        }
      }
      power += std::norm(transform) / (cells * h);
    }
    const double half = 0.5 * omega * h;
    const double sinc = half > 0.0 ? std::sin(half) / half : 1.0;
    CHECK(std::abs(power / blocks / (noise.intensity * std::pow(sinc, 4)) - 1.0) < (harmonic == 0 ? 0.08 : 0.055));
  }
}

TEST_CASE("white noise feeds an oscillator D/(2 m) of power, whatever the friction", "[noise]") {
  // (identification.md c.5 with D of a force.) The noise is white to 0.2 % at wn = wb/38; the energy of the motion
  // is correlated over about 1/(2 zeta wn) = 1 s, so 6,000 s contain some 6,000 independent values. If they are
  // exponentially distributed, their mean has a deviation of 1.8 %.
  Model model = noisy(ExcitationType::force_noise, 2.0, 380.0, 19);
  model.friction.emplace_back(friction::Coulomb(0.15, 0.15));
  const double duration = 6000.0;
  const sim::History history = sim::simulate(model, {.duration = duration});
  REQUIRE(history.outcome.ok());
  const double expected = 0.5 * 2.0 / 1.3 * duration;
  CHECK(std::abs(history.energy.input / expected - 1.0) < 0.055);
  CHECK(history.energy.friction > 0.1 * history.energy.input);
  CHECK(std::abs(history.energy.defect) < 1e-9 * history.energy.input);
}
