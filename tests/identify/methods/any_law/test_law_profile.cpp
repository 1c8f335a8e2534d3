#include "identify/methods/any_law/law_profile.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "identify/methods/any_law/any_law.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/identify/methods/any_law/law_laboratory.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t seed = 31;

struct Case {
  LawRig rig = law_rig(LawRecord::phases, seed);
  Record record;
  std::unique_ptr<const ReadingModel> model;
  PlainFit plain;
};

Case case_of(const char* law, double severity, double noise = 0.003) {
  Case one;
  one.rig.noise = noise;
  one.record = law_record(LawRecord::phases, one.rig, identify::departures::find_departure(law), severity, seed);
  REQUIRE(one.record.pairs);
  auto readings = steady_readings(one.record, one.rig.constants, {});
  REQUIRE(std::holds_alternative<std::unique_ptr<const ReadingModel>>(readings));
  one.model = std::move(std::get<0>(readings));
  const std::optional<PlainFit> plain = plain_fit(*one.model);
  REQUIRE(plain);
  one.plain = *plain;
  return one;
}

}  // namespace

TEST_CASE("any_law: where a search tries a spring that pushes there are no readings") {
  const Case one = case_of("contact_compliance", 0.1);
  const auto near = one.model->no_orbits(one.plain.noise.deviations);
  Eigen::VectorXd unknowns = one.plain.fit.unknowns;
  constexpr Eigen::Index stiffness_change = 2;
  REQUIRE(one.model->residuals({nullptr, 0.0}, unknowns, *near));
  unknowns[stiffness_change] = -1.5;
  CHECK_FALSE(one.model->residuals({nullptr, 0.0}, unknowns, *near));
}

TEST_CASE("any_law: predictions err by less than a thirtieth of the noise") {
  const Case one = case_of("contact_compliance", 0.1);
  const ReadingModel& model = *one.model;
  const std::vector<double>& noise = one.plain.noise.deviations;
  constexpr double severity = 0.2;
  for (const char* law : {"bouc_wen", "contact_compliance", "dahl", "elasto_plastic", "friction_lag", "iwan",
                          "lugre", "stribeck", "viscous_saturating"}) {
    INFO(law);
    const identify::departures::Departure& departure = *identify::departures::find_departure(law);
    const auto near = model.no_orbits(noise);
    Eigen::VectorXd unknowns = one.plain.fit.unknowns;
    unknowns.tail(2).setZero();
    REQUIRE(model.residuals({&departure, severity}, unknowns, *near));
    // Next to the orbits of other unknowns, as in a fit.
    unknowns.head(2) *= 0.98;
    const std::optional<Eigen::VectorXd> residuals = model.residuals({&departure, severity}, unknowns, *near);
    REQUIRE(residuals);
    const std::vector<Pair>& states = one.record.pairs->pairs;
    for (std::size_t i = 0; i < states.size(); ++i) {
      identify::departures::Truth truth = one.rig.truth;
      truth.F0 = unknowns[0] * model.F0_unit();
      truth.model.oscillator.damping = unknowns[1] * model.c_unit();
      truth.model.excitation = {
          .type = sim::ExcitationType::base_harmonic, .amplitude = states[i].Y, .frequency = states[i].omega};
      const sim::SteadyState exact =
          sim::steady_state(identify::departures::departed(departure, truth, model.reference(), severity));
      REQUIRE(exact.outcome.ok());
      const auto row = static_cast<Eigen::Index>(i);
      const auto phase_row = row + static_cast<Eigen::Index>(states.size());
      constexpr double share = 1.0 / 30.0;
      CHECK(std::abs(states[i].x - exact.amplitude - (*residuals)[row]) < share * noise[0]);
      CHECK(std::abs(std::remainder(states[i].phase - exact.phase - (*residuals)[phase_row],
                                    2.0 * std::numbers::pi)) < share * noise[1]);
    }
  }
}

