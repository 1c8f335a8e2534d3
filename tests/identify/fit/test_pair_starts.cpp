#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "friction_models/registry.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/problem.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

/// Near resonance: the force of the spring is 30 times that of the drive, and 380 times the friction.
identify::Rig resonant_rig(const std::string& law) {
  identify::Rig rig;
  rig.known.oscillator = {.mass = 1.042, .stiffness = 1568.0, .damping = 1.2};
  rig.known.excitation.type = sim::ExcitationType::base_harmonic;
  friction::ParameterValues values = {{"kinetic", 2.0}};
  if (law == "contact_compliance") values.set("contact_stiffness", 6000.0);
  rig.laws.push_back({friction::find_law(law), values});
  return rig;
}

identify::Experiments states_of(const identify::Rig& rig, double from, double to, bool with_phases,
                                std::uint64_t seed) {
  std::vector<std::pair<double, double>> levels;
  constexpr int count = 8;
  for (int i = 0; i < count; ++i) levels.emplace_back(from + (to - from) * i / (count - 1), 38.79);
  identify::Record record = test::steady_states_of(rig, levels, 1e-4, 2e-3, seed);
  if (!with_phases)
    for (identify::Pair& pair : record.pairs->pairs) pair.phase = identify::unknown;
  std::string fault;
  identify::Experiments experiments = identify::experiments_of(record, {.name = "pairs"}, fault);
  REQUIRE(fault.empty());
  return experiments;
}

/// A fit that begins without any value of the law.
identify::Fit fit_of(identify::Rig rig, const identify::Experiments& experiments) {
  rig.known.oscillator.damping = identify::unknown;
  rig.laws.front().values = {};
  std::vector<std::string> faults;
  std::vector<identify::FitParameter> sought = identify::unstated_parameters(rig, faults);
  REQUIRE(faults.empty());
  identify::arrange(rig, sought);
  return identify::fit_rig(rig, sought, experiments, {.profile = false});
}

}  // namespace

TEST_CASE("fit: pairs near resonance start from the energy of the states", "[identify][fit][pairs]") {
  const identify::Rig truth = resonant_rig("coulomb");
  for (const bool with_phases : {false, true}) {
    const identify::Experiments experiments = states_of(truth, 4e-3, 16e-3, with_phases, 3);
    const identify::DataScale scale = identify::scale_of(truth, experiments);
    CAPTURE(with_phases);
    CHECK(scale.friction == Approx(2.0).epsilon(0.1));
    CHECK(scale.damping == Approx(1.2).epsilon(0.02));
  }
}

TEST_CASE("fit: pairs of a contact that yields little end at the best fit", "[identify][fit][pairs]") {
  const identify::Rig truth = resonant_rig("contact_compliance");
  const auto [from, to] = GENERATE(table<double, double>({{4e-3, 16e-3}, {2e-3, 8e-3}}));
  const bool with_phases = GENERATE(true, false);
  const identify::Experiments experiments = states_of(truth, from, to, with_phases, 1);
  const identify::Fit fit = fit_of(truth, experiments);
  REQUIRE(fit.outcome.ok());
  CAPTURE(from, with_phases, test::fitted(fit, "kinetic").value, test::fitted(fit, "contact_stiffness").value);
  CHECK(fit.signals.front().rms < 1.6e-4);
  if (with_phases) CHECK(fit.signals.back().rms < 3.2e-3);
  CHECK(test::fitted(fit, "kinetic").value == Approx(2.0).epsilon(0.05));
  CHECK(test::fitted(fit, "damping").value == Approx(1.2).epsilon(0.01));
}

