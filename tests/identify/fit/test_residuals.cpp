#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "identify/fit/comparison.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/statistics/noise_between_jumps.hpp"
#include "identify/statistics/noise_level.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using identify::Fit;
using identify::Signal;

namespace {

/// `motion` of the frequency 0.1 per sample, and white noise of deviation one.
Eigen::VectorXd noisy(std::size_t count, std::uint64_t seed, double motion) {
  const core::RandomStream draws{seed, 920};
  Eigen::VectorXd samples(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    samples[static_cast<Eigen::Index>(i)] = draws.normal(i) + motion * std::cos(0.1 * static_cast<double>(i));
  return samples;
}

/// The chance of the residuals that a fit leaves of a sine, whose deviation they have `level` times.
double p_value_of(Eigen::VectorXd residuals, double level, double fitted_amplitude = 1.0) {
  residuals *= level / std::sqrt(2.0);
  const auto count = static_cast<std::size_t>(residuals.size());
  Signal signal{.name = "x", .unit = "m", .is_sampled = true};
  Eigen::VectorXd outputs(residuals.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    outputs[at] = fitted_amplitude * std::sin(0.1 * static_cast<double>(i));
    signal.measured.push_back(outputs[at] - residuals[at]);
  }
  return identify::noise_p_value(signal, outputs, residuals, 3);
}

}  // namespace

TEST_CASE("residuals: the test for noise keeps its level, and finds a motion below the noise", "[identify][fit]") {
  constexpr std::size_t count = 997;  // a prime: the transform takes a shorter length
  // Noise from that of a good sensor up to half of the signal.
  for (const double level : {0.01, 0.12, 0.5}) {
    CAPTURE(level);
    int below = 0;
    int in_half = 0;
    constexpr std::uint64_t seeds = 400;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const double p_value = p_value_of(noisy(count, seed, 0.0), level);
      below += p_value < 0.05 ? 1 : 0;
      in_half += p_value < 0.5 ? 1 : 0;
    }
    // 5 % and a half of 400 with standard deviations of 4.4 and 10.
    CHECK(below > 20 - 18);
    CHECK(below < 20 + 18);
    CHECK(std::abs(in_half - 200) < 40);
    // 0.35 of the noise adds 6 % to the variance; of chi-square with 16 degrees of freedom and noncentrality 61,
    // 99 % lie beyond its level of 0.001, 39.3.
    int found = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
      found += p_value_of(noisy(count, seed, 0.35), level) < 1e-3 ? 1 : 0;
    CHECK(found >= 17);
  }
}

TEST_CASE("residuals: a motion that the fitted one lacks altogether is no noise", "[identify][fit]") {
  // The fit leaves all of the sine, of 7 times the noise.
  for (std::uint64_t seed = 0; seed < 10; ++seed) CHECK(p_value_of(noisy(997, seed, 7.0), 0.2, 0.0) < 1e-6);
}

TEST_CASE("residuals: jumps and kinks of a force are no noise", "[identify][fit]") {
  // 64 reversals of a contact that yields within some samples, and of one that yields within less than a sample. A
  // third of the differences holds a part of the motion: with those of them that pass for noise, the first has 1.4
  // times the noise.
  const core::RandomStream draws{5, 921};
  constexpr std::size_t count = 2000;
  constexpr double deviation = 0.01;
  for (const double stiffness : {4.0, 40.0}) {
    CAPTURE(stiffness);
    std::vector<double> force;
    std::vector<double> smooth;
    double spring = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double noise = deviation * draws.normal(i);
      const double phase = 0.1 * static_cast<double>(i);
      spring = std::clamp(spring + stiffness * std::cos(phase), -1.0, 1.0);
      force.push_back(spring + noise);
      smooth.push_back(std::sin(phase) + noise);
    }
    // The standard error of a noise level by 1000 fourth differences is some 3 %.
    CHECK(identify::noise_between_jumps(force) == Approx(deviation).epsilon(0.08));
    CHECK(identify::noise_between_jumps(smooth) == Approx(identify::robust_noise_level(smooth)).epsilon(0.01));
  }
  CHECK(identify::noise_between_jumps(std::vector<double>{1.0, 2.0}) == 0.0);
}

