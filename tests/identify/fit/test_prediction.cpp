#include "identify/fit/prediction.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "identify/fit/assumed_drive.hpp"
#include "tests/identify/fit/random_rigs.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

identify::Experiments experiments_of(const identify::Record& record, double sigma = 0.0) {
  std::string fault;
  identify::Experiments experiments = identify::experiments_of(record, {.name = "record", .sigma_x = sigma}, fault);
  REQUIRE(fault.empty());
  return experiments;
}

/// Fits `law` to a record of the true rig, and predicts another one at less than its amplitude, with this stated
/// noise.
identify::Prediction prediction_by(const std::string& law, std::vector<std::string> names, double sigma = 0.0) {
  const identify::Rig truth = test::rig_with(test::law_case_of("stribeck"));
  const identify::Experiments first = experiments_of(test::history_of(truth, {.noise_x = 2e-5}, 31));
  identify::Rig quieter = truth;
  quieter.known.excitation.amplitude *= 0.6;
  const identify::Experiments second = experiments_of(test::history_of(quieter, {.noise_x = 2e-5}, 32), sigma);
  identify::Rig rig = truth;
  if (law != "stribeck") rig.laws = {{friction::find_law(law), {{"kinetic", 1.2}}}};
  std::vector<identify::FitParameter> parameters = test::sought_in(rig, names, 1.2);
  for (const identify::RecordParameter each : first.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*first.front(), 0, each, true));
  identify::Fit fit = identify::fit_rig(rig, parameters, first, {.profile = false});
  REQUIRE(fit.outcome.ok());
  fit.rig.known.excitation.amplitude *= 0.6;
  return identify::predict_records(fit.rig, parameters, identify::shared_uncertainty(fit), second);
}

/// A loop at a speed of constant size, with the force 2 N + 5 N.s/m |v| and noise of 0.01 N.
identify::Experiments loop_at(double speed, std::uint64_t seed) {
  identify::History loop{.sample_rate = 500.0};
  const core::RandomStream draws{seed, 1};
  constexpr std::uint64_t samples = 1000;
  constexpr std::uint64_t stroke = 125;
  double x = 0.0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double sign = i / stroke % 2 == 0 ? 1.0 : -1.0;
    loop.x.push_back(x);
    loop.v.push_back(sign * speed);
    loop.force.push_back(sign * (2.0 + 5.0 * speed) + 0.01 * draws.normal(i));
    x += sign * speed / loop.sample_rate;
  }
  identify::Record record;
  record.histories = {std::move(loop)};
  std::string fault;
  identify::Experiments experiments = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  REQUIRE(fault.empty());
  return experiments;
}

}  // namespace

TEST_CASE("prediction: the right law comes within 10 % of what it can reach", "[identify][fit]") {
  const identify::Prediction right = prediction_by("stribeck", {"kinetic", "static", "stribeck_velocity"});
  REQUIRE(right.outcome.ok());
  CAPTURE(right.text, right.error, right.attainable, right.uncertainty);
  CHECK(right.error < 1.1 * right.attainable);
  CHECK(!right.is_wrong);
  CHECK_THAT(right.text, Catch::Contains("the law also describes this record"));
  // Bands add up to the whole.
  double sum = 0.0;
  for (const identify::PredictionBand& band : right.bands) sum += band.error * band.error;
  CHECK(std::sqrt(sum) == Approx(right.error).epsilon(0.02));
}

TEST_CASE("prediction: a stated noise that is far from the residuals is told with both", "[identify][fit]") {
  const std::vector<std::string> names = {"kinetic", "static", "stribeck_velocity"};
  CHECK(prediction_by("stribeck", names, 2e-5).warnings.empty());
  for (const double sigma : {2e-6, 2e-4}) {
    CAPTURE(sigma);
    const identify::Prediction found = prediction_by("stribeck", names, sigma);
    REQUIRE(found.warnings.size() == 1);
    CHECK_THAT(found.warnings.front(),
               Catch::StartsWith("record: the residuals of x are ") && Catch::Contains("they scatter by 2e-05 m") &&
                   Catch::Contains(sigma < 2e-5 ? "and 2e-06 m is stated" : "and 0.0002 m"));
  }
}

