#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/engine/closed_form.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/observers.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp::sim;
using dualdamp::core::Complex;
using dualdamp::core::ExponentialBasis;
using dualdamp::test::Random;

namespace {

/// An interval without its closed form, so that observers use quadrature and bisection.
class Sampled final : public Interval {
 public:
  explicit Sampled(const Interval& inner) : inner_(inner) {
    begin = inner.begin;
    duration = inner.duration;
    direction = inner.direction;
    ending = inner.ending;
  }
  [[nodiscard]] Sample at(double s) const override { return inner_.at(s); }
  [[nodiscard]] double resolution(double s) const override { return inner_.resolution(s); }

 private:
  const Interval& inner_;
};

struct Account {
  PeakAndTrough extremes;
  EnergyAudit energy;
  Fundamental fundamental;

  explicit Account(const Model& model) : energy(model.oscillator), fundamental(model.excitation.frequency) {}
  void observe(const Interval& interval) {
    extremes.observe(interval);
    energy.observe(interval);
    fundamental.observe(interval);
  }
};

Model random_model(Random& random) {
  Model model;
  const double damping = random.chance(0.2) ? 0.0 : random.logarithmic(0.01, 30.0);
  model.oscillator = {.mass = random.logarithmic(0.2, 5.0),
                      .stiffness = random.logarithmic(20.0, 500.0),
                      .damping = damping,
                      .damper_to = random.chance(0.5) ? DamperTo::base : DamperTo::ground};
  Excitation& drive = model.excitation;
  drive.type = random.chance(0.5) ? ExcitationType::base_harmonic : ExcitationType::force_harmonic;
  drive.amplitude = drive.type == ExcitationType::base_harmonic ? 0.1 : 10.0;
  drive.frequency = random.logarithmic(1.0, 60.0);
  drive.phase = random.angle();
  if (drive.type == ExcitationType::force_harmonic) drive.offset = random.uniform(-1.0, 1.0);
  if (random.chance(0.5)) drive.harmonics = {{3, 0.3 * drive.amplitude, random.angle()}};
  const double kinetic = random.logarithmic(0.05, 5.0);
  const double at_rest = kinetic * random.uniform(1.0, 1.5);
  if (random.chance(0.5)) {
    model.friction.emplace_back(dualdamp::friction::Coulomb(kinetic, at_rest));
  } else {
    // Its force relaxes by a separate exponential while the contact slips.
    const double stiffness = random.logarithmic(100.0, 1e4);
    const double contact_damping = random.logarithmic(1.0, 30.0);
    model.friction.emplace_back(
        dualdamp::friction::ContactCompliance(kinetic, at_rest, stiffness, contact_damping));
  }
  model.initial = {random.uniform(-0.3, 0.3), random.uniform(-2.0, 2.0)};
  return model;
}

}  // namespace

TEST_CASE("Accounts in closed form are those of quadrature") {
  Random random(1);
  int closed = 0;
  for (int i = 0; i < 150; ++i) {
    const Model model = random_model(random);
    ExactEngine engine(model);
    Account account(model);
    Account reference(model);
    while (engine.periods_passed() < 2) {
      const Interval* interval = engine.next_in_period();
      REQUIRE(interval != nullptr);
      closed += interval->closed_form() != nullptr ? 1 : 0;
      account.observe(*interval);
      reference.observe(Sampled(*interval));
    }
    INFO("damping " << model.oscillator.damping << " frequency " << model.excitation.frequency);
    const Energy ours = account.energy.account();
    const Energy theirs = reference.energy.account();
    // A few dozen intervals, each exact to some roundings of its energies.
    const double scale = std::abs(theirs.input) + theirs.friction + theirs.viscous + std::abs(theirs.stored);
    CHECK(std::abs(ours.input - theirs.input) < 1e-14 * scale);
    CHECK(std::abs(ours.friction - theirs.friction) < 1e-14 * scale);
    CHECK(std::abs(ours.viscous - theirs.viscous) < 1e-14 * scale);
    CHECK(std::abs(ours.stored - theirs.stored) < 1e-14 * scale);
    CHECK(std::abs(ours.defect) < 1e-13 * scale);
    CHECK(account.extremes.max_speed() == Approx(reference.extremes.max_speed()).epsilon(1e-14));
    CHECK(account.extremes.peak() == Approx(reference.extremes.peak()).epsilon(1e-14));
    CHECK(account.extremes.trough() == Approx(reference.extremes.trough()).epsilon(1e-14));
    const double size = std::max(std::abs(reference.extremes.peak()), std::abs(reference.extremes.trough()));
    CHECK(std::abs(account.fundamental.coefficient() - reference.fundamental.coefficient()) < 1e-13 * size);
  }
  CHECK(closed > 500);
}