TEST_CASE("fit: the phase of a mass goes on smoothly where it comes to rest", "[identify][fit][pairs]") {
  const identify::Rig truth = resonant_rig("coulomb");
  const identify::Experiments experiments = states_of(truth, 2e-3, 8e-3, true, 2);
  const auto lag_under = [&](double kinetic) {
    identify::Rig rig = truth;
    rig.laws.front().values.set("kinetic", kinetic);
    Eigen::VectorXd outputs;
    REQUIRE(experiments.front()->predict(*identify::model_of(rig), {}, outputs));
    return outputs[8];
  };
  constexpr double largest_pull = 1568.0 * 2e-3;
  CHECK(lag_under(1.001 * largest_pull) == Approx(lag_under(0.9999 * largest_pull)).margin(0.03));
}

TEST_CASE("fit: a search finds from its last motions the steady states that are found from nothing",
          "[identify][fit][pairs]") {
  // Orbits of smooth laws lead to those of the next point; those of exact laws are found anew.
  for (const std::string law : {"dahl", "coulomb"}) {
    CAPTURE(law);
    identify::Rig rig = resonant_rig("coulomb");
    if (law == "dahl") rig.laws.front() = {friction::find_law("dahl"), {{"kinetic", 2.0}, {"sigma0", 6000.0}}};
    const identify::Experiments experiments = states_of(resonant_rig("coulomb"), 4e-3, 16e-3, true, 1);
    const std::vector<identify::FitParameter> parameters = test::sought_in(rig, {"kinetic", "damping"}, 1.0);
    const identify::FitProblem problem(rig, parameters, experiments, {2.0, 1.2});
    Eigen::VectorXd q = problem.space().point(Eigen::Vector2d(2.0, 1.2));
    identify::LastMotions last;
    Eigen::VectorXd outputs;
    Eigen::MatrixXd slopes;
    REQUIRE(problem.derivatives(q, outputs, slopes, true, &last));
    for (const double step : {0.01, 0.1, 0.5}) {
      CAPTURE(step);
      q += step * Eigen::Vector2d(1.0, -0.5);
      Eigen::VectorXd led, led_outputs, anew;
      Eigen::MatrixXd led_slopes, slopes_anew;
      REQUIRE(problem.outputs(q, led, &last));
      REQUIRE(problem.derivatives(q, led_outputs, led_slopes, true, &last));
      REQUIRE(problem.derivatives(q, anew, slopes_anew, true));
      CHECK((led - anew).norm() < 1e-9 * anew.norm());
      CHECK((led_outputs - anew).norm() < 1e-9 * anew.norm());
      CHECK((led_slopes - slopes_anew).norm() < 1e-5 * slopes_anew.norm());
    }
    Eigen::VectorXd unused;
    const auto near = experiments.front()->neighbours(*identify::model_of(rig), {}, nullptr, unused);
    REQUIRE(near != nullptr);
    CHECK(near->is_worth_using() == (law == "dahl"));
  }
}

namespace {

/// 1 kg and 1000 N/m just below resonance, with a law whose force falls or rises with the speed.
identify::Rig rig_of_speed(const std::string& law, const friction::ParameterValues& values) {
  identify::Rig rig;
  rig.known.oscillator = {.mass = 1.0, .stiffness = 1000.0, .damping = 0.8};
  rig.known.excitation.type = sim::ExcitationType::base_harmonic;
  rig.laws.push_back({friction::find_law(law), values});
  return rig;
}

identify::Experiments amplitudes_of(const identify::Rig& rig) {
  std::vector<std::pair<double, double>> levels;
  for (int i = 0; i < 6; ++i) levels.emplace_back(2e-3 * (1 + i), 30.79);
  identify::Record record = test::steady_states_of(rig, levels, 5e-5, 2e-3, 4);
  for (identify::Pair& pair : record.pairs->pairs) pair.phase = identify::unknown;
  std::string fault;
  return identify::experiments_of(record, {.name = "pairs"}, fault);
}

}  // namespace