TEST_CASE("any_law: fits that share derivatives are those that take their own") {
  const Case one = case_of("contact_compliance", 0.15);
  for (const char* law : {"contact_compliance", "dahl", "stribeck"}) {
    const identify::departures::Departure& departure = *identify::departures::find_departure(law);
    constexpr double largest = 0.3;
    const std::vector<SeverityFit> fits =
        law_profile(*one.model, departure, largest, one.plain.noise, one.plain.fit).fits;
    REQUIRE(fits.size() > 3);
    for (std::size_t i = 1; i < fits.size(); ++i) {
      INFO(law << " at severity " << fits[i].severity);
      const auto near = one.model->no_orbits(one.plain.noise.deviations);
      const std::optional<SeverityFit> own = fit_law(*one.model, {&departure, fits[i].severity}, one.plain.noise,
                                                     {.unknowns = fits[i].unknowns}, *near);
      REQUIRE(own);
      // Where a law misses the data by hundreds of times the noise a Gauss-Newton search converges slowly: its
      // steps are short, and the minimum is still half a deviation away.
      constexpr double hopeless = 500.0;
      if (own->chi2 > hopeless) continue;
      // Both searches end where a step is below a tenth of a standard deviation.
      const double deviation = std::sqrt(own->covariance(0, 0));
      CHECK(std::abs(fits[i].unknowns[0] - own->unknowns[0]) < 0.2 * deviation);
      CHECK(fits[i].chi2 == Approx(own->chi2).margin(0.1).epsilon(0.01));
      CHECK(std::sqrt(fits[i].covariance(0, 0)) == Approx(deviation).epsilon(0.1));
      CHECK(std::sqrt(fits[i].covariance(1, 1)) == Approx(std::sqrt(own->covariance(1, 1))).epsilon(0.1));
    }
  }
}

TEST_CASE("any_law: the noise of phases is not taken for larger where contacts yield") {
  // With little noise, the misfit of the smooth curve is easier to see.
  constexpr double noise = 0.0006;
  for (const char* law : {"contact_compliance", "dahl", "elasto_plastic", "free_play"}) {
    INFO(law);
    const Case one = case_of(law, 0.2, noise);
    CHECK(one.plain.noise.deviations[1] < 3.0 * noise);
    CHECK(one.plain.noise.deviations[1] > 0.3 * noise);
  }
}

TEST_CASE("any_law: laws err by a share of what the departure does to the readings") {
  const Case plain = case_of("contact_compliance", 1e-6);
  const std::optional<PlainFit> none = with_law_error(*plain.model, plain.plain, 0.25);
  REQUIRE(none);
  // The truth is plain friction: what it leaves is noise.
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(none->noise.deviations[i] == Approx(plain.plain.noise.deviations[i]).epsilon(0.05));
  const Case far = case_of("contact_compliance", 0.2);
  const std::optional<PlainFit> same = with_law_error(*far.model, far.plain, 0.0);
  const std::optional<PlainFit> more = with_law_error(*far.model, far.plain, 0.25);
  REQUIRE(same);
  REQUIRE(more);
  const auto phases = static_cast<Eigen::Index>(far.model->readings().size() / 2);
  const double left =
      far.plain.fit.residuals.segment(phases, phases).norm() / std::sqrt(static_cast<double>(phases));
  REQUIRE(left > 5.0);
  CHECK(same->noise.deviations[1] == Approx(far.plain.noise.deviations[1]));
  CHECK(more->noise.deviations[1] ==
        Approx(far.plain.noise.deviations[1] * std::sqrt(1.0 + 0.0625 * (left * left - 1.0))));
}

TEST_CASE(
    "any_law: bristles that are not in the library are held by others, which err by a share of the departure") {
  const Case one = case_of("elasto_plastic", 0.2);
  const auto study = [&](double law_error) {
    auto found = study_laws(*one.model, one.rig.constants, {.law_error = law_error, .without = {"elasto_plastic"}});
    REQUIRE(std::holds_alternative<LawStudy>(found));
    return std::get<LawStudy>(found).intervals;
  };
  const auto held = [&](const Interval& F0) { return F0[0] <= one.rig.truth.F0 && one.rig.truth.F0 <= F0[1]; };
  const LawIntervals exact = study(0.0);
  const LawIntervals erring = study(0.25);
  for (const LawIntervals* laws : {&exact, &erring})
    UNSCOPED_INFO("F0 " << laws->F0_hull[0] / one.rig.truth.F0 << " to " << laws->F0_hull[1] / one.rig.truth.F0);
  CHECK_FALSE(held(exact.F0_hull));
  CHECK(held(erring.F0_hull));
}

TEST_CASE("any_law: friction that falls over position is held by one that falls over speed") {
  const Case one = case_of("position_slope", 0.09);
  const auto held_without = [&](const std::vector<std::string>& laws) {
    auto study = study_laws(*one.model, one.rig.constants, {.without = laws});
    REQUIRE(std::holds_alternative<LawStudy>(study));
    const Interval hull = std::get<LawStudy>(study).intervals.zeta_hull;
    UNSCOPED_INFO("zeta " << hull[0] / one.rig.zeta << " to " << hull[1] / one.rig.zeta);
    return hull[0] <= one.rig.zeta && one.rig.zeta <= hull[1];
  };
  CHECK(held_without(all_laws_but({"stribeck", "wide_stribeck"})));
  CHECK_FALSE(held_without({"position_slope", "wide_stribeck"}));
}

