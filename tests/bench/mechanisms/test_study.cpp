// Which mechanism explains estimates that depend on the part of the data: a test made with one mechanism leads back
// to it, the lines are those of the method, and without a mechanism the numbers of the study have closed forms.

#include "bench/mechanisms/study.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/analyses.hpp"
#include "bench/mechanisms/fit.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "scenarios/run.hpp"
#include "sim/parallel.hpp"

using namespace dualdamp;

namespace {

const sim::Oscillator oscillator{.mass = 1.042, .stiffness = 1568.0};
const identify::KnownConstants constants{1.042, 1568.0, sim::natural_frequency(oscillator)};
const bench::Apparatus rig{.oscillator = oscillator,
                           .reference = {.amplitude = 9.7e-3, .frequency = constants.frequency, .Y = 5.6e-3}};
const bench::Levels five = {{4.452e-3, 5.027e-3, 5.602e-3, 6.177e-3, 6.752e-3},
                            {5.117e-3, 7.143e-3, 9.667e-3, 12.707e-3, 16.896e-3}};

/// The paper's four parts of the data, with their estimates.
bench::MechanismStudy paper() {
  bench::MechanismStudy study;
  study.friction = {3.7, 11.0};
  study.levels = 5;
  study.estimates = {{1.0, 0.0987, 4.39, 8.7e-5, 8.7e-3},
                     {0.8, 0.114, 4.12, 8.7e-4, 8.7e-3},
                     {0.6, 0.126, 3.91, 8.7e-4, 8.7e-3},
                     {0.4, 0.142, 3.69, 8.7e-4, 8.7e-3}};
  return study;
}

/// The study of a test that was made with one mechanism.
bench::MechanismStudy made_by(const bench::Departure& mechanism, const bench::RigFriction& friction,
                              const std::vector<double>& values) {
  bench::MechanismStudy study = paper();
  const auto response = bench::response(mechanism, rig, friction, values, five.Y);
  REQUIRE(response);
  const auto readings = bench::read_parts({five.Y, response->x}, study, constants);
  REQUIRE(readings);
  for (std::size_t i = 0; i < readings->size(); ++i) {
    study.estimates[i].zeta = readings->at(i).zeta;
    study.estimates[i].F0 = readings->at(i).F0;
  }
  return study;
}

bench::MechanismFit best_fit(const bench::Departure& mechanism, const bench::MechanismStudy& study,
                             const bench::Levels& near) {
  const bench::MechanismSearch search(mechanism, study, rig, near);
  bench::MechanismFit best = search.begin(0);
  for (std::size_t start = 1; start < search.starts(); ++start) {
    bench::MechanismFit fit = search.begin(start);
    if (fit.outcome.ok() && (!best.outcome.ok() || fit.chi2 < best.chi2)) best = std::move(fit);
  }
  return search.refine(best);
}

scenarios::Scenario scenario_of(const std::string& analysis) {
  return scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1.042, stiffness: 1568, damping: 11, friction: {law: coulomb, kinetic: "
      "3.7}}\nexcitation: {type: base_harmonic, frequency: natural}\nanalysis: {type: mechanisms, " +
          analysis + "}\n",
      "test", {.analyses = bench::analyses()});
}

const std::string paper_estimates =
    "estimates: [{share: 1, zeta: 0.0987, F0: 4.39, zeta_std: 8.7e-5, F0_std: 8.7e-3}, {share: 0.8, zeta: 0.114, "
    "F0: 4.12, zeta_std: 8.7e-4, F0_std: 8.7e-3}, {share: 0.6, zeta: 0.126, F0: 3.91, zeta_std: 8.7e-4, F0_std: "
    "8.7e-3}, {share: 0.4, zeta: 0.142, F0: 3.69, zeta_std: 8.7e-4, F0_std: 8.7e-3}]";

}  // namespace

TEST_CASE("mechanism study: the lines are those of resonance_least_squares") {
  const bench::MechanismStudy study = paper();
  const auto readings = bench::read_parts(five, study, constants);
  REQUIRE(readings);
  for (std::size_t i = 0; i < study.estimates.size(); ++i) {
    identify::Record record;
    record.pairs.emplace();
    for (std::size_t j = 0; j < 5 - i; ++j) record.pairs->pairs.push_back({.Y = five.Y[j], .x = five.x[j]});
    const identify::Estimate estimate = identify::resonance_least_squares(record, constants, {});
    REQUIRE(estimate.outcome.ok());
    CHECK(estimate.excluded.empty());
    // The same sums in another unit of length.
    CHECK(readings->at(i).zeta == Approx(estimate.value.zeta).epsilon(1e-12));
    CHECK(readings->at(i).F0 == Approx(estimate.value.F0).epsilon(1e-12));
  }
}

