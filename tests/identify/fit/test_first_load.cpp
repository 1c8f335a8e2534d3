#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "friction_models/registry.hpp"
#include "identify/fit/prediction.hpp"
#include "sim/law_host/loaded_contacts.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

identify::Experiments loaded_experiments(const identify::Record& record) {
  std::string fault;
  identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  REQUIRE(fault.empty());
  return experiments;
}

/// A rig whose contacts yield after a millimetre: the first velocity makes up for the load of a stiff contact.
identify::Rig soft_rig(const std::string& law) {
  identify::Rig rig = test::rig_with(test::law_case_of(law));
  for (const char* stiffness : {"contact_stiffness", "sigma0", "stiffness"})
    if (rig.laws.front().values.has(stiffness)) rig.laws.front().values.set(stiffness, 1500.0);
  rig.laws.front().values.set("kinetic", 2.0);
  return rig;
}

/// A record of 1.5 s, begun `travel` behind an unloaded contact.
identify::Record record_after(const identify::Rig& rig, double travel, double velocity, std::uint64_t seed) {
  sim::Model model = *identify::model_of(rig);
  model.initial = {3e-3, velocity};
  REQUIRE(sim::load_contacts(model, travel));
  return test::history_of(rig, {.duration = 1.5, .initial = model.initial}, seed);
}

struct Sought {
  identify::Rig rig;
  std::vector<identify::FitParameter> parameters;
};

Sought sought_in(identify::Rig rig, const std::vector<std::string>& names,
                 const identify::Experiments& experiments) {
  std::vector<identify::FitParameter> parameters = test::sought_in(rig, names, 1.15);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  return {std::move(rig), std::move(parameters)};
}

void check_value(const identify::Fit& fit, const std::string& name, double truth) {
  const identify::FittedParameter* found = test::find_fitted(fit, name);
  REQUIRE(found != nullptr);
  CAPTURE(name, truth, found->value, found->std);
  CHECK(std::abs(found->value - truth) < 4.0 * found->std);
}

}  // namespace

