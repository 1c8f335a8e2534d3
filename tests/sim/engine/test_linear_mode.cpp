#include "sim/engine/linear_mode.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/numbers.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace dualdamp;
using core::Complex;
using core::ModeFunction;
using oracle::LinearProblem;
using sim::LinearMode;
using sim::ModeForcing;
using test::epsilon;
using test::Random;

/// A mode, its forcing and its start: once for the library, once for the reference.
struct Case {
  LinearProblem problem;

  [[nodiscard]] LinearMode mode() const {
    std::vector<double> frequencies;
    std::vector<double> decays;
    for (const auto& harmonic : problem.harmonics) frequencies.push_back(harmonic.frequency);
    for (const auto& transient : problem.transients) decays.push_back(transient.decay);
    const int degree = problem.third != 0.0 ? 3 : problem.second != 0.0 ? 2 : problem.ramp != 0.0 ? 1 : 0;
    return {problem.mass, problem.damping, problem.stiffness, frequencies, {.degree = degree, .decays = decays}};
  }

  [[nodiscard]] ModeForcing forcing() const {
    ModeForcing f{.polynomial = {problem.constant, problem.ramp, problem.second, problem.third}};
    for (const auto& harmonic : problem.harmonics) f.phasors.push_back(harmonic.phasor);
    for (const auto& transient : problem.transients) f.transients.push_back(transient.amplitude);
    return f;
  }
};

/// x, x', x'' and f of a solved mode.
class SolvedMode {
 public:
  explicit SolvedMode(const Case& c) : mode_(c.mode()) {
    mode_.solve(c.forcing(), c.problem.x0, c.problem.v0, x_);
    core::differentiate(mode_.basis(), x_, v_);
    core::differentiate(mode_.basis(), v_, a_);
    mode_.represent(c.forcing(), f_);
  }

  struct Values {
    double x, v, a, f;
  };
  [[nodiscard]] Values at(double s) const {
    core::ExponentialBasis::Values e;
    const core::ExponentialBasis& basis = mode_.basis();
    basis.evaluate(s, e);
    return {core::evaluate(basis, x_, e), core::evaluate(basis, v_, e), core::evaluate(basis, a_, e),
            core::evaluate(basis, f_, e)};
  }
  [[nodiscard]] const LinearMode& mode() const { return mode_; }

 private:
  LinearMode mode_;
  ModeFunction x_;
  ModeFunction v_;
  ModeFunction a_;
  ModeFunction f_;
};

/// The fastest rate of all parts of the motion.
double fastest(const LinearProblem& p) {
  const double half = std::abs(p.damping) / (2.0 * p.mass);
  double rate = half + std::sqrt(std::abs(p.stiffness / p.mass - half * half));
  rate = std::max(rate, std::sqrt(std::abs(p.stiffness) / p.mass));
  for (const auto& harmonic : p.harmonics) rate = std::max(rate, harmonic.frequency);
  for (const auto& transient : p.transients) rate = std::max(rate, std::abs(transient.decay));
  return rate;
}

std::string describe(const LinearProblem& p, double s) {
  std::ostringstream text;
  text.precision(17);
  text << "m " << p.mass << " C " << p.damping << " K " << p.stiffness << " constant " << p.constant << " ramp "
       << p.ramp << " x0 " << p.x0 << " v0 " << p.v0 << " s " << s;
  for (const auto& h : p.harmonics) text << " harmonic " << h.frequency << ' ' << h.phasor;
  for (const auto& t : p.transients) text << " transient " << t.decay << ' ' << t.amplitude;
  return text.str();
}

/// The scale of positions, which are sums: the parts of the particular solution, constant/K, ramp C/K^2 and the
/// like. Written with the own exponents f and g they are force/(m f g), ramp (f + g)/(m f^2 g^2); where f is small
/// beside the drive's frequency, or beside g, divided differences replace these parts, which do not grow further.
double deflection(const LinearProblem& p) {
  const double half = std::abs(p.damping) / (2.0 * p.mass);
  const double beat = std::sqrt(std::abs(p.stiffness / p.mass - half * half));
  const double fast = half + beat;
  if (fast == 0.0 && p.harmonics.empty()) return 0.0;
  const double slow = std::abs(p.stiffness) / p.mass / std::max(fast, 1e-300);
  double floor = 0.0;
  double oscillating = 0.0;
  for (const auto& harmonic : p.harmonics) {
    floor = std::max(floor, 1e-2 * harmonic.frequency);
    oscillating += std::abs(harmonic.phasor);
  }
  for (const auto& transient : p.transients) oscillating += std::abs(transient.amplitude);
  const double g = std::max(fast, floor);
  const double f = std::max({slow, floor, 1e-8 * g});
  const double f_ramp = std::max({slow, floor, 1e-4 * g});
  return (std::abs(p.constant) / (f * g) + std::abs(p.ramp) / (f_ramp * f_ramp * g) + oscillating / (g * g)) /
         p.mass;
}