TEST_CASE("residuals: readings with a stated noise are compared with it", "[identify][fit]") {
  Signal signal{
      .name = "x", .unit = "m", .measured = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, .noise = 0.1, .is_stated = true};
  const Eigen::VectorXd small = Eigen::VectorXd::Constant(6, 0.1);
  // chi-square of 4 degrees of freedom: P(>= 6) = 0.1991, P(>= 54) = 5.2e-11.
  CHECK(identify::noise_p_value(signal, small, small, 2) == Approx(0.19915).epsilon(1e-3));
  CHECK(identify::noise_p_value(signal, small, 3.0 * small, 2) < 1e-9);
  signal.is_stated = false;
  CHECK(std::isnan(identify::noise_p_value(signal, small, small, 2)));
}

TEST_CASE("residuals: a fit that leaves more than noise says so", "[identify][fit]") {
  const test::LawCase& law = test::law_case_of("stribeck");
  CHECK(test::fit_of(law, 5, {}, false).warnings.empty());
  // Coulomb friction and damping follow that motion within a few times the noise.
  identify::Rig rig = test::rig_with(law);
  const identify::Record record = test::history_of(rig, {}, 5);
  rig.laws.front() = test::rig_with(test::law_case_of("coulomb")).laws.front();
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "record.csv"}, fault);
  std::vector<identify::FitParameter> parameters = test::sought_in(rig, {"kinetic", "damping"}, 1.2);
  for (const identify::RecordParameter each : experiments.front()->record_free)
    parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
  const Fit fit = identify::fit_rig(rig, parameters, experiments, {.profile = false});
  REQUIRE(fit.outcome.ok());
  REQUIRE(fit.warnings.size() == 1);
  CHECK_THAT(fit.warnings.front(),
             Catch::StartsWith("record.csv: the residuals of x") && Catch::Contains("are not noise"));
}

TEST_CASE("residuals: a few spikes are named with the option that limits their influence", "[identify][fit]") {
  const test::LawCase& law = test::law_case_of("coulomb");
  identify::Record record = test::history_of(test::rig_with(law), {}, 6);
  std::vector<double>& x = record.histories.front().x;
  for (const std::size_t i : {x.size() / 5, x.size() / 3, x.size() / 2, x.size() - 20})
    x[i] += 0.4 * std::ranges::max(x);
  const auto warnings = [&](bool robust) {
    identify::Rig rig = test::rig_with(law);
    std::string fault;
    const identify::Experiments experiments = identify::experiments_of(record, {.name = "record.csv"}, fault);
    std::vector<identify::FitParameter> parameters = test::sought_in(rig, {"kinetic"}, 1.2);
    for (const identify::RecordParameter each : experiments.front()->record_free)
      parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
    return identify::fit_rig(rig, std::move(parameters), experiments, {.robust = robust, .profile = false})
        .warnings;
  };
  REQUIRE(warnings(false).size() == 1);
  CHECK_THAT(warnings(false).front(), Catch::StartsWith("record.csv: 4 readings of x are outliers") &&
                                          Catch::Contains("(t = ") &&
                                          Catch::Contains("limit the influence with 'robust'"));
  REQUIRE(warnings(true).size() == 1);
  CHECK_THAT(warnings(true).front(), Catch::StartsWith("record.csv: 4 readings of x are outliers") &&
                                         Catch::Contains("'robust' limits the influence on the estimates"));
}

TEST_CASE("residuals: the size of those of a robust fit is that without outliers", "[identify][fit]") {
  identify::Rig rig = test::rig_with(test::law_case_of("coulomb"));
  std::vector<std::pair<double, double>> levels;
  for (int i = 0; i < 14; ++i) levels.emplace_back(0.002 + 0.0008 * i, rig.known.excitation.frequency);
  identify::Record record = test::steady_states_of(rig, levels, 1e-5, 3e-3, 5);
  record.pairs->pairs[6].x *= 1.6;
  for (const double sigma : {0.0, 1e-5}) {
    CAPTURE(sigma);
    std::string fault;
    const identify::Experiments experiments =
        identify::experiments_of(record, {.name = "record.csv", .sigma_x = sigma}, fault);
    const Fit fit = identify::fit_rig(rig, test::sought_in(rig, {"kinetic", "damping"}, 1.2), experiments,
                                      {.robust = true, .profile = false});
    REQUIRE(fit.outcome.ok());
    if (sigma > 0.0) CHECK(fit.noise_units < 2.0);
    REQUIRE(fit.warnings.size() == 1);
    CHECK_THAT(fit.warnings.front(), Catch::StartsWith("record.csv: 1 reading of x is an outlier"));
  }
}