TEST_CASE("fit: the load of a contact at the first sample is found", "[identify][fit][first_load]") {
  const auto [law, names, travel] = GENERATE(table<std::string, std::vector<std::string>, double>(
      {{"contact_compliance", {"kinetic", "contact_stiffness"}, 8e-4},
       {"contact_compliance", {"kinetic", "contact_stiffness"}, -8e-4},
       {"dahl", {"kinetic", "sigma0"}, -8e-4}}));
  const identify::Rig truth = soft_rig(law);
  const identify::Experiments experiments = loaded_experiments(record_after(truth, travel, 0.05, 5));
  const Sought sought = sought_in(truth, names, experiments);
  const identify::Fit fit = identify::fit_rig(sought.rig, sought.parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CAPTURE(law, travel, fit.noise_units);
  CHECK(fit.noise_units < 1.1);
  check_value(fit, "travel", travel);
  for (const std::string& name : names) check_value(fit, name, test::truth_of(truth, name));
  CHECK(std::ranges::any_of(fit.warnings, [](const std::string& warning) {
    return warning.find("the contacts were loaded when the record began") != std::string::npos;
  }));
}

TEST_CASE("fit: a contact that had yielded at the first sample is known, not sought",
          "[identify][fit][first_load]") {
  const identify::Rig truth = soft_rig("contact_compliance");
  const identify::Experiments experiments = loaded_experiments(record_after(truth, 5e-3, 0.1, 6));
  const Sought sought = sought_in(truth, {"kinetic", "contact_stiffness"}, experiments);
  const identify::Fit fit = identify::fit_rig(sought.rig, sought.parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CHECK(fit.noise_units < 1.1);
  CHECK(test::find_fitted(fit, "travel") == nullptr);
  CHECK(fit.of_records.front()[identify::RecordParameter::travel] > 1e-3);
  CHECK(fit.not_identifiable.empty());
  for (const char* name : {"kinetic", "contact_stiffness"}) check_value(fit, name, test::truth_of(truth, name));
}

TEST_CASE("fit: a record that begins unloaded is fitted without a load", "[identify][fit][first_load]") {
  const identify::Rig truth = soft_rig("contact_compliance");
  const identify::Experiments experiments = loaded_experiments(record_after(truth, 0.0, 0.05, 7));
  const Sought sought = sought_in(truth, {"kinetic", "contact_stiffness"}, experiments);
  const identify::Fit fit = identify::fit_rig(sought.rig, sought.parameters, experiments, {.profile = false});
  const identify::Fit plain =
      identify::fit_rig(sought.rig, sought.parameters, experiments, {.profile = false, .seeks_loads = false});
  REQUIRE(fit.outcome.ok());
  REQUIRE(fit.parameters.size() == plain.parameters.size());
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    CHECK(fit.parameters[i].value == plain.parameters[i].value);
    CHECK(fit.parameters[i].std == plain.parameters[i].std);
  }
}

TEST_CASE("prediction: a record that begins loaded does not make its law wrong", "[identify][fit][first_load]") {
  const identify::Rig truth = soft_rig("contact_compliance");
  const identify::Experiments first = loaded_experiments(record_after(truth, 0.0, 0.05, 8));
  const Sought sought = sought_in(truth, {"kinetic", "contact_stiffness"}, first);
  const identify::Fit fit = identify::fit_rig(sought.rig, sought.parameters, first, {.profile = false});
  REQUIRE(fit.outcome.ok());
  const double travel = GENERATE(-1e-3, 8e-4, 5e-3);
  const identify::Experiments second = loaded_experiments(record_after(truth, travel, -0.1, 9));
  const identify::Prediction found =
      identify::predict_records(fit.rig, sought.parameters, identify::shared_uncertainty(fit), second);
  REQUIRE(found.outcome.ok());
  CAPTURE(travel, found.text, found.compromise.p_value);
  CHECK(!found.is_wrong);
  CHECK(found.noise_units < 1.2);
  CHECK(found.compromise.p_value > 1e-3);
}

TEST_CASE("fit: a loop that begins with a loaded contact", "[identify][fit][first_load]") {
  const identify::Rig truth = soft_rig("contact_compliance");
  identify::Record record = test::loop_of(truth, 5e-3, 0.01, 11);
  identify::History& loop = record.histories.front();
  constexpr std::ptrdiff_t cut = 130;  // the contact has slipped by then
  for (std::vector<double>* signal : {&loop.x, &loop.v, &loop.force})
    signal->erase(signal->begin(), signal->begin() + cut);
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  REQUIRE(fault.empty());
  const Sought sought = sought_in(test::loop_alone(truth), {"kinetic", "contact_stiffness"}, experiments);
  const identify::Fit fit = identify::fit_rig(sought.rig, sought.parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CHECK(fit.noise_units < 1.1);
  for (const char* name : {"kinetic", "contact_stiffness"}) check_value(fit, name, test::truth_of(truth, name));
}

TEST_CASE("fit: a record whose zero is off does not multiply the searches of a joint fit",
          "[identify][fit][first_load]") {
  const identify::Rig truth = soft_rig("contact_compliance");
  identify::Experiments experiments = loaded_experiments(record_after(truth, 0.0, 0.05, 5));
  identify::Record off = record_after(truth, 0.0, -0.1, 6);
  for (double& x : off.histories.front().x) x += 4e-4;
  experiments.push_back(std::move(loaded_experiments(off).front()));
  Sought sought = sought_in(truth, {"kinetic", "contact_stiffness"}, experiments);
  for (const identify::RecordParameter each : experiments.back()->record_free)
    sought.parameters.push_back(identify::parameter_of_record(*experiments.back(), 1, each, false));
  const identify::Fit fit = identify::fit_rig(sought.rig, sought.parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  CHECK_FALSE(fit.warnings.empty());
  check_value(fit, "kinetic", 2.0);
  long work = 0;
  for (const auto& experiment : experiments) work += *experiment->work;
  // With all steps of a search for each load, and the same minimum ended three times, it was 2 020 000.
  CHECK(work < 800'000);
}