/// Errors are measured in eps (1 + |z| s) of the largest size of the motion so far and of the deflection. Rounding
/// of z s rotates and scales an element by eps |z| s; exponents as close as one part in 100 are still separate
/// terms, which cancel two digits; sums lose a few ulps. The total is below 512.
constexpr double allowed_units = 512.0;

struct Unit {
  double position = 0.0;
  double force = 0.0;
};

Unit unit_at(const LinearProblem& p, const SolvedMode& motion, double s) {
  const double rate = fastest(p);
  Unit size{deflection(p), 0.0};
  for (int i = 0; i <= 16; ++i) {
    const SolvedMode::Values u = motion.at(s * i / 16.0);
    size.position = std::max({size.position, std::abs(u.x), std::abs(u.v) / rate});
    size.force = std::max(size.force, std::abs(p.mass * u.a) + std::abs(p.damping * u.v) +
                                          std::abs(p.stiffness * u.x) + std::abs(u.f));
  }
  const double units = epsilon * (1.0 + rate * s);
  return {units * size.position, units * (size.force + p.mass * rate * rate * deflection(p))};
}

/// Start, error against 50 digits and residual m x'' + C x' + K x - f at s.
void check(const Case& c, double s) {
  const LinearProblem& p = c.problem;
  const SolvedMode motion(c);
  const double rate = fastest(p);
  const Unit unit = unit_at(p, motion, s);
  INFO(describe(p, s));
  const SolvedMode::Values start = motion.at(0.0);
  CHECK(std::abs(start.x - p.x0) <= allowed_units * unit.position);
  CHECK(std::abs(start.v - p.v0) <= allowed_units * unit.position * rate);
  const SolvedMode::Values found = motion.at(s);
  const oracle::State expected = oracle::solve(p, s);
  CHECK(std::abs(found.x - expected.x) <= allowed_units * unit.position);
  CHECK(std::abs(found.v - expected.v) <= allowed_units * unit.position * rate);
  CHECK(std::abs(p.mass * found.a + p.damping * found.v + p.stiffness * found.x - found.f) <=
        allowed_units * unit.force);
}

/// A time between a hundredth and 30 time units of the oscillator; growth is below exp(20).
double random_time(const LinearProblem& p, Random& random) {
  const double half = p.damping / (2.0 * p.mass);
  const double growth = std::max(0.0, -half + std::sqrt(std::max(0.0, half * half - p.stiffness / p.mass)));
  double s = random.logarithmic(1e-2, 30.0) / std::max(fastest(p), 1e-12);
  if (growth * s > 20.0) s = 20.0 / growth;
  return s;
}

LinearProblem random_start(Random& random) {
  LinearProblem p;
  p.mass = random.logarithmic(1e-3, 1e3);
  p.x0 = random.chance(0.2) ? 0.0 : random.sign() * random.logarithmic(1e-3, 1.0);
  p.v0 = random.chance(0.2) ? 0.0 : random.sign() * random.logarithmic(1e-3, 1.0);
  p.constant = random.chance(0.3) ? 0.0 : random.sign() * random.logarithmic(1e-3, 1.0);
  return p;
}

}  // namespace

TEST_CASE("A mode of any signs of damping and stiffness follows the 50-digit solution") {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    Case c{random_start(random)};
    LinearProblem& p = c.problem;
    const double rate = random.logarithmic(0.1, 10.0);
    p.stiffness = (random.chance(0.7) ? 1.0 : -1.0) * p.mass * rate * rate;
    p.damping = random.sign() * p.mass * rate * random.logarithmic(1e-3, 20.0);
    if (random.chance(0.1)) p.damping = 0.0;
    if (random.chance(0.3)) p.ramp = random.uniform(-1.0, 1.0) * rate;
    for (int j = random.pick(4); j > 0; --j) {
      p.harmonics.push_back({rate * random.logarithmic(0.1, 5.0), random.phasor(1e-2, 1.0)});
    }
    if (random.chance(0.3))
      p.transients.push_back({rate * random.logarithmic(0.1, 20.0), random.uniform(-1.0, 1.0)});
    check(c, random_time(p, random));
  }
}

