#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/random.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using scenarios::parse_scenario;
using testing::column_of;
using testing::File;

namespace {

constexpr double rate = 250.0;
constexpr double noise = 1e-5;
const std::string head = "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m";
const std::string truth = head + ", damping: 1 N.s/m, friction: {law: coulomb, kinetic: 1 N}}\n";

double chirp(double t) { return 5e-3 * std::cos(2.0 * std::numbers::pi * (3.0 * t + t * t)); }
double sines(double t) {
  return 2e-3 * std::sin(14.5 * t) + 2e-3 * std::sin(25.8 * t + 1.0) + 1.5e-3 * std::sin(42.1 * t + 2.0);
}

/// How a record is made: its drive, which column holds it, the time of its first sample.
struct Plan {
  double (*drive)(double) = nullptr;
  bool by_force = false;
  double start = 0.0;
  std::uint64_t seed = 1;
};

/// 2 s of the motion of the rig, from rest, or from 30 mm without a drive: the rows of a data file.
std::vector<std::string> rows_of(const Plan& plan) {
  const auto count = static_cast<std::size_t>(2.0 * rate) + 1;
  std::ostringstream scenario;
  scenario << truth;
  const double size = plan.by_force ? 1000.0 : 1.0;
  std::ostringstream values;
  std::ostringstream times;
  for (std::size_t i = 0; i < count && plan.drive != nullptr; ++i) {
    const double t = static_cast<double>(i) / rate;
    times << (i > 0 ? ", " : "") << core::format_number(t);
    values << (i > 0 ? ", " : "") << core::format_number(size * plan.drive(t));
  }
  if (plan.drive != nullptr)
    scenario << "excitation: {type: " << (plan.by_force ? "force" : "base")
             << "_table, interpolation: cubic, times: [" << times.str() << "], values: [" << values.str() << "]}\n";
  else
    scenario << "initial: {position: 30 mm}\n";
  scenario << "analysis: {type: simulate, duration: 2 s, sample_rate: " << rate << " 1/s}\n";
  const std::vector<double> x =
      column_of(scenarios::run(parse_scenario(scenario.str(), "motion.yaml")), "history", "x");
  REQUIRE(x.size() == count);
  const core::RandomStream draws{plan.seed, 951};
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / rate;
    rows.push_back(core::format_number(plan.start + t) + "," + core::format_number(x[i] + noise * draws.normal(i)) +
                   (plan.drive == nullptr ? "" : "," + core::format_number(size * plan.drive(t))));
  }
  return rows;
}

