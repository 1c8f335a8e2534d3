#include <catch2/catch.hpp>
#include <cmath>

#include "identify/fit/fit.hpp"
#include "identify/fit/residual_warnings.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using identify::Fit;
using identify::RecordParameter;

namespace {

/// A loop under `law` whose force has a zero that is off, and that drifts from its first to its last sample [N].
identify::Record loop_with_zero(const std::string& law, double zero, double drift) {
  identify::Record record = test::loop_of(test::rig_with(test::law_case_of(law)), 5e-3, 0.01, 3);
  std::vector<double>& force = record.histories.front().force;
  for (std::size_t i = 0; i < force.size(); ++i)
    force[i] += zero + drift * static_cast<double>(i) / static_cast<double>(force.size() - 1);
  return record;
}

Fit fit_of_loop(const std::string& law, const identify::Record& record, bool seeks_zero) {
  std::string fault;
  const identify::Experiments loops = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  identify::Rig rig = test::loop_alone(test::rig_with(test::law_case_of(law)));
  std::vector<identify::FitParameter> sought = test::sought_in(rig, test::law_case_of(law).sought, 1.15);
  if (seeks_zero)
    sought.push_back(identify::parameter_of_record(*loops.at(0), 0, RecordParameter::offset_force, true));
  return identify::fit_rig(rig, sought, loops, {.profile = false});
}

}  // namespace

TEST_CASE("fit: the zero of the force of a loop is told, and sought if it is free", "[identify][fit][loop]") {
  for (const std::string law : {"coulomb", "dahl"}) {
    CAPTURE(law);
    const identify::Record record = loop_with_zero(law, 0.3, 0.0);
    const Fit told = fit_of_loop(law, record, false);
    REQUIRE(told.warnings.size() >= 1);
    CHECK_THAT(told.warnings.front(), Catch::Contains("'free' with offset_force"));
    const Fit fit = fit_of_loop(law, record, true);
    CHECK(fit.warnings.empty());
    CHECK(fit.noise_units < 1.1);
    const identify::FittedParameter& zero = test::fitted(fit, "offset_force");
    CHECK(zero.value == Approx(0.3).margin(4.0 * zero.std));
    // 0.01 N over the square root of 1001 samples.
    CHECK(zero.std < 0.001);
  }
}

TEST_CASE("fit: a drift of the force of a loop is named", "[identify][fit][loop]") {
  const Fit fit = fit_of_loop("coulomb", loop_with_zero("coulomb", 0.0, 0.2), false);
  REQUIRE(fit.warnings.size() >= 1);
  CHECK_THAT(fit.warnings.front(), Catch::Contains("changes by 0.2") && Catch::Contains("drifts"));
  for (const std::string& warning : fit.warnings) CHECK_THAT(warning, !Catch::Contains("offset"));
}

TEST_CASE("residuals: a harmonic that the signal lacks is not called outliers", "[identify][fit][loop]") {
  std::string fault;
  const identify::Record record = loop_with_zero("coulomb", 0.0, 0.0);
  const identify::Experiments loops = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  const Eigen::Index count = loops.front()->size();
  const auto warning_of = [&](const Eigen::VectorXd& misses) {
    Fit fit;
    fit.signals.push_back({.rows = {.end = count},
                           .rms = 0.1,
                           .noise = 0.01,
                           .noise_units = 10.0,
                           .independent = static_cast<double>(count),
                           .p_value = 0.5,
                           .misses = misses});
    identify::warn_of_residuals(loops, false, {0.0}, fit);
    REQUIRE(fit.warnings.size() == 1);
    return fit.warnings.front();
  };
  Eigen::VectorXd slow(count);
  for (Eigen::Index i = 0; i < count; ++i) slow[i] = 0.14 * std::sin(0.1 * static_cast<double>(i));
  CHECK_THAT(warning_of(slow), Catch::Contains("are not noise") && !Catch::Contains("outliers"));
  Eigen::VectorXd rough(count);
  for (Eigen::Index i = 0; i < count; ++i) rough[i] = 0.14 * std::sin(2.1 * static_cast<double>(i));
  CHECK_THAT(warning_of(rough), Catch::Contains("outliers"));
}

TEST_CASE("residuals: roughness of too few samples of a period is no noise", "[identify][fit]") {
  // Ten samples of a period of the drive: their differences of fourth order are those of the motion.
  identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  const identify::Record record = test::history_of(rig, {.duration = 3.0, .rate = 40.0}, 4);
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  std::vector<identify::FitParameter> sought = test::sought_in(rig, {"kinetic", "damping"}, 1.15);
  for (const RecordParameter each : experiments.front()->record_free)
    sought.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  const Fit fit = identify::fit_rig(rig, sought, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CHECK(std::isnan(fit.noise_units));
  REQUIRE(fit.warnings.size() >= 1);
  CHECK_THAT(fit.warnings.front(), Catch::Contains("'noise_units' is left out"));
}

TEST_CASE("fit: a search that is cut short gives the best estimates until then", "[identify][fit]") {
  const identify::Record record = test::history_of(test::rig_with(test::law_case_of("dahl")), {.duration = 1.0}, 5);
  const auto fit_within = [&](long most_work, long& work) {
    identify::Rig rig = test::rig_with(test::law_case_of("dahl"));
    std::string fault;
    const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
    std::vector<identify::FitParameter> sought = test::sought_in(rig, {"kinetic", "sigma0", "damping"}, 1.15);
    for (const RecordParameter each : experiments.front()->record_free)
      sought.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
    Fit fit = identify::fit_rig(rig, sought, experiments,
                                {.profile = false, .seeks_loads = false, .most_work = most_work});
    work = *experiments.front()->work;
    return fit;
  };
  long whole = 0;
  const Fit full = fit_within(400'000'000, whole);
  REQUIRE(full.outcome.ok());
  long spent = 0;
  // The first search over the whole history ends before two thirds of the work.
  const Fit cut = fit_within(whole / 4 * 3, spent);
  REQUIRE(cut.outcome.ok());
  REQUIRE(!cut.warnings.empty());
  CHECK_THAT(cut.warnings.front(), Catch::Contains("cut short") && Catch::Contains("the best until then"));
  CHECK(test::fitted(cut, "kinetic").value == Approx(test::fitted(full, "kinetic").value).epsilon(0.05));
  const Fit none = fit_within(whole / 1000, spent);
  CHECK_FALSE(none.outcome.ok());
}