TEST_CASE("prediction: an own fit that ends beside the prediction proves nothing against the law",
          "[identify][fit]") {
  // The search for what the law attains ended at 1.28 times the noise, the prediction at 0.99 times.
  const test::RandomRig rig = test::random_rig("contact_compliance", test::MotionKind::forced, 8);
  const test::RandomRig second = test::driven_again(rig, 1.5, 100'008);
  const identify::Fit fit = test::fit_of(rig);
  REQUIRE(fit.outcome.ok());
  const identify::Prediction found = test::predicted_by(fit, second);
  CAPTURE(found.text);
  CHECK(found.noise_units == Approx(1.0).margin(0.1));
  CHECK(found.attainable_noise_units <= found.noise_units);
  CHECK(!found.is_wrong);
}

TEST_CASE("prediction: a wrong law is called wrong", "[identify][fit]") {
  const identify::Prediction wrong = prediction_by("coulomb", {"kinetic"});
  REQUIRE(wrong.outcome.ok());
  CAPTURE(wrong.text, wrong.error, wrong.attainable, wrong.uncertainty);
  CHECK(wrong.is_wrong);
  CHECK_THAT(wrong.text, Catch::Contains("the law is wrong"));
  CHECK(wrong.noise_units > 2.0);
}

TEST_CASE("prediction: one rig against two tells a wrong law that the own fit does not", "[identify][fit]") {
  // Coulomb friction suits either record of a Stribeck rig by itself, with other numbers: its own fit of the second
  // leaves the noise, the prediction three times as much.
  const test::RandomRig rig = test::random_rig("stribeck", test::MotionKind::forced, 1);
  const test::RandomRig second = test::driven_again(rig, 1.5, 100'000 + 1);
  const auto predicted_as = [&](const char* law) {
    test::RandomRig other = rig;
    other.sought.laws.front() = {friction::find_law(law), {}};
    const identify::Fit fit = test::fit_of(other);
    REQUIRE(fit.outcome.ok());
    return test::predicted_by(fit, second);
  };
  const identify::Prediction wrong = predicted_as("coulomb");
  CAPTURE(wrong.text, wrong.compromise.statistic);
  CHECK(wrong.attainable_noise_units < 1.2);
  CHECK(wrong.compromise.p_value < 1e-3);
  CHECK(wrong.is_wrong);
  CHECK_THAT(wrong.text, Catch::Contains("no single set of parameters"));
  const identify::Prediction right = predicted_as("stribeck");
  CAPTURE(right.text, right.compromise.statistic);
  CHECK(right.compromise.p_value > 1e-3);
  CHECK(!right.is_wrong);
}

TEST_CASE("prediction: a record without motion is not judged", "[identify][fit]") {
  const test::RandomRig rig = test::random_rig("coulomb", test::MotionKind::forced, 1);
  identify::Record still = rig.record;
  for (std::vector<double>* signal : {&still.histories.front().x, &still.histories.front().v})
    std::ranges::fill(*signal, 0.0);
  identify::Rig held = rig.truth;
  held.known.excitation.amplitude = 0.0;
  const identify::Prediction found = identify::predict_records(held, {}, {}, experiments_of(still));
  CHECK(!found.is_wrong);
  CHECK_THAT(found.text, Catch::Contains("no motion"));
}

TEST_CASE("prediction: a record tells that the drive assumed for it is not there, or that one is missing",
          "[identify][fit]") {
  const identify::Rig driven = test::rig_with(test::law_case_of("coulomb"));
  identify::Rig undriven = driven;
  undriven.known.excitation = {};
  const auto held = [](const identify::Rig& rig, const identify::Experiments& data) {
    std::vector<identify::FitParameter> own;
    for (const identify::RecordParameter each : data.front()->record_free)
      own.push_back(identify::parameter_of_record(*data.front(), 0, each, true));
    return identify::fit_rig(rig, own, data, {.profile = false});
  };
  const identify::Experiments forced = experiments_of(test::history_of(driven, {}, 41));
  const double release = 20.0 * test::truth_of(undriven, "kinetic") / undriven.known.oscillator.stiffness;
  const identify::Experiments free = experiments_of(test::history_of(undriven, {.initial = {release, 0.0}}, 42));

  const auto found = identify::undriven_record(driven, held(driven, free), free);
  REQUIRE(found);
  CHECK(found->experiment == 0);
  CHECK(found->without_drive < 0.02);
  CHECK_FALSE(identify::undriven_record(driven, held(driven, forced), forced));
  CHECK(identify::record_with_unknown_drive(held(undriven, forced), forced) == 0U);
  CHECK_FALSE(identify::record_with_unknown_drive(held(undriven, free), free));
}

TEST_CASE("prediction: a loop has no parameter of its own, under a law that remembers the path as well",
          "[identify][fit]") {
  const auto loop = [](const identify::Record& record) {
    std::string fault;
    identify::Experiments experiments = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
    REQUIRE(fault.empty());
    return experiments;
  };
  constexpr double noise = 0.01;
  identify::Rig rig = test::loop_alone(test::rig_with(test::law_case_of("dahl")));
  const identify::Experiments first = loop(test::loop_of(rig, 5e-3, noise, 1));
  const identify::Record other = test::loop_of(rig, 3e-3, noise, 2);
  const identify::Experiments second = loop(other);
  REQUIRE(second.front()->record_free.empty());
  const std::vector<identify::FitParameter> parameters = test::sought_in(rig, {"kinetic", "sigma0"}, 1.15);
  const identify::Fit fit = identify::fit_rig(rig, parameters, first, {.profile = false});
  REQUIRE(fit.outcome.ok());
  const identify::SharedUncertainty known = identify::shared_uncertainty(fit);
  const identify::Prediction right = identify::predict_records(fit.rig, parameters, known, second);
  CAPTURE(right.text);
  REQUIRE(right.outcome.ok());
  CHECK(right.fit.parameters.empty());
  CHECK(!right.is_wrong);
  CHECK(right.noise_units == Approx(1.0).margin(0.1));
  CHECK(right.error < 1.1 * right.attainable);
  // The second half begins with a loaded contact: the load is sought although nothing else is.
  identify::Record cut = other;
  identify::History& history = cut.histories.front();
  for (std::vector<double>* signal : {&history.x, &history.v, &history.force})
    signal->erase(signal->begin(), signal->begin() + static_cast<std::ptrdiff_t>(signal->size() / 2));
  const identify::Prediction loaded = identify::predict_records(fit.rig, parameters, known, loop(cut));
  CAPTURE(loaded.text);
  CHECK(loaded.noise_units < 1.2);
  CHECK(!loaded.is_wrong);
}

TEST_CASE("prediction: what the fit does not determine proves nothing against the law", "[identify][fit]") {
  // At one speed V, the force shows the friction force F plus V times the damping c, and neither of the two.
  identify::Rig rig = test::loop_alone({.laws = {{friction::find_law("coulomb"), {{"kinetic", 1.0}}}}});
  rig.known.oscillator.damping = 20.0;
  const std::vector<identify::FitParameter> parameters = test::sought_in(rig, {"kinetic", "damping"}, 1.0);
  const identify::Fit fit = identify::fit_rig(rig, parameters, loop_at(0.1, 1), {.profile = false, .starts = 1});
  REQUIRE(fit.outcome.ok());
  REQUIRE(fit.undetermined.cols() == 1);
  const double kinetic = fit.parameters[0].value;
  const double damping = fit.parameters[1].value;
  CHECK(kinetic + 0.1 * damping == Approx(2.5).epsilon(1e-3));
  REQUIRE(std::abs(damping - 5.0) > 1.0);
  CHECK(fit.undetermined(0, 0) == Approx(-0.1 * fit.undetermined(1, 0)).epsilon(1e-3));
  const identify::SharedUncertainty known = identify::shared_uncertainty(fit);
  const identify::Prediction faster = identify::predict_records(fit.rig, parameters, known, loop_at(0.3, 2));
  CAPTURE(faster.text, faster.error, faster.compromise.statistic);
  CHECK(faster.error > 0.1);
  CHECK(faster.compromise.freedom == 1.0);
  CHECK(faster.compromise.p_value > 1e-3);
  CHECK(!faster.is_wrong);
  CHECK(std::isnan(faster.uncertainty));
  // At the speed of the fit, nothing is open; and what the fit does determine can prove a law wrong.
  const identify::Prediction same = identify::predict_records(fit.rig, parameters, known, loop_at(0.1, 3));
  CHECK(same.uncertainty < 0.01);
  identify::Rig other = fit.rig;
  other.laws[0].values = {{"kinetic", kinetic + 0.5}};
  const identify::Prediction wrong = identify::predict_records(other, parameters, known, loop_at(0.1, 3));
  CHECK(wrong.compromise.p_value < 1e-3);
  CHECK(wrong.is_wrong);
}