TEST_CASE("fit: amplitudes under a force that rises with speed end at the best fit", "[identify][fit][pairs]") {
  // The energy line of these amplitudes has a negative friction. From starts by it, the search had ended at 115
  // times the noise, with a coefficient of zero.
  const identify::Rig truth = rig_of_speed("viscous_power", {{"coefficient", 4.0}, {"exponent", 2.0}});
  const identify::Fit fit = fit_of(truth, amplitudes_of(truth));
  REQUIRE(fit.outcome.ok());
  CHECK(fit.signals.front().rms < 1e-4);
  CHECK(test::fitted(fit, "exponent").value == Approx(2.0).epsilon(0.1));
  CHECK(test::fitted(fit, "coefficient").value == Approx(4.0).epsilon(0.05));
}

TEST_CASE("fit: harmonic balance along measured amplitudes predicts them", "[identify][fit][pairs]") {
  // A sine is the motion but for the third harmonic of the friction, 2.5 % of the spring's force at the lowest
  // level.
  for (const auto& [law, values] : {std::pair<std::string, friction::ParameterValues>{
                                        "viscous_power", {{"coefficient", 4.0}, {"exponent", 2.0}}},
                                    {"coulomb", {{"kinetic", 1.0}}},
                                    {"dahl", {{"kinetic", 1.0}, {"sigma0", 3000.0}}}}) {
    CAPTURE(law);
    const identify::Rig truth = rig_of_speed(law, values);
    const identify::Experiments experiments = amplitudes_of(truth);
    const auto balanced = experiments.front()->balanced();
    REQUIRE(balanced != nullptr);
    Eigen::VectorXd outputs;
    REQUIRE(balanced->predict(*identify::model_of(truth), {}, outputs));
    for (std::size_t i = 0; i < experiments.front()->signals.front().measured.size(); ++i)
      CHECK(outputs[static_cast<Eigen::Index>(i)] ==
            Approx(experiments.front()->signals.front().measured[i]).epsilon(0.03));
  }
}

namespace {

/// A rig of 5 mg at 800 Hz with drag, whose coefficient is the force at 1 m/s: 1600 times the force that the energy
/// line shows.
identify::Rig small_rig() {
  constexpr double omega = 5026.548;
  identify::Rig rig;
  rig.known.oscillator = {.mass = 5e-6, .stiffness = 5e-6 * omega * omega, .damping = 1.508e-3};
  rig.known.excitation.type = sim::ExcitationType::base_harmonic;
  rig.laws.push_back({friction::find_law("viscous_power"), {{"coefficient", 0.06}, {"exponent", 2.0}}});
  return rig;
}

/// Amplitudes and phases at these shares of the natural frequency and these levels [um].
identify::Experiments states_of(const identify::Rig& rig, const std::vector<double>& shares,
                                const std::vector<double>& micrometres) {
  const double omega = sim::natural_frequency(rig.known.oscillator);
  std::vector<std::pair<double, double>> levels;
  for (const double share : shares)
    for (const double level : micrometres) levels.emplace_back(1e-6 * level, share * omega);
  std::string fault;
  return identify::experiments_of(test::steady_states_of(rig, levels, 1.4e-8, 3e-3, 4), {.name = "pairs"}, fault);
}

}  // namespace

TEST_CASE("fit: a force at a speed far from those of amplitudes and phases is found", "[identify][fit][pairs]") {
  // The search had ended at a coefficient of zero, with residuals of 14 % of the readings.
  const identify::Rig truth = small_rig();
  const identify::Fit fit = fit_of(truth, states_of(truth, {0.97, 1.02}, {1.0, 1.7, 3.0}));
  REQUIRE(fit.outcome.ok());
  CHECK(fit.signals.front().rms < 3e-8);
  CHECK(test::fitted(fit, "exponent").value == Approx(2.0).epsilon(0.1));
  CHECK(test::fitted(fit, "coefficient").value == Approx(0.06).epsilon(0.4));
}

