#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/random.hpp"
#include "identify/fit/fit.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using identify::Fit;
using identify::FittedParameter;
using identify::Record;

namespace {

/// A decay of ten swings, sampled 60 times in each: `signals` of x, v and a, with noise of 0.5 % of the first swing
/// and with these zeros of v and a, in parts of the largest v and a.
Record decay_with_zeros(const identify::Rig& rig, const std::string& signals, double of_v, double of_a) {
  sim::Model model = *identify::model_of(rig);
  constexpr double release = 0.026;
  model.initial = {release, 0.0};
  const double omega = std::sqrt(model.oscillator.stiffness / model.oscillator.mass);
  identify::History history;
  history.sample_rate = 60.0 * omega / (2.0 * std::numbers::pi);
  const auto motion =
      sim::simulate(model, {.duration = 600.0 / history.sample_rate, .sample_rate = history.sample_rate});
  const core::RandomStream stream{7, 904};
  std::uint64_t next = 0;
  const auto noise = [&] { return 0.005 * stream.normal(next++); };
  const auto has = [&](char signal) { return signals.find(signal) != std::string::npos; };
  for (const sim::Sample& sample : motion.samples) {
    const double speed = release * omega;
    if (has('x')) history.x.push_back(sample.x + release * noise());
    if (has('v')) history.v.push_back(sample.v + speed * (noise() + of_v));
    if (has('a')) history.a.push_back(sample.a + speed * omega * (noise() + of_a));
  }
  Record record;
  record.histories.push_back(std::move(history));
  return record;
}

/// A fit of friction and damping, with the parameters of the record that a fit seeks by itself and `also`.
Fit fit_of_zeros(const identify::Rig& truth, const Record& record,
                 std::optional<identify::RecordParameter> also = {}) {
  identify::Rig sought = truth;
  sought.known.oscillator.damping = identify::unknown;
  sought.laws[0].values = {};
  std::vector<std::string> faults;
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record"}, fault);
  std::vector<identify::FitParameter> parameters = identify::unstated_parameters(sought, faults);
  std::vector<identify::RecordParameter> free = identify::sought_of_record(*experiments.at(0), true);
  if (also) free.push_back(*also);
  for (const identify::RecordParameter each : free)
    parameters.push_back(identify::parameter_of_record(*experiments[0], 0, each, true));
  return identify::fit_rig(sought, std::move(parameters), experiments, {.profile = false});
}

identify::Rig free_rig(double damping) {
  identify::Rig truth = test::rig_with(test::law_case_of("coulomb"));
  truth.known.excitation = {};
  truth.known.oscillator.damping = damping;
  return truth;
}

}  // namespace

TEST_CASE("fit: a zero of a or v that would carry the mass away is sought", "[identify][fit]") {
  // Of an acceleration alone, a zero of 2 % of its largest value had led the search to a friction 70 times too
  // large. The second rig is at rest after three swings.
  for (const double damping : {0.3, 12.0})
    for (const std::string signals : {"a", "v", "xa"}) {
      CAPTURE(damping, signals);
      const identify::Rig truth = free_rig(damping);
      const double zero = signals == "v" ? 0.08 : 0.02;
      const Fit fit = fit_of_zeros(truth, decay_with_zeros(truth, signals, zero, zero));
      REQUIRE(fit.outcome.ok());
      CHECK(fit.noise_units < 1.1);
      CHECK(test::fitted(fit, "damping").value == Approx(damping).margin(4.0 * test::fitted(fit, "damping").std));
      CHECK(test::fitted(fit, "kinetic").value ==
            Approx(test::truth_of(truth, "kinetic")).margin(4.0 * test::fitted(fit, "kinetic").std));
      const FittedParameter& found = test::fitted(fit, signals == "v" ? "offset_v" : "offset_a");
      const double omega = std::sqrt(truth.known.oscillator.stiffness / truth.known.oscillator.mass);
      const double largest = 0.026 * omega * (signals == "v" ? 1.0 : omega);
      CHECK(found.value == Approx(zero * largest).margin(5.0 * found.std));
      REQUIRE(fit.warnings.size() == 1);
      CHECK_THAT(fit.warnings.front(), Catch::Contains("would carry the mass away"));
    }
}

TEST_CASE("fit: a small zero of a or v is told, and sought if it is free", "[identify][fit]") {
  const identify::Rig truth = free_rig(0.3);
  const auto are_sought = [](const Fit& fit) {
    return std::ranges::any_of(fit.parameters, [](const FittedParameter& fitted) {
      return fitted.parameter.name == "offset_v" || fitted.parameter.name == "offset_a";
    });
  };
  for (const std::string signals : {"a", "v", "xva"}) {
    CAPTURE(signals);
    const Fit none = fit_of_zeros(truth, decay_with_zeros(truth, signals, 0.0, 0.0));
    CHECK(none.warnings.empty());
    CHECK_FALSE(are_sought(none));
    const Fit told = fit_of_zeros(truth, decay_with_zeros(truth, signals, 0.003, 0.003));
    CHECK_FALSE(are_sought(told));
    REQUIRE(told.warnings.size() == (signals == "xva" ? 2 : 1));
    CHECK_THAT(told.warnings.back(),
               Catch::Contains(signals == "v" ? "'free' with offset_v" : "'free' with offset_a"));
  }
  const Fit found =
      fit_of_zeros(truth, decay_with_zeros(truth, "a", 0.0, 0.003), identify::RecordParameter::offset_a);
  CHECK(found.warnings.empty());
  const double stiffness_by_mass = truth.known.oscillator.stiffness / truth.known.oscillator.mass;
  CHECK(test::fitted(found, "offset_a").value ==
        Approx(0.003 * 0.026 * stiffness_by_mass).margin(4.0 * test::fitted(found, "offset_a").std));
}