TEST_CASE("The largest speed under heavy damping is that of the fastest sample") {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    Model model = random_model(random);
    model.oscillator.damping = random.logarithmic(100.0, 2e4);
    ExactEngine engine(model);
    PeakAndTrough extremes;
    double fastest = 0.0;
    while (engine.periods_passed() < 2) {
      const Interval* interval = engine.next_in_period();
      REQUIRE(interval != nullptr);
      extremes.observe(*interval);
      for (int k = 0; k <= 400; ++k) {
        // Dense at the start too, where the free motion decays.
        const double part = k / 400.0;
        fastest = std::max({fastest, std::abs(interval->at(part * interval->duration).v),
                            std::abs(interval->at(std::pow(part, 4) * interval->duration).v)});
      }
    }
    INFO("damping " << model.oscillator.damping << " mass " << model.oscillator.mass);
    CHECK(extremes.max_speed() >= fastest * (1.0 - 1e-13));
    // A sample misses the maximum by the square of its distance.
    CHECK(extremes.max_speed() <= fastest * (1.0 + 1e-3));
  }
}

TEST_CASE("A free decay that turns no more says so") {
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 30.0};
  model.initial = {.position = 0.1};
  const FreeDecay decay = free_decay(model, 8);
  CHECK(decay.outcome.ok());
  CHECK(decay.extremes.size() == 1);
  CHECK(decay.creeps);
  CHECK_FALSE(decay.came_to_rest);
  model.oscillator.damping = 1.0;
  CHECK_FALSE(free_decay(model, 8).creeps);
}

TEST_CASE("Integrals of products of exponentials are exact for long and for short intervals") {
  for (const double duration : {1e-9, 1e-4, 0.1, 1.0, 7.0, 50.0}) {
    const double decay = 0.7;
    const double omega = 3.0;
    ExponentialBasis basis;
    const int flat = basis.add(0.0);
    const int fading = basis.add(-decay);
    const int turning = basis.add(Complex(0.0, omega));
    basis.finish();
    ClosedForm form;
    form.basis = &basis;
    form.duration = duration;
    basis.evaluate(duration, form.end);
    const auto element = [&](int k, Complex c) {
      dualdamp::core::ModeFunction f;
      dualdamp::core::clear(basis, f);
      f.re[static_cast<std::size_t>(k)] = c.real();
      f.im[static_cast<std::size_t>(k)] = c.imag();
      return f;
    };
    const auto one = element(flat, 1.0);
    const auto decaying = element(fading, 2.0);
    const auto cosine = element(turning, 1.0);
    const auto sine = element(turning, Complex(0.0, -1.0));
    const ClosedIntegrals integrals(form);
    INFO("duration " << duration);
    CHECK(integrals.product(one, one) == Approx(duration).epsilon(1e-15));
    CHECK(integrals.product(one, decaying) == Approx(-2.0 * std::expm1(-decay * duration) / decay).epsilon(1e-15));
    CHECK(integrals.product(decaying, decaying) ==
          Approx(-2.0 * std::expm1(-2.0 * decay * duration) / decay).epsilon(1e-15));
    // sin^2/(2 w) and T/2 + sin(2wT)/(4w); relative to the amplitudes.
    const double half_turn = std::sin(omega * duration);
    CHECK(std::abs(integrals.product(sine, cosine) - 0.5 * half_turn * half_turn / omega) < 1e-15 * duration);
    const double square = 0.5 * duration + std::sin(2.0 * omega * duration) / (4.0 * omega);
    CHECK(integrals.product(cosine, cosine) == Approx(square).epsilon(2e-15));
    CHECK(std::abs(integral_against_turn(form, cosine, omega) -
                   Complex(square, -0.5 * half_turn * half_turn / omega)) < 2e-15 * duration);
  }
}