TEST_CASE("residuals: a stated noise that is ten times off is told, and intervals are never too narrow for it",
          "[identify][fit]") {
  const test::LawCase& law = test::law_case_of("coulomb");
  const identify::Record record = test::history_of(test::rig_with(law), {}, 6);
  const auto fit_with = [&](double sigma) {
    identify::Rig rig = test::rig_with(law);
    std::string fault;
    const identify::Experiments experiments =
        identify::experiments_of(record, {.name = "record.csv", .sigma_x = sigma}, fault);
    std::vector<identify::FitParameter> parameters = test::sought_in(rig, {"kinetic"}, 1.2);
    for (const identify::RecordParameter each : experiments.front()->record_free)
      parameters.push_back(identify::parameter_of_record(*experiments.front(), 0, each, true));
    return identify::fit_rig(rig, std::move(parameters), experiments, {.profile = false});
  };
  const Fit right = fit_with(1e-5);
  CHECK(right.warnings.empty());
  CHECK(right.signals.front().chi2_per_freedom == Approx(1.0).margin(0.2));
  const Fit small = fit_with(1e-6);
  REQUIRE(small.warnings.size() == 1);
  CHECK_THAT(small.warnings.front(), Catch::Contains("the stated noise is too small"));
  CHECK(small.parameters[0].std == Approx(right.parameters[0].std).epsilon(0.1));
  const Fit large = fit_with(1e-4);
  REQUIRE(large.warnings.size() == 1);
  CHECK_THAT(large.warnings.front(), Catch::Contains("the stated noise is too large"));
  CHECK(large.parameters[0].std > 5.0 * right.parameters[0].std);
}

TEST_CASE("residuals: laws are compared by what is left where the stated noise is wrong", "[identify][fit]") {
  const auto with = [](double rms, double noise) {
    Fit fit;
    fit.signals.push_back({.rows = {.end = 100}, .rms = rms, .range = 1.0, .noise = noise, .independent = 100.0});
    identify::compare_with_stated(rms, 100.0, fit.signals.front());
    fit.log_likelihood_count = 100.0;
    return fit;
  };
  // 5 % more of the residuals: 100 ln 1.05^2 = 9.8 by their own size, 100 (1.05^2 - 1) = 10.25 by the noise.
  std::vector<Fit> as_stated = {with(0.1, 0.1), with(0.105, 0.1)};
  identify::compare_fits(as_stated);
  CHECK(as_stated[1].AICc - as_stated[0].AICc == Approx(10.25));
  std::vector<Fit> too_small = {with(0.1, 0.01), with(0.105, 0.01)};
  identify::compare_fits(too_small);
  CHECK(too_small[1].AICc - too_small[0].AICc == Approx(9.758).margin(1e-3));
}

TEST_CASE("residuals: extremes that do not alternate are refused", "[identify][fit]") {
  const auto fault_of = [](std::vector<double> extremes) {
    identify::Record record;
    record.decay = identify::DecayRecord{std::move(extremes), {}};
    std::string fault;
    const bool is_refused = identify::experiments_of(record, {.name = "record"}, fault).empty();
    CHECK(is_refused == !fault.empty());
    return fault;
  };
  CHECK(fault_of({5.0, -4.0, 3.0, -2.0, 1.0, 1.0}).empty());  // at rest
  CHECK_THAT(fault_of({5.0, 4.0, 3.0, 2.0}), Catch::Contains("number 2 lies between its neighbours"));
  CHECK_THAT(fault_of({5.0, 4.0, 4.2, 3.1, 3.0, 3.3}), Catch::Contains("number 4 lies between its neighbours"));
}