std::string text_of(const std::vector<std::string>& rows, const std::string& drive) {
  std::string text = "t [s],x [m]" + drive + "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}
constexpr const char* base = ",y [m]";

std::string fit_of(const std::string& analysis, const std::string& more = {}) {
  return head + ", friction: {law: coulomb}}\n" + more + "analysis: {type: fit, profile: false, " + analysis +
         "}\n";
}

scenarios::RunResult run(const std::string& text) {
  scenarios::RunResult result = scenarios::run(parse_scenario(text, "test.yaml"));
  INFO(result.failure);
  REQUIRE(result.failure.empty());
  return result;
}

std::string fault_of(const std::string& text) {
  try {
    static_cast<void>(scenarios::run(parse_scenario(text, "test.yaml")));
  } catch (const core::InputError& error) {
    std::string all;
    for (const core::Diagnostic& problem : error.diagnostics()) all += core::format(problem) + "\n";
    return all;
  }
  return "no fault";
}

const nlohmann::json& parameter(const nlohmann::json& result, const std::string& name) {
  for (const nlohmann::json& each : result.at("parameters"))
    if (each.at("name") == name) return each;
  throw std::out_of_range(name);
}

/// Damping and friction force are 1 within their errors: three of them, since of many intervals of 95 % some miss.
void check_truths(const nlohmann::json& result) {
  constexpr double errors = 3.0;
  for (const char* name : {"damping", "kinetic"}) {
    CAPTURE(name);
    const nlohmann::json& found = parameter(result, name);
    CHECK(found.at("value").get<double>() == Approx(1.0).margin(errors * found.at("std").get<double>()));
    CHECK(found.at("std").get<double>() < 0.01);
  }
}

/// Each scenario of the result runs and gives the fitted curve of its record.
void check_scenarios(const scenarios::RunResult& fit, std::size_t count) {
  const nlohmann::json result = testing::result_of(fit);
  REQUIRE(result.at("scenarios").size() == count);
  for (std::size_t e = 0; e < count; ++e) {
    CAPTURE(e);
    const std::vector<double> x = column_of(run(result.at("scenarios").at(e).get<std::string>()), "history", "x");
    const std::vector<double> fitted = column_of(fit, "fit_" + std::to_string(e) + "_x", "fitted");
    REQUIRE(x.size() == fitted.size());
    for (std::size_t i = 0; i < x.size(); ++i) REQUIRE(x[i] == Approx(fitted[i]).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("fit: histories with drives of their own are fitted together, better than each alone",
          "[scenarios][fit]") {
  const File first("own_chirp.csv", text_of(rows_of({.drive = chirp}), base));
  const File second("own_sines.csv", text_of(rows_of({.drive = sines, .start = -0.5, .seed = 2}), base));
  const scenarios::RunResult both = run(fit_of("data: [own_chirp.csv, own_sines.csv]"));
  const nlohmann::json joint = testing::result_of(both);
  check_truths(joint);
  for (const char* name : {"damping", "kinetic"}) {
    const nlohmann::json& interval = parameter(joint, name).at("interval95");
    CHECK(interval.at(0).get<double>() < 1.0);
    CHECK(interval.at(1).get<double>() > 1.0);
  }
  CHECK(joint.at("residual").at("noise_units").get<double>() == Approx(1.0).margin(0.1));
  check_scenarios(both, 2);
  for (const char* alone : {"own_chirp.csv", "own_sines.csv"}) {
    CAPTURE(alone);
    const nlohmann::json single = testing::result_of(run(fit_of(std::string("data: ") + alone)));
    for (const char* name : {"damping", "kinetic"})
      CHECK(parameter(joint, name).at("std").get<double>() < 0.9 * parameter(single, name).at("std").get<double>());
  }
}

TEST_CASE("fit: a decay, pairs and a history with its own drive are fitted together", "[scenarios][fit]") {
  const File driven("own_driven.csv", text_of(rows_of({.drive = chirp}), base));
  const File decay("own_decay.csv", text_of(rows_of({.seed = 3}), ""));
  const scenarios::RunResult two = run(fit_of("data: [own_driven.csv, own_decay.csv]"));
  check_truths(testing::result_of(two));
  check_scenarios(two, 2);
  const auto warns = [](const scenarios::RunResult& result) {
    return std::ranges::any_of(result.warnings, [](const std::string& warning) {
      return warning.starts_with("own_decay.csv: the file holds no drive and is fitted as a free vibration");
    });
  };
  CHECK(warns(two));
  std::string pairs = "Y [m],x [m]\n";
  for (const double Y : {3e-3, 5e-3, 8e-3}) {
    const nlohmann::json state = testing::result_of(
        run(truth + "excitation: {type: base_harmonic, frequency: 4 Hz, amplitude: " + core::format_number(Y) +
            "}\nanalysis: {type: steady_state}\n"));
    pairs += core::format_number(Y) + "," + state.at("amplitude").dump() + "\n";
  }
  const File levels("own_pairs.csv", pairs);
  const std::string frequency = "excitation: {type: base_harmonic, frequency: 4 Hz}\n";
  const scenarios::RunResult three =
      run(fit_of("data: [own_pairs.csv, own_driven.csv, {file: own_decay.csv, drive: none}]", frequency));
  check_truths(testing::result_of(three));
  CHECK_FALSE(warns(three));
  CHECK_THAT(fault_of(fit_of("data: [own_pairs.csv, own_driven.csv, own_decay.csv]", frequency)),
             Catch::Contains("'drive: none' beside 'file'"));
}

TEST_CASE("fit: measured forces, parts of a torn file and tests of one file are drives of their own",
          "[scenarios][fit]") {
  const std::vector<std::string> rows = rows_of({.drive = chirp});
  const File whole("own_whole.csv", text_of(rows, base));
  const File forced("own_forced.csv",
                    text_of(rows_of({.drive = sines, .by_force = true, .seed = 4}), ",force [N]"));
  const scenarios::RunResult mixed = run(fit_of("data: [own_whole.csv, {file: own_forced.csv, drive: force}]"));
  check_truths(testing::result_of(mixed));
  check_scenarios(mixed, 2);
  // A measured force gives the scale that a motion alone lacks.
  const nlohmann::json scaled = testing::result_of(
      run("schema: dualdamp/1\nsystem: {friction: {law: coulomb}}\nanalysis: {type: fit, profile: false, data: "
          "[own_whole.csv, {file: own_forced.csv, drive: force}]}\n"));
  check_truths(scaled);
  CHECK(parameter(scaled, "mass").at("value").get<double>() == Approx(1.0).epsilon(1e-3));

  std::vector<std::string> torn = rows;
  torn.erase(torn.begin() + 60, torn.begin() + 80);
  const File gap("own_torn.csv", text_of(torn, base));
  for (const char* data : {"own_torn.csv", "[own_torn.csv, {file: own_forced.csv, drive: force}]"}) {
    CAPTURE(data);
    const scenarios::RunResult part = run(fit_of(std::string("data: ") + data));
    check_truths(testing::result_of(part));
    check_scenarios(part, data[0] == '[' ? 2 : 1);
  }
  std::string tests = "t [s],x [m],y [m],sweep\n";
  for (const std::string& row : rows) tests += row + ",a\n";
  for (const std::string& row : rows_of({.drive = sines, .seed = 5})) tests += row + ",b\n";
  const File labelled("own_tests.csv", tests);
  const scenarios::RunResult of_tests = run(fit_of("data: own_tests.csv"));
  check_truths(testing::result_of(of_tests));
  check_scenarios(of_tests, 2);
}

TEST_CASE("fit: records with drives of their own are predicted under these", "[scenarios][fit]") {
  const File first("own_a.csv", text_of(rows_of({.drive = chirp}), base));
  const File second("own_b.csv", text_of(rows_of({.drive = sines, .seed = 2}), base));
  const File third("own_c.csv",
                   text_of(rows_of({.drive = [](double t) { return 1.5 * sines(0.9 * t); }, .seed = 6}), base));
  for (const char* data : {"own_a.csv", "[own_a.csv, own_b.csv]"}) {
    CAPTURE(data);
    const nlohmann::json result =
        testing::result_of(run(fit_of(std::string("data: ") + data + ", validate: own_c.csv")));
    CHECK(result.at("validation").at("wrong") == false);
    CHECK(result.at("validation").at("error").get<double>() <
          1.1 * result.at("validation").at("attainable").get<double>());
  }
  const nlohmann::json both =
      testing::result_of(run(truth + "analysis: {type: predict, data: [own_b.csv, own_c.csv]}\n"));
  CHECK(both.at("validation").at("noise_units").get<double>() == Approx(1.0).margin(0.1));
}

TEST_CASE("fit: what a file is said to be driven by must be there", "[scenarios][fit]") {
  const File driven("own_y.csv", text_of(rows_of({.drive = chirp}), base));
  const File decay("own_free.csv", text_of(rows_of({.seed = 3}), ""));
  using Catch::Contains;
  CHECK_THAT(fault_of(fit_of("data: [own_y.csv, {file: own_free.csv, drive: force}]")),
             Contains("own_free.csv: 'drive: force', and no history of the file has a column force that changes"));
  CHECK_THAT(fault_of(fit_of("data: {file: own_y.csv, loop: true, drive: y}")), Contains("one of drive and loop"));
  CHECK_THAT(fault_of(fit_of("data: own_y.csv", "excitation: {type: none}\n")),
             Contains("'drive: y' beside 'file'; 'drive: none' if y is to be ignored"));
  // A drive or a frequency that no record needs would be ignored.
  CHECK_THAT(fault_of(fit_of("data: {file: own_y.csv, drive: y}",
                             "excitation: {type: base_harmonic, frequency: 4 Hz, amplitude: 5 mm}\n")),
             Contains("'excitation.amplitude' is the drive of histories: every history has its own drive"));
  CHECK_THAT(fault_of(fit_of("data: own_y.csv", "excitation: {type: base_harmonic, frequency: 4 Hz}\n")),
             Contains("every history has its own drive, and no x-Y pairs"));
  CHECK_THAT(fault_of(fit_of("data: [own_y.csv, own_free.csv]",
                             "excitation: {type: base_harmonic, frequency: 4 Hz, amplitude: 5 mm}\n")),
             Contains("if it drove the mass, 'drive: y' beside 'file'"));
}