TEST_CASE("The energy defect is a check of the forces, not zero by construction") {
  /// The interval with a friction force other than that of the motion.
  class Wrong final : public Interval {
   public:
    explicit Wrong(const Interval& inner) : form_(*inner.closed_form()) {
      begin = inner.begin;
      duration = inner.duration;
      direction = inner.direction;
      dualdamp::core::assign(*form_.basis, 1.0 + 1e-6, inner.closed_form()->force, form_.force);
    }
    [[nodiscard]] Sample at(double) const override { return {}; }
    [[nodiscard]] double resolution(double) const override { return duration; }
    [[nodiscard]] const ClosedForm* closed_form() const override { return &form_; }

   private:
    ClosedForm form_;
  };
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  model.excitation = {.type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  model.friction.emplace_back(dualdamp::friction::Coulomb(2.0, 2.0));
  model.initial = {0.1, 1.0};
  ExactEngine engine(model);
  EnergyAudit audit(model.oscillator);
  while (engine.periods_passed() < 3) audit.observe(Wrong(*engine.next_in_period()));
  const Energy energy = audit.account();
  CHECK(energy.friction > 1.0);
  CHECK(energy.defect == Approx(-1e-6 * energy.friction).epsilon(1e-5));
}

TEST_CASE("The largest speed and the fundamental of a linear response are those of theory") {
  for (const double frequency : {0.3, 4.0, 9.0, 40.0}) {
    Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
    model.excitation = {
        .type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = frequency, .phase = 0.4};
    const Complex response = 100.0 * std::polar(0.1, 0.4) / Complex(100.0 - frequency * frequency, 4.0 * frequency);
    model.initial = {response.real(), (response * Complex(0.0, frequency)).real()};
    ExactEngine engine(model);
    Account account(model);
    while (engine.periods_passed() < 1) account.observe(*engine.next_in_period());
    INFO("frequency " << frequency);
    CHECK(account.extremes.max_speed() == Approx(frequency * std::abs(response)).epsilon(1e-14));
    CHECK(std::abs(account.fundamental.coefficient() - response) < 1e-14 * std::abs(response));
  }
}

TEST_CASE("Integrals of products with chains of two exponents, equal, close and far apart") {
  for (const double apart : {0.0, 1e-14, 1e-7, 1e-2, 0.7, 400.0}) {
    for (const double duration : {1e-6, 0.3, 5.0}) {
      ExponentialBasis basis;
      const int constant = basis.add(0.0);
      const int slow = basis.add(-apart, constant);
      const int turning = basis.add(Complex(-0.2, 3.0));
      const int resonant = basis.add(Complex(-0.2 - 0.5 * apart, 3.0 + 1e-3 * apart), turning);
      basis.finish();
      REQUIRE(ClosedForm::covers(basis));
      ClosedForm form;
      form.basis = &basis;
      form.duration = duration;
      basis.evaluate(duration, form.end);
      const ClosedIntegrals integrals(form);
      const auto element = [&](int k) {
        dualdamp::core::ModeFunction f;
        dualdamp::core::clear(basis, f);
        f.re[static_cast<std::size_t>(k)] = 0.6;
        f.im[static_cast<std::size_t>(k)] = k > slow ? -0.8 : 0.0;
        return f;
      };
      const auto simpson = [&](const auto& g) {
        constexpr int parts = 20000;
        double sum = 0.0;
        for (int i = 0; i <= parts; ++i) {
          ExponentialBasis::Values values;
          basis.evaluate(duration * i / parts, values);
          sum += g(values, duration * i / parts) * (i == 0 || i == parts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
        }
        return sum * duration / (3.0 * parts);
      };
      for (const int j : {constant, slow, turning, resonant}) {
        const auto f = element(j);
        for (const int k : {slow, resonant}) {
          const auto g = element(k);
          const double scale = std::sqrt(integrals.product(f, f) * integrals.product(g, g));
          const double expected = simpson([&](const auto& values, double) {
            return dualdamp::core::evaluate(basis, f, values) * dualdamp::core::evaluate(basis, g, values);
          });
          CAPTURE(apart, duration, j, k);
          CHECK(std::abs(integrals.product(f, g) - expected) < 2e-9 * scale);
        }
        const Complex against = integral_against_turn(form, f, 2.0);
        const double real = simpson([&](const auto& values, double s) {
          return dualdamp::core::evaluate(basis, f, values) * std::cos(2.0 * s);
        });
        CHECK(std::abs(against.real() - real) < 2e-9 * std::sqrt(integrals.product(f, f) * duration));
      }
    }
  }
}

TEST_CASE("the first sample of a motion is its initial state to the last bit") {
  for (const double damping : {0.0, 4.0, 50.0})
    for (const auto& [x, v] : {std::pair{0.0, 0.0}, {0.3, 0.0}, {0.0, 0.7}, {0.013, -0.37}, {0.3, 5.0}})
      for (const SolverKind solver :
           {SolverKind::automatic, SolverKind::explicit_steps, SolverKind::implicit_steps})
        for (const bool with_friction : {false, true}) {
          Model model;
          model.oscillator = {.mass = 1.3, .stiffness = 100.0, .damping = damping};
          model.excitation = {
              .type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 7.0, .phase = 0.5};
          if (with_friction) model.friction.emplace_back(dualdamp::friction::Coulomb(2.0, 3.0));
          model.initial = {.position = x, .velocity = v};
          model.solver.kind = solver;
          const History history = simulate(model, {.duration = 0.1, .sample_rate = 20.0});
          CAPTURE(damping, x, v, static_cast<int>(solver), with_friction);
          REQUIRE(!history.samples.empty());
          CHECK(history.samples[0].x == x);
          CHECK(history.samples[0].v == v);
        }
}
