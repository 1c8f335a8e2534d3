#include "identify/ledger/estimate/stated_errors.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "identify/ledger/ledger.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t seed = 100;

/// The joint estimate of a driven history whose mass, stiffness and gains are off, and stated with this deviation.
Estimate joint_with(Kind kind, const std::array<double, 4>& off, double deviation, Rig& truth) {
  Measured m = measured(kind, seed, nullptr, {.stiffness = off[1], .gain = off[2], .drive_gain = off[3]});
  m.constants.mass *= 1.0 + off[0];
  truth = m.rig;
  const Ledger ledger = ledger_of(m.record, m.constants,
                                  {.uncertainties = {.mass = deviation * m.constants.mass,
                                                     .stiffness = deviation * m.constants.stiffness,
                                                     .gain_x = deviation,
                                                     .gain_force = deviation}});
  REQUIRE(ledger.joint);
  REQUIRE(ledger.joint->std);
  CHECK(ledger.joint_knows_uncertainties);
  return *ledger.joint;
}

}  // namespace

TEST_CASE("Under a force m, k, c and F0 are known to a common factor, by what is stated of m, k and the force") {
  constexpr double deviation = 0.02;
  const Measured m = measured(Kind::ramp, seed);
  const auto relative = [&](const ConstantUncertainties& uncertainties) {
    const Ledger ledger = ledger_of(m.record, m.constants, {.uncertainties = uncertainties});
    REQUIRE(ledger.joint);
    const auto of = [&](double ParameterSet::* number) {
      return (*ledger.joint->std).*number / ledger.joint->value.*number;
    };
    return std::array{of(&ParameterSet::zeta), of(&ParameterSet::c), of(&ParameterSet::F0)};
  };
  const auto exact = relative({});
  const auto stated = relative({.mass = deviation * m.constants.mass,
                                .stiffness = deviation * m.constants.stiffness,
                                .gain_force = deviation});
  // The factor is the mean of three errors.
  const double share = deviation / std::sqrt(3.0);
  CHECK(stated[0] == Approx(exact[0]).epsilon(0.1));
  CHECK(stated[1] == Approx(std::hypot(exact[1], share)).epsilon(0.03));
  CHECK(stated[2] == Approx(std::hypot(exact[2], share)).epsilon(0.03));
}

TEST_CASE("The interval of c under a force does not jump where the constants depart") {
  Rig rig;
  const Estimate common = joint_with(Kind::ramp, {0.02, 0.02, 0.0, 0.02}, 0.02, rig);
  const Estimate apart = joint_with(Kind::ramp, {0.03, -0.02, 0.01, -0.02}, 0.02, rig);
  const double c = critical_damping(rig.m, rig.k) * rig.zeta;
  for (const Estimate* estimate : {&common, &apart}) {
    CHECK(std::abs(estimate->value.c - c) < 1.96 * estimate->std->c);
    CHECK(std::abs(estimate->value.F0 - rig.F0) < 1.96 * estimate->std->F0);
  }
  CHECK(apart.std->c / apart.value.c == Approx(common.std->c / common.value.c).epsilon(0.1));
}
