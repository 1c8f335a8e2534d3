#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "identify/fit/fit.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using identify::Fit;
using identify::FittedParameter;

namespace {

const FittedParameter& estimate_in(const Fit& fit, const std::string& name) {
  for (const FittedParameter& fitted : fit.parameters)
    if (fitted.parameter.name == name) return fitted;
  throw std::invalid_argument("there is no parameter " + name);
}

}  // namespace

TEST_CASE("fit: intervals beside a parameter at its bound hold what trades with it", "[identify][fit]") {
  // Of v alone, a constant force is a displacement: the levels of both directions and the first position are known
  // up to one number. The search ends where a level is zero. The profiles stayed there, because the static level
  // has nearly no effect and ran away: position 0.99 to 1.001 mm, true 2 mm.
  identify::Rig truth = test::rig_with(
      {"asymmetric_coulomb",
       {{"kinetic_forward", 2.0}, {"kinetic_backward", 1.0}, {"static_forward", 2.5}, {"static_backward", 1.2}},
       {"kinetic_forward"}});
  identify::Record record = test::history_of(truth, {.duration = 3.0, .noise_v = 4e-4, .initial = {2e-3, 0.01}}, 1);
  record.histories.front().x.clear();
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  REQUIRE(fault.empty());
  identify::Rig sought = truth;
  sought.laws.front().values = {};
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> parameters = identify::unstated_parameters(sought, faults);
  for (const char* name : {"static_forward", "static_backward"})
    for (identify::FitParameter& parameter : identify::named(identify::parameters_of(sought), name, fault))
      parameters.push_back(std::move(parameter));
  identify::arrange(sought, parameters);
  for (const identify::Own own : experiments.front()->own_free)
    parameters.push_back(identify::own_parameter(*experiments.front(), 0, own, true));
  const Fit fit = identify::fit_rig(sought, parameters, experiments);
  REQUIRE(fit.outcome.ok());
  for (const auto& [name, true_value] : {std::pair{"kinetic_forward", 2.0},
                                         {"kinetic_backward", 1.0},
                                         {"static_backward", 1.2},
                                         {"position", 2e-3}}) {
    const FittedParameter& fitted = estimate_in(fit, name);
    CAPTURE(name, fitted.value, fitted.interval95[0], fitted.interval95[1], fitted.reason);
    CHECK((std::isnan(fitted.interval95[0]) || fitted.interval95[0] <= true_value));
    CHECK((std::isnan(fitted.interval95[1]) || fitted.interval95[1] >= true_value));
  }
}