TEST_CASE("Critical damping and its neighbourhood, 1e-15 to 1e-1 away on either side") {
  Random random(12);
  for (const double side : {-1.0, 0.0, 1.0}) {
    for (double distance = 1e-15; distance < 0.2; distance *= 10.0) {
      Case c{random_start(random)};
      LinearProblem& p = c.problem;
      const double rate = random.logarithmic(0.1, 10.0);
      p.stiffness = p.mass * rate * rate;
      p.damping = (random.chance(0.8) ? 2.0 : -2.0) * p.mass * rate * (1.0 + side * distance);
      p.ramp = random.chance(0.5) ? random.uniform(-1.0, 1.0) : 0.0;
      p.harmonics.push_back({rate * random.logarithmic(0.3, 3.0), std::polar(1.0, random.angle())});
      check(c, random_time(p, random));
    }
  }
}

TEST_CASE("A vanishing stiffness under constant force and ramp, with and without damping") {
  Random random(13);
  for (double stiffness : {0.0, 1e-300, 1e-20, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1}) {
    for (const double damping : {0.0, 1e-12, 1e-6, 1e-2, 1.0, -0.3}) {
      for (const double sign : {1.0, -1.0}) {
        Case c{random_start(random)};
        LinearProblem& p = c.problem;
        p.stiffness = sign * stiffness * p.mass;
        p.damping = damping * p.mass;
        p.constant = random.uniform(-1.0, 1.0) * p.mass;
        p.ramp = random.chance(0.5) ? random.uniform(-1.0, 1.0) * p.mass : 0.0;
        if (damping != 0.0 && random.chance(0.5)) {
          check(c, random.logarithmic(1e-2, 30.0));
        }
        p.harmonics.push_back({1.0, std::polar(p.mass, random.angle())});
        check(c, random.logarithmic(1e-2, 30.0));
      }
    }
  }
}

TEST_CASE("SolvedMode without stiffness and damping is the parabola") {
  // Against the formula itself: x0 + v0 s + F s^2/(2m) + R s^3/(6m).
  const Case c{{.mass = 2.0, .constant = 3.0, .ramp = -1.5, .x0 = 0.25, .v0 = -0.5}};
  const SolvedMode motion(c);
  for (const double s : {1e-6, 0.1, 1.0, 7.0}) {
    CHECK(motion.at(s).x == Approx(0.25 - 0.5 * s + 0.75 * s * s - 0.125 * s * s * s).epsilon(8 * epsilon));
    CHECK(motion.at(s).v == Approx(-0.5 + 1.5 * s - 0.375 * s * s).epsilon(8 * epsilon));
  }
}

TEST_CASE("Resonance without damping grows secularly, and near it nothing cancels") {
  Random random(14);
  // At resonance: m x'' + k x = cos(w s) from rest gives x = s sin(w s)/(2 m w).
  const Case exact{{.mass = 2.0, .stiffness = 18.0, .harmonics = {{3.0, 1.0}}}};
  const SolvedMode secular(exact);
  for (const double s : {1e-3, 0.5, 10.0, 100.0}) {
    CHECK(std::abs(secular.at(s).x - s * std::sin(3.0 * s) / 12.0) <= 16 * epsilon * (1.0 + 3.0 * s) * s / 12.0);
  }
  for (const double side : {-1.0, 1.0}) {
    for (double distance = 1e-16; distance < 0.5; distance *= 10.0) {
      for (const double zeta : {0.0, 1e-15, 1e-10, 1e-5, 1e-2}) {
        Case c{random_start(random)};
        LinearProblem& p = c.problem;
        const double rate = random.logarithmic(0.1, 10.0);
        p.stiffness = p.mass * rate * rate;
        p.damping = 2.0 * zeta * p.mass * rate;
        p.harmonics.push_back({rate * (1.0 + side * distance), std::polar(1.0, random.angle())});
        p.harmonics.push_back({3.0 * rate * (1.0 + side * distance), std::polar(0.1, random.angle())});
        check(c, random.logarithmic(0.1, 200.0) / rate);
      }
    }
  }
}

