#include "identify/models/sampled_oscillator.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/identify/ledger/rig.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double rate = 400.0;

Rig rig() {
  Rig rig;
  rig.m = 1.3;
  rig.k = 1600.0;
  rig.zeta = 0.05;
  rig.F0 = 2.0;
  return rig;
}

double drive(double t) { return 9.0 * std::sin(33.0 * t); }

History history_of(const Motion& motion) {
  History history;
  history.sample_rate = rate;
  history.x = motion.x;
  history.force = motion.drive;
  return history;
}

SampledOscillator::Parameters parameters_of(const Rig& rig) {
  return {rig.m, 2.0 * rig.zeta * std::sqrt(rig.m * rig.k), rig.k, rig.F0, 0.0, 0.0};
}

double cubic(const SampledOscillator::Instant& at) { return at.x * at.x * at.x; }
double drag(const SampledOscillator::Instant& at) { return at.direction * at.v * at.v; }
double one_sided(const SampledOscillator::Instant& at) { return at.direction > 0.0 ? 1.0 : 0.0; }

}  // namespace

TEST_CASE("A motion under a cubic spring and drag is that of another integrator") {
  Rig altered = rig();
  altered.cubic = 0.05;
  altered.drag = 0.4;
  altered.V = 0.4;
  const Motion motion = motion_of(altered, drive, 3.0, rate);
  const History history = history_of(motion);
  SampledOscillator::Parameters at = parameters_of(altered);
  at.further = {altered.k * altered.cubic / (altered.L * altered.L), at.c * altered.drag / altered.V};
  Eigen::VectorXd x;
  REQUIRE(SampledOscillator(history).run(at, {}, x, nullptr, nullptr, {cubic, drag}));
  double largest = 0.0;
  double off = 0.0;
  for (std::size_t i = 0; i < motion.x.size(); ++i) {
    largest = std::max(largest, std::abs(motion.x[i]));
    off = std::max(off, std::abs(x[static_cast<Eigen::Index>(i)] - motion.x[i]));
  }
  CHECK(off < 1e-5 * largest);
}

TEST_CASE("A motion under a smooth drive with seven samples in a period is that of another integrator") {
  const auto swelling = [](double t) { return drive(t) * std::exp(-std::pow((t - 1.5) / 0.5, 2)); };
  constexpr double few = 7.0 * 33.0 / (2.0 * std::numbers::pi);
  const Motion motion = motion_of(rig(), swelling, 3.0, few);
  History history = history_of(motion);
  history.sample_rate = few;
  Eigen::VectorXd x;
  REQUIRE(SampledOscillator(history).run(parameters_of(rig()), {}, x, nullptr));
  const Eigen::Map<const Eigen::VectorXd> true_x(motion.x.data(), x.size());
  CHECK((x - true_x).lpNorm<Eigen::Infinity>() < 3e-5 * true_x.lpNorm<Eigen::Infinity>());
}

TEST_CASE("Derivatives beside forces that act are those of differences") {
  const Motion motion = motion_of(rig(), drive, 1.5, rate);
  const History history = history_of(motion);
  SampledOscillator oscillator(history);
  const std::vector<SampledOscillator::Force> forces{cubic, drag, one_sided};
  SampledOscillator::Parameters at = parameters_of(rig());
  at.further = {2e5, 3.0, 0.3};
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  REQUIRE(oscillator.run(at, {SampledOscillator::By::damping}, x, &derivatives, nullptr, forces));
  for (std::size_t j = 0; j <= forces.size(); ++j) {
    CAPTURE(j);
    const auto moved = [&](double share) {
      SampledOscillator::Parameters there = at;
      (j == 0 ? there.c : there.further[j - 1]) *= 1.0 + share;
      Eigen::VectorXd result;
      REQUIRE(oscillator.run(there, {}, result, nullptr, nullptr, forces));
      return result;
    };
    const double value = j == 0 ? at.c : at.further[j - 1];
    const Eigen::VectorXd slope = (moved(1e-4) - moved(-1e-4)) / (2e-4 * value);
    const auto column = derivatives.x.col(static_cast<Eigen::Index>(j));
    // The slopes of the forces are taken in the middle of each interval.
    CHECK((column - slope).norm() < 0.01 * slope.norm());
  }
}

TEST_CASE("The acceleration at the samples is that of the motion, at the ends and beside reversals too") {
  const Motion motion = motion_of(rig(), drive, 1.5, rate);
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  REQUIRE(SampledOscillator(history_of(motion)).run(parameters_of(rig()), {}, x, &derivatives));
  const Eigen::Map<const Eigen::VectorXd> a(motion.a.data(), x.size());
  const Eigen::VectorXd off = (derivatives.a - a).tail(x.size() - 1).cwiseAbs();
  INFO("at sample " << off.size() << ", median " << off[off.size() / 2]);
  CHECK(off.maxCoeff() < 1e-4 * a.cwiseAbs().maxCoeff());
}