TEST_CASE("fit: a wrong law follows the amplitudes where it cannot follow the phases", "[identify][fit][pairs]") {
  identify::Rig truth;
  truth.known.oscillator = {.mass = 1.7, .stiffness = 1500.0, .damping = 2.0};
  truth.known.excitation.type = sim::ExcitationType::base_harmonic;
  truth.laws.push_back(
      {friction::find_law("contact_compliance"), {{"kinetic", 2.2}, {"contact_stiffness", 9000.0}}});
  std::vector<std::pair<double, double>> levels;
  for (const double mm : {1.6, 2.0, 2.2, 2.6, 3.0, 4.0, 5.0, 6.5, 8.0}) levels.emplace_back(1e-3 * mm, 28.9);
  std::string fault;
  const identify::Experiments experiments =
      identify::experiments_of(test::steady_states_of(truth, levels, 1e-5, 4e-3, 7), {.name = "pairs"}, fault);
  REQUIRE(fault.empty());
  identify::Rig rig = truth;
  rig.laws.front() = {friction::find_law("coulomb"), {}};
  const identify::Fit fit = fit_of(rig, experiments);
  REQUIRE(fit.outcome.ok());
  // The search had ended at a compromise: 4 mm of 100 mm, and phases that were hardly better, 0.4 rad.
  CHECK(fit.signals.front().rms < 4e-4);
  CHECK(fit.signals.back().rms > 0.1);
  CHECK(std::ranges::any_of(fit.warnings, [](const std::string& warning) {
    return warning.find("residuals of phase are") != std::string::npos &&
           warning.find("(sigma_phase)") != std::string::npos;
  }));
  // The law of the rig follows both.
  CHECK(fit_of(truth, experiments).warnings.empty());
}

TEST_CASE("fit: residuals that no measurement has are told although few readings pass every test",
          "[identify][fit][pairs]") {
  // Coulomb friction leaves 13 % of the amplitudes under drag, in an order that looks like chance.
  const identify::Experiments experiments = states_of(small_rig(), {0.97, 1.0, 1.03}, {1.0, 1.5, 2.2, 3.0});
  identify::Rig rig = small_rig();
  rig.laws.front() = {friction::find_law("coulomb"), {{"kinetic", 4e-5}}};
  const auto tells = [](const identify::Fit& fit) {
    return std::ranges::any_of(fit.warnings, [](const std::string& warning) {
      return warning.find("of the readings: if the readings are more exact") != std::string::npos;
    });
  };
  const identify::Fit wrong = fit_of(rig, experiments);
  REQUIRE(wrong.outcome.ok());
  CHECK(tells(wrong));
  CHECK(!tells(fit_of(rig, states_of(rig, {0.97, 1.0, 1.03}, {1.0, 1.5, 2.2, 3.0}))));
}

TEST_CASE("fit: a step to motions that take hundreds of times the work finds no motion there",
          "[identify][fit][pairs]") {
  // A bristle of 600 N/m that never yields; then one of 4e7 N/m, whose vibration with the mass swings 250 times in
  // a forcing period and hardly dies out.
  const auto rig_with = [](double sigma0, double sigma1) {
    return rig_of_speed(
        "lugre",
        {{"kinetic", 1e4}, {"static", 1e4}, {"stribeck_velocity", 80.0}, {"sigma0", sigma0}, {"sigma1", sigma1}});
  };
  const identify::Experiments experiments = amplitudes_of(rig_of_speed("coulomb", {{"kinetic", 1.0}}));
  Eigen::VectorXd outputs;
  const auto near =
      experiments.front()->neighbours(*identify::model_of(rig_with(600.0, 2.0)), {}, nullptr, outputs);
  REQUIRE(near != nullptr);
  CHECK(near->predict(*identify::model_of(rig_with(610.0, 2.0)), {}, 0.0, outputs));
  const long before = *experiments.front()->work;
  CHECK_FALSE(near->predict(*identify::model_of(rig_with(4e7, 4.5)), {}, 0.0, outputs));
  CHECK(*experiments.front()->work < 20 * before);
}