TEST_CASE("mechanism study: levels behind the estimates are found, known or not") {
  bench::MechanismStudy study = made_by(*bench::find_mechanism("viscous_saturating"), {3.0, 12.0}, {0.5});
  for (const bool known : {false, true}) {
    CAPTURE(known);
    if (known) study.amplitudes = five.Y;
    const auto levels = bench::reconstruct(study, constants);
    REQUIRE(levels);
    const auto readings = bench::read_parts(*levels, study, constants);
    REQUIRE(readings);
    // As many numbers as unknowns or more, and all of them are fitted to the tolerance of the search.
    for (std::size_t i = 0; i < readings->size(); ++i) {
      CHECK(std::abs(readings->at(i).zeta - study.estimates[i].zeta) < 0.1 * study.estimates[i].zeta_std);
      CHECK(std::abs(readings->at(i).F0 - study.estimates[i].F0) < 0.1 * study.estimates[i].F0_std);
    }
  }
  // Lines through nested parts of data are not arbitrary.
  study.amplitudes.clear();
  study.estimates.back().F0 = 40.0;
  CHECK_FALSE(bench::reconstruct(study, constants));
}

TEST_CASE("mechanism study: a test made by a mechanism leads back to it") {
  // Eight numbers, five unknowns, no noise: the rest is a tenth of a standard error, by the weak prior of the
  // search in a valley in which parameters compensate each other.
  struct Case {
    const char* name;
    bench::RigFriction friction;
    std::vector<double> values;
    double tolerance;
  };
  for (const Case& made : {Case{"viscous_saturating", {3.0, 12.0}, {0.5}, 0.05},
                           Case{"contact_compliance", {6.0, 5.0}, {1500.0}, 0.05}}) {
    CAPTURE(made.name);
    const bench::Departure& mechanism = *bench::find_mechanism(made.name);
    const bench::MechanismStudy study = made_by(mechanism, made.friction, made.values);
    const bench::MechanismFit fit = best_fit(mechanism, study, five);
    REQUIRE(fit.outcome.ok());
    CHECK(fit.chi2 < 0.1);
    CHECK(fit.friction.F0 == Approx(made.friction.F0).epsilon(made.tolerance));
    CHECK(fit.friction.c == Approx(made.friction.c).epsilon(made.tolerance));
    CHECK(fit.values[0] == Approx(made.values[0]).epsilon(2.0 * made.tolerance));
    CHECK(fit.levels.Y[2] == Approx(five.Y[2]).epsilon(made.tolerance));
    // Coulomb + viscous friction does not explain it: its lines are the same for all parts.
    const bench::MechanismFit none = best_fit(*bench::find_mechanism("coulomb_viscous"), study, five);
    REQUIRE(none.outcome.ok());
    CHECK(none.chi2 > 100.0);
  }
}

TEST_CASE("mechanism study: the paper's bend is explained by a film that saturates, not by Coulomb friction") {
  const bench::MechanismStudy study = paper();
  const bench::MechanismFit film = best_fit(*bench::find_mechanism("viscous_saturating"), study, five);
  REQUIRE(film.outcome.ok());
  CHECK(film.chi2 < 8.0);
  // With F0 and c alone the best fit is one pair of values for all parts: the mean, weighted by the errors.
  double zeta = 0.0, weight = 0.0;
  for (const bench::PartEstimate& estimate : study.estimates) {
    zeta += estimate.zeta / std::pow(estimate.zeta_std, 2);
    weight += 1.0 / std::pow(estimate.zeta_std, 2);
  }
  double F0 = 0.0;
  for (const bench::PartEstimate& estimate : study.estimates) F0 += estimate.F0 / 4.0;
  double chi2 = 0.0;
  for (const bench::PartEstimate& estimate : study.estimates)
    chi2 += std::pow((estimate.zeta - zeta / weight) / estimate.zeta_std, 2) +
            std::pow((estimate.F0 - F0) / estimate.F0_std, 2);
  const bench::MechanismFit none = best_fit(*bench::find_mechanism("coulomb_viscous"), study, five);
  REQUIRE(none.outcome.ok());
  // H, which the method neglects, contributes 2e-4, and the search ends within a per cent.
  CHECK(none.chi2 == Approx(chi2).epsilon(0.01));
}

