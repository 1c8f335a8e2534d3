/// Monodromy matrices of the smooth engine over mode changes of laws and reversals.

#include <catch2/catch.hpp>
#include <vector>

#include "sim/orbits/period_map.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using friction::ParameterValues;

TEST_CASE("smooth engine: two elements of a law that let go at one instant delay a perturbation each by itself",
          "[sim][smooth][derivative]") {
  // Both have slipped before the mass turned, so that they let go again at one position. The force is the same
  // before and behind: a change of one spring's force acts as a change of the other's. The expected values are
  // differences of motions by SciPy's DOP853 at 1e-12.
  sim::Model model;
  model.oscillator = {.mass = 0.00371046410668037,
                      .stiffness = 0.11985325935371842,
                      .damping = 4.3958193976395434e-05,
                      .damper_to = sim::DamperTo::base};
  model.excitation = {.type = sim::ExcitationType::force_harmonic,
                      .amplitude = 0.0009557197582384445,
                      .frequency = 28.284773620634983,
                      .phase = 2.961937614229332};
  const std::vector<ParameterValues> elements = {{{"stiffness", 0.39116371155845975}, {"share", 0.5}},
                                                 {{"stiffness", 0.4043747319727298}, {"share", 0.5}}};
  model.friction = {test::law("generalized_maxwell_slip", {{"kinetic", 0.00032102405418036104},
                                                           {"stribeck_velocity", 0.002397362445641481},
                                                           {"elements", elements},
                                                           {"attraction", 0.004262762744310418}}),
                    test::law("coulomb", {{"kinetic", 0.0002823545125434487}})};
  sim::PeriodMap map(model);
  sim::State start = map.from_start(0.00048669752326118424, -0.0028353806033836805, sim::Monodromy::without).begin;
  start.memories[0].state = {0.00014072570165646857, 0.00015089959475141998};
  const Eigen::MatrixXd monodromy = map.from(start, sim::Monodromy::with).monodromy;
  CAPTURE(monodromy);
  for (const Eigen::Index column : {2, 3}) {
    CHECK(monodromy(0, column) == Approx(-1.53634524).epsilon(1e-6));
    CHECK(monodromy(1, column) == Approx(3.11531492).epsilon(1e-6));
    CHECK(monodromy(2, column) == Approx(-0.17238449).epsilon(1e-6));
    CHECK(monodromy(3, column) == Approx(0.01123442).epsilon(1e-5));
  }
  CHECK(monodromy(1, 0) == Approx(-1.04949912).epsilon(1e-6));
}

TEST_CASE("smooth engine: a guard that reaches zero at no rate leaves the lead of a perturbation as it was",
          "[sim][smooth][derivative]") {
  // Twice in the period the mass sticks so long that the late speed is 1e-31 m/s at the release. It changes its
  // sign there at a rate of 1e-37 m/s^2: a delay of 1e12 s for each metre, beside a lead of 0.02 s. The expected
  // values are differences of motions by SciPy's DOP853 at 1e-12.
  sim::Model model;
  model.oscillator = {.mass = 8.272423830431121, .stiffness = 544014.5451998804, .damping = 608.9330663788951};
  model.excitation = {.type = sim::ExcitationType::force_harmonic,
                      .amplitude = 62700.31991872185,
                      .frequency = 27.012524443597425,
                      .phase = 5.198232084947693};
  model.friction = {test::law("friction_lag", {{"kinetic", 2425.3703076757843},
                                               {"static", 5219.920648074622},
                                               {"stribeck_velocity", 0.6324654313772804},
                                               {"exponent", 0.7338418557451512},
                                               {"lag", 0.00027433456408901854}}),
                    test::law("asymmetric_coulomb", {{"kinetic_forward", 931.5080886558087},
                                                     {"static_forward", 2026.095673358375},
                                                     {"viscous_forward", 0.0},
                                                     {"kinetic_backward", 14031.176454781247},
                                                     {"viscous_backward", 11.64076355050654}})};
  sim::PeriodMap map(model);
  sim::State start = map.from_start(0.048054445060788271, 2.9633195834061095, sim::Monodromy::without).begin;
  start.memories[0].state = {3.0343135327805921};
  const Eigen::MatrixXd monodromy = map.from(start, sim::Monodromy::with).monodromy;
  CAPTURE(monodromy);
  CHECK(monodromy(0, 0) == Approx(2.473113e-3).epsilon(1e-5));
  CHECK(monodromy(1, 0) == Approx(-5.446640).epsilon(1e-5));
  CHECK(monodromy(2, 0) == Approx(-5.469999).epsilon(1e-5));
  CHECK(monodromy(1, 1) == Approx(0.03631848).epsilon(1e-5));
  CHECK(monodromy(2, 2) == Approx(1.232527e-4).epsilon(1e-4));
}

TEST_CASE("smooth engine: a reversal that alters no force delays nothing", "[sim][smooth][derivative]") {
  // A bond that never breaks and a dashpot forget a displacement within 7 us. The mass reverses 7 us after the
  // start of the period at 2e-5 m/s^2: a displacement of 1 m would delay that by 2e9 s, and the rounding of this
  // delay alone made -0.15 of the second entry. The motion is linear: the expected values are its matrix
  // exponential in 60 digits.
  sim::Model model;
  model.oscillator = {.mass = 6.862230199196253, .stiffness = 634020.5226166677, .damping = 28531178.949056655};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.005538342733748107,
                      .frequency = 164.9274509788931};
  model.friction = {
      test::law("reset_integrator",
                {{"kinetic", 1537919.537188363}, {"stiffness", 4274741511720.224}, {"damping", 83.8891116587536}}),
      test::law("attached_mass", {{"mass", 0.050103880195353105}, {"stiffness", 5878.299140719173}})};
  sim::PeriodMap map(model);
  (void)map.from_start(0.029056242548207212, 0.0, sim::Monodromy::without);
  (void)map.next(sim::Monodromy::without);
  const Eigen::MatrixXd monodromy = map.from(map.engine().state(), sim::Monodromy::with).monodromy;
  CAPTURE(monodromy);
  CHECK(monodromy(0, 0) == Approx(1.446492e-12).epsilon(1e-4));
  CHECK(monodromy(1, 0) == Approx(9.56033e-10).epsilon(1e-4));
  CHECK(monodromy(0, 3) == Approx(1.21951e-9).epsilon(1e-4));
  CHECK(monodromy(1, 3) == Approx(-2.176445e-7).epsilon(1e-4));
  CHECK(monodromy(3, 0) == Approx(0.001056539).epsilon(1e-4));
  CHECK(monodromy(4, 0) == Approx(0.6944104).epsilon(1e-4));
  CHECK(monodromy(4, 3) == Approx(-158.9671).epsilon(1e-6));
}