TEST_CASE("Transients whose decay meets the oscillator's own") {
  Random random(15);
  for (double distance = 1e-16; distance < 0.5; distance *= 10.0) {
    Case c{random_start(random)};
    LinearProblem& p = c.problem;
    // Own exponents -1 and -4.
    p.stiffness = 4.0 * p.mass;
    p.damping = 5.0 * p.mass;
    p.transients.push_back({(random.chance(0.5) ? 1.0 : 4.0) * (1.0 + distance), random.uniform(-1.0, 1.0)});
    p.transients.push_back({0.1, random.uniform(-1.0, 1.0)});
    check(c, random.logarithmic(1e-2, 10.0));
  }
}

TEST_CASE("Own exponents far from each other, with forces beside the slow and beside the fast one") {
  Random random(18);
  for (double ratio = 1e2; ratio < 1e10; ratio *= 10.0) {
    for (int i = 0; i < 20; ++i) {
      Case c{random_start(random)};
      LinearProblem& p = c.problem;
      // Own exponents near -ratio and -1/ratio.
      p.stiffness = (random.chance(0.9) ? 1.0 : -1.0) * p.mass;
      p.damping = p.mass * ratio;
      if (random.chance(0.5)) p.ramp = random.uniform(-1.0, 1.0) * p.mass;
      if (random.chance(0.7)) p.harmonics.push_back({random.logarithmic(1e-2, 10.0), random.phasor(0.1, 1.0)});
      const double beside = 1.0 + random.sign() * random.logarithmic(1e-16, 1e-2);
      p.transients.push_back({ratio * beside, random.uniform(-1.0, 1.0)});
      p.transients.push_back({beside / ratio, random.uniform(-1.0, 1.0)});
      check(c, random.logarithmic(1e-2, 1e3) / ratio);
      check(c, random.logarithmic(1e-2, 10.0));
    }
  }
}

TEST_CASE("Thirty transients beside an own exponent, with eight harmonics") {
  Random random(19);
  Case c{random_start(random)};
  LinearProblem& p = c.problem;
  p.stiffness = 4.0 * p.mass;
  p.damping = 5.0 * p.mass;
  for (int i = 0; i < 30; ++i) p.transients.push_back({1.0 + 3e-4 * i * i, random.uniform(-1.0, 1.0)});
  for (int n = 1; n <= 8; ++n) p.harmonics.push_back({0.5 * n, std::polar(1.0 / n, random.angle())});
  CHECK(c.mode().basis().size() > 40);
  for (const double s : {0.01, 0.3, 2.0, 6.0}) check(c, s);
}

TEST_CASE("No chain joins exponents that are far from each other") {
  Random random(20);
  for (int i = 0; i < 2000; ++i) {
    Case c{random_start(random)};
    LinearProblem& p = c.problem;
    p.stiffness = (random.chance(0.8) ? 1.0 : -1.0) * p.mass * random.logarithmic(1e-9, 1e9);
    p.damping = random.sign() * p.mass * random.logarithmic(1e-9, 1e9);
    p.ramp = random.chance(0.5) ? 1.0 : 0.0;
    if (random.chance(0.7)) p.harmonics.push_back({random.logarithmic(1e-3, 1e3), 1.0});
    if (random.chance(0.7)) p.transients.push_back({random.logarithmic(1e-9, 1e9), 1.0});
    const LinearMode mode = c.mode();
    const core::ExponentialBasis& basis = mode.basis();
    const double drive = p.harmonics.empty() ? 0.0 : p.harmonics.front().frequency;
    const double half = p.damping / (2.0 * p.mass);
    const double fast = std::abs(half) + std::sqrt(std::max(0.0, half * half - p.stiffness / p.mass));
    for (int k = 0; k < basis.size(); ++k) {
      for (int j = basis.parent(k); j >= 0; j = basis.parent(j)) {
        // Close in the sense of the header of the mode: three of them may be two steps apart.
        const double distance = std::abs(basis.exponent(k) - basis.exponent(j));
        const double size = std::max(std::abs(basis.exponent(k)), std::abs(basis.exponent(j)));
        INFO(describe(p, 0.0));
        CHECK(distance <= 0.04 * size + 0.04 * drive + 1e-4 * fast);
      }
    }
  }
}