TEST_CASE("any_law: laws that are not rejected count alike in the average, the others do not count") {
  const Case one = case_of("contact_compliance", 0.1);
  auto study = study_laws(*one.model, one.rig.constants, {});
  REQUIRE(std::holds_alternative<LawStudy>(study));
  const LawIntervals& found = std::get<LawStudy>(study).intervals;
  const auto allowed = std::ranges::count_if(found.laws, [](const LawAnswer& law) { return !law.rejected; });
  REQUIRE(allowed > 1);
  REQUIRE(allowed < std::ssize(found.laws));
  for (const LawAnswer& law : found.laws)
    CHECK(law.weight == Approx(law.rejected ? 0.0 : 1.0 / static_cast<double>(allowed)));
}

TEST_CASE("any_law: a film that levels off is held by other viscous laws when its own is not in the library") {
  // With less noise the second order tells the two films apart.
  constexpr double noise = 0.002;
  const Case one = case_of("viscous_saturating", 0.1, noise);
  const auto held_without = [&](const std::vector<std::string>& laws) {
    auto study = study_laws(*one.model, one.rig.constants, {.without = laws});
    REQUIRE(std::holds_alternative<LawStudy>(study));
    const Interval hull = std::get<LawStudy>(study).intervals.zeta_hull;
    for (const LawAnswer& law : std::get<LawStudy>(study).intervals.laws)
      UNSCOPED_INFO(law.name << " p " << law.p_value << " severity " << law.severity << " zeta "
                             << law.zeta_interval95[0] << " to " << law.zeta_interval95[1]);
    UNSCOPED_INFO("hull " << hull[0] << " to " << hull[1] << ", truth " << one.rig.zeta);
    return hull[0] <= one.rig.zeta && one.rig.zeta <= hull[1];
  };
  CHECK(held_without(all_laws_but({"film_beside_damper", "viscous_power"})));
  // No other law has the damping of low speeds and a damping that falls with speed.
  CHECK_FALSE(held_without({"film_beside_damper", "viscous_saturating"}));
}

TEST_CASE("any_law: a law whose motions hardly decay near the data ends the search, and the reason names it") {
  // A resonance curve read with 2.4 times its gain: the best fits have next to no friction and little damping.
  // Without the limit of work this search took two minutes.
  constexpr std::array rpm = {478.42, 495.50, 512.59, 529.68, 546.76, 563.85, 580.93, 598.02,
                              615.11, 632.19, 649.28, 666.37, 683.45, 700.54, 717.62};
  constexpr std::array mm = {7.3569,  8.3421,  9.6663,  11.7138, 14.6705, 19.6337, 26.9511, 33.0963,
                             25.9630, 17.8933, 13.1177, 10.2868, 8.2356,  6.9241,  5.8529};
  Record record;
  record.pairs.emplace();
  for (std::size_t i = 0; i < rpm.size(); ++i)
    record.pairs->pairs.push_back({.Y = 1.4e-3,
                                   .x = 1.2e-3 * mm[i],
                                   .number = static_cast<int>(i) + 1,
                                   .omega = rpm[i] * std::numbers::pi / 30.0});
  const KnownConstants constants{.mass = 0.742, .stiffness = 2910.0};
  AnyLawOptions options;
  options.without = library_names();
  std::erase(options.without, "generalized_maxwell_slip");
  const Estimate estimate = any_law(record, constants, options);
  CHECK_FALSE(estimate.outcome.ok());
  CHECK(estimate.laws == nullptr);
  CHECK_THAT(estimate.outcome.reason,
             Catch::Contains("the search was cut short") && Catch::Contains("under generalized_maxwell_slip,"));
}

TEST_CASE("any_law: the search for a law does no more work than it may, by less than one motion") {
  const Case one = case_of("contact_compliance", 0.1);
  const auto near = one.model->no_orbits(one.plain.noise.deviations);
  const identify::departures::Departure& departure = *identify::departures::find_departure("dahl");
  const LawAt law{&departure, 0.1};
  const auto here = one.model->residuals(law, one.plain.fit.unknowns, *near);
  REQUIRE(here);
  const long of_one = near->work;
  CHECK(of_one > 0);
  CHECK(of_one < one.model->most_work());
  // Derivatives count too.
  REQUIRE(one.model->derivatives(law, one.plain.fit.unknowns, *here, *near));
  CHECK(near->work > of_one);
  near->most_work = near->work;
  REQUIRE_FALSE(near->is_exhausted());
  CHECK_FALSE(one.model->residuals(law, one.plain.fit.unknowns, *near));
  CHECK(near->is_exhausted());
  const long spent = near->work;
  CHECK(spent < near->most_work + of_one);
  CHECK_FALSE(one.model->residuals(law, one.plain.fit.unknowns, *near));
  CHECK(near->work == spent);
}