TEST_CASE("mechanism study: the whole answer, the same on any number of threads") {
  const scenarios::Scenario scenario = scenario_of(
      "levels: 5, mechanisms: [coulomb_viscous, contact_compliance, viscous_saturating], decay: {stiffness: 4365, "
      "displacement: 14.7 mm, high: {zeta: 0.0909, x_f: 0.710 mm}, low: {zeta: 0.0729, x_f: 0.905 mm}}, " +
      paper_estimates);
  const scenarios::RunResult result = scenarios::run(scenario);
  CHECK(result.status == core::ExitStatus::done);
  const nlohmann::json json = nlohmann::json::parse(result.result);
  const auto of = [&](const std::string& name) {
    for (const nlohmann::json& item : json.at("mechanisms"))
      if (item.at("mechanism") == name) return item;
    return nlohmann::json();
  };
  CHECK(json.at("mechanisms").at(0).at("mechanism") == "viscous_saturating");
  CHECK(json.at("mechanisms").at(0).at("misfit") < 0.015);
  CHECK(json.at("explained").at("bend") == Approx(0.142 / 0.0987 - 1.0));
  // Without a mechanism the damper is the same in every segment of a decay.
  const nlohmann::json plain = of("coulomb_viscous");
  const double zeta = plain.at("c").get<double>() / (2.0 * std::sqrt(1.042 * 4365.0));
  for (const char* segment : {"high", "low"}) {
    CHECK(plain.at("decay").at(segment).at("zeta") == Approx(zeta).epsilon(1e-9));
    CHECK(plain.at("decay").at(segment).at("x_f") == Approx(plain.at("F0").get<double>() / 4365.0).epsilon(1e-9));
  }
  // With the measured contact stiffness the estimates hardly depend on the part; the fitted stiffness is about a
  // hundredth of it.
  CHECK(std::abs(json.at("effects").at(1).at("bend").get<double>()) < 1e-3);
  CHECK(of("contact_compliance").at("stretch") > 50.0);

  const sim::ThreadLimit one(1);
  CHECK(scenarios::run(scenario).result == result.result);

  // Every number is a field of the format.
  std::vector<std::string> patterns;
  for (const scenarios::ResultField& field : scenario.result_fields) patterns.push_back(field.path);
  const std::function<void(const nlohmann::json&, const std::string&)> check_paths =
      [&](const nlohmann::json& value, const std::string& path) {
        if (value.is_object())
          for (const auto& [key, item] : value.items()) check_paths(item, path.empty() ? key : path + "." + key);
        if (value.is_array())
          for (const nlohmann::json& item : value) check_paths(item, path + "[]");
        if (value.is_structured()) return;
        CAPTURE(path);
        CHECK(std::ranges::find(patterns, path) != patterns.end());
      };
  check_paths(json, "");
}

TEST_CASE("mechanism study: values of one's own take the place of the known ones") {
  const scenarios::Scenario scenario = scenario_of(
      "levels: 5, mechanisms: [contact_compliance], plausible: [{mechanism: contact_compliance, case: soft, "
      "contact_stiffness: 3000 N/m}, {mechanism: contact_compliance, contact_stiffness: 1e4}], " +
      paper_estimates);
  const nlohmann::json json = nlohmann::json::parse(scenarios::run(scenario).result);
  REQUIRE(json.at("effects").size() == 2);
  CHECK(json.at("effects").at(0).at("case") == "soft");
  // A contact costs Phi = (4 F0/pi) (1 - d/x), d = F0/K, so that lines through larger x are flatter: 2 % at 3000
  // N/m, and less in proportion to d where d is small.
  const double soft = json.at("effects").at(0).at("bend");
  const double stiff = json.at("effects").at(1).at("bend");
  CHECK(soft == Approx(0.0203).epsilon(0.02));
  CHECK(soft / stiff == Approx(10.0 / 3.0).epsilon(0.1));
}

TEST_CASE("mechanism study: estimates that no data can give end without a result") {
  std::string estimates = paper_estimates;
  estimates.replace(estimates.find("F0: 3.69"), 8, "F0: 36.9");
  const scenarios::RunResult result =
      scenarios::run(scenario_of("levels: 5, mechanisms: [coulomb_viscous], " + estimates));
  CHECK(result.status == core::ExitStatus::numerical_failure);
  CHECK(result.failure.find("no levels") != std::string::npos);
  CHECK(result.result == "null");
}