TEST_CASE("Nine harmonics at once") {
  Random random(16);
  for (const double damping : {0.0, 0.1, 2.0, 50.0}) {
    Case c{random_start(random)};
    LinearProblem& p = c.problem;
    p.stiffness = 9.0 * p.mass;  // the third harmonic resonates
    p.damping = damping * p.mass;
    for (int n = 1; n <= 9; ++n) p.harmonics.push_back({1.0 * n, std::polar(1.0 / n, random.angle())});
    for (const double s : {0.1, 1.0, 6.28}) check(c, s);
  }
}

TEST_CASE("Forces are represented as they are given") {
  const Case c{{.mass = 1.0,
                .damping = 0.1,
                .stiffness = 4.0,
                .constant = 0.5,
                .ramp = -0.25,
                .harmonics = {{1.5, Complex(0.3, -0.4)}, {2.0, Complex(0.0, 1.0)}},
                .transients = {{0.7, 2.0}}}};
  const SolvedMode motion(c);
  for (const double s : {0.0, 0.3, 4.0}) {
    const double expected = 0.5 - 0.25 * s + 0.3 * std::cos(1.5 * s) + 0.4 * std::sin(1.5 * s) - std::sin(2.0 * s) +
                            2.0 * std::exp(-0.7 * s);
    CHECK(motion.at(s).f == Approx(expected).epsilon(0).margin(16 * epsilon));
  }
}

TEST_CASE("The propagator is the derivative of the motion by its start, with the determinant exp(-C s/m)") {
  // The motion is affine in its start: differences of solutions are exact within rounding. Abel's identity fixes
  // the determinant.
  Random random(17);
  for (int i = 0; i < 300; ++i) {
    Case c{random_start(random)};
    LinearProblem& p = c.problem;
    const double rate = random.logarithmic(0.1, 10.0);
    p.stiffness = (random.chance(0.8) ? 1.0 : -1.0) * p.mass * rate * rate;
    if (random.chance(0.1)) p.stiffness = 0.0;
    p.damping = p.mass * rate * random.uniform(-1.0, 3.0);
    if (i % 3 == 0) p.damping = 2.0 * p.mass * rate * (1.0 + random.sign() * random.logarithmic(1e-15, 1e-1));
    if (random.chance(0.1)) p.damping = 0.0;
    p.harmonics.push_back({rate, std::polar(1.0, random.angle())});
    const double s = random.logarithmic(1e-2, 5.0) / rate;
    INFO(describe(p, s));

    const SolvedMode motion(c);
    core::ExponentialBasis::Values values;
    motion.mode().basis().evaluate(s, values);
    const Eigen::Matrix2d propagator = motion.mode().propagator(values);

    Case still = c;
    still.problem.constant = 0.0;
    still.problem.harmonics.clear();
    still.problem.x0 = 1.0;
    still.problem.v0 = 0.0;
    const oracle::State by_position = oracle::solve(still.problem, s);
    still.problem.x0 = 0.0;
    still.problem.v0 = 1.0;
    const oracle::State by_velocity = oracle::solve(still.problem, s);
    const double size = std::max({1.0, std::abs(by_position.x), std::abs(by_position.v) / rate,
                                  std::abs(by_velocity.v), std::abs(by_velocity.x) * rate});
    const double unit = 256 * epsilon * size * (1.0 + fastest(p) * s);
    CHECK(std::abs(propagator(0, 0) - by_position.x) <= unit);
    CHECK(std::abs(propagator(1, 0) - by_position.v) <= unit * rate);
    CHECK(std::abs(propagator(0, 1) - by_velocity.x) <= unit / rate);
    CHECK(std::abs(propagator(1, 1) - by_velocity.v) <= unit);
    CHECK(std::abs(propagator.determinant() - std::exp(-p.damping / p.mass * s)) <= 4 * unit * size);

    // A perturbed solution changes by the propagator.
    Case moved = c;
    moved.problem.x0 += 0.5;
    moved.problem.v0 -= 0.25 * rate;
    const SolvedMode other(moved);
    const double scale = size * (1.0 + std::abs(p.x0) + std::abs(p.v0) / rate) + std::abs(motion.at(s).x) +
                         std::abs(motion.at(s).v) / rate;
    const double expected = 0.5 * propagator(0, 0) - 0.25 * rate * propagator(0, 1);
    CHECK(std::abs(other.at(s).x - motion.at(s).x - expected) <= 512 * epsilon * scale * (1.0 + fastest(p) * s));
  }
}