TEST_CASE("A motion with a contact that yields is that of another integrator") {
  Rig altered = rig();
  altered.compliance = 0.1;
  altered.L = 0.02;
  const Motion motion = motion_of(altered, drive, 3.0, rate);
  SampledOscillator::Parameters at = parameters_of(altered);
  at.yield = altered.compliance * altered.L;
  Eigen::VectorXd x;
  REQUIRE(SampledOscillator(history_of(motion)).run(at, {}, x, nullptr));
  const Eigen::Map<const Eigen::VectorXd> true_x(motion.x.data(), x.size());
  // The other integrator takes the start of a slide at the end of its step, a 300th of a period.
  CHECK((x - true_x).lpNorm<Eigen::Infinity>() < 1e-4 * true_x.lpNorm<Eigen::Infinity>());
}

TEST_CASE("Derivatives beside a contact that yields, from rest and from a slow start, are those of differences") {
  using By = SampledOscillator::By;
  const Motion motion = motion_of(rig(), drive, 1.5, rate);
  SampledOscillator oscillator(history_of(motion));
  const std::vector<By> by{By::mass,     By::damping,  By::stiffness, By::friction,
                           By::position, By::velocity, By::yield};
  const double first_speed = GENERATE(0.0, 0.02);
  SampledOscillator::Parameters at = parameters_of(rig());
  at.yield = 0.001;
  at.v0 = first_speed;
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  REQUIRE(oscillator.run(at, by, x, &derivatives));
  const std::vector<double SampledOscillator::Parameters::*> members{
      &SampledOscillator::Parameters::m,    &SampledOscillator::Parameters::c,  &SampledOscillator::Parameters::k,
      &SampledOscillator::Parameters::F0,   &SampledOscillator::Parameters::x0, &SampledOscillator::Parameters::v0,
      &SampledOscillator::Parameters::yield};
  for (std::size_t j = 0; j < by.size(); ++j) {
    CAPTURE(j, first_speed);
    const double step = j == 4 ? 1e-7 : j == 5 ? 1e-5 : 1e-5 * at.*members[j];
    const auto moved = [&](double sign) {
      SampledOscillator::Parameters there = at;
      there.*members[j] += sign * step;
      Eigen::VectorXd result;
      REQUIRE(oscillator.run(there, {}, result, nullptr));
      return result;
    };
    const Eigen::VectorXd slope = (moved(1.0) - moved(-1.0)) / (2.0 * step);
    CHECK((derivatives.x.col(static_cast<Eigen::Index>(j)) - slope).norm() < 1e-3 * slope.norm());
  }
}

TEST_CASE("A drive that is cut between two samples drives up to the place of its step, and differentiates by it") {
  constexpr double place = 0.3;
  constexpr double end = (403.0 + place) / rate;
  const auto cut = [](double t) { return t < end ? drive(t) : 0.0; };
  constexpr std::size_t finer = 50;
  const Motion fine = motion_of(rig(), cut, 3.0, finer * rate);
  Motion motion;
  for (std::size_t i = 0; i < fine.x.size(); i += finer) {
    motion.x.push_back(fine.x[i]);
    motion.drive.push_back(fine.drive[i]);
  }
  SampledOscillator oscillator(history_of(motion));
  REQUIRE(oscillator.steps() == std::vector<std::size_t>{403});
  SampledOscillator::Parameters at = parameters_of(rig());
  at.places = {place};
  Eigen::VectorXd x;
  SampledOscillator::Derivatives derivatives;
  REQUIRE(oscillator.run(at, {SampledOscillator::By::place}, x, &derivatives));
  const Eigen::Map<const Eigen::VectorXd> true_x(motion.x.data(), x.size());
  CHECK((x - true_x).lpNorm<Eigen::Infinity>() < 1e-4 * true_x.lpNorm<Eigen::Infinity>());
  constexpr double step = 1e-4;
  Eigen::VectorXd above;
  at.places = {place + step};
  REQUIRE(oscillator.run(at, {}, above, nullptr));
  at.places = {place - step};
  Eigen::VectorXd below;
  REQUIRE(oscillator.run(at, {}, below, nullptr));
  const Eigen::VectorXd slope = (above - below) / (2.0 * step);
  CHECK((derivatives.x.col(0) - slope).lpNorm<Eigen::Infinity>() < 1e-3 * slope.lpNorm<Eigen::Infinity>());
}
