#include "scenarios/measurements/drives.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/random.hpp"
#include "scenarios/run.hpp"
#include "scenarios/verification/verification.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/scenarios/answers.hpp"
#include "tests/scenarios/files.hpp"

using namespace dualdamp;
using scenarios::Scenario;

namespace {

namespace fs = std::filesystem;

/// A directory with one data file, deleted with the object.
class Directory {
 public:
  explicit Directory(const std::string& data)
      : path_(fs::temp_directory_path() / ("dualdamp_drives_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
    std::ofstream(path_ / "data.csv") << data;
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  ~Directory() { fs::remove_all(path_); }

  [[nodiscard]] Scenario scenario(const std::string& excitation, const std::string& analysis,
                                  const std::string& system = {}) const {
    return scenarios::parse_scenario(
        "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, "
        "kinetic: 2 N}" +
            system + "}\nexcitation: " + excitation + "\nanalysis: " + analysis + "\n",
        (path_ / "scenario.yaml").string());
  }

  [[nodiscard]] core::Diagnostic problem(const std::string& excitation) const {
    try {
      (void)scenario(excitation, "{type: simulate, duration: 1 s}");
    } catch (const core::InputError& error) {
      return error.diagnostics().front();
    }
    return {};
  }

 private:
  fs::path path_;
};

constexpr const char* second = "{type: simulate, duration: 1 s}";

/// t, y of the standard case's base, x of its motion, every 5 ms.
std::string standard_record(double noise) {
  const auto history = sim::simulate(testing::scenario_of("{type: simulate, duration: 1 s}").model,
                                     {.duration = 4.0, .sample_rate = 200.0});
  std::string text = "t [s],y [mm],x [um]\n";
  const core::RandomStream draws{.seed = 3, .stream = 1};
  for (std::size_t i = 0; i < history.samples.size(); ++i) {
    const sim::Sample& s = history.samples[i];
    std::ostringstream row;
    row.precision(17);
    row << s.t + 7.0 << "," << s.y * 1e3 << "," << (s.x + noise * draws.normal(i)) * 1e6 << "\n";
    text += row.str();
  }
  return text;
}

}  // namespace

TEST_CASE("drives: a measured drive in its unit, from its first sample on", "[scenarios][drives]") {
  const Directory directory("time [ms];lift [um];other\n2000;100;-\n2500;300;-\n3100;-100;-\n");
  const Scenario scenario = directory.scenario("{type: measured_base, file: data.csv, column: lift}", second);
  CHECK(scenario.warnings.empty());
  REQUIRE(scenario.data_sha256.size() == 1);
  REQUIRE(scenario.model.excitation.type == sim::ExcitationType::base_samples);
  const sim::SampledSignal& signal = *scenario.model.excitation.samples;
  REQUIRE(signal.times().size() == 3);
  CHECK(signal.times()[1] == Approx(0.5).epsilon(1e-15));
  CHECK(signal.times()[2] == Approx(1.1).epsilon(1e-15));
  CHECK(signal.values()[2] == Approx(-1e-4).epsilon(1e-15));
  CHECK(signal.interpolation() == sim::Interpolation::linear);
  CHECK_FALSE(signal.repeats());
}

TEST_CASE("drives: unit, scale, columns, trend and offset", "[scenarios][drives]") {
  // 5 + 2 t of volts at 10 N/V, from t = 1 on.
  const Directory directory("clock,sensor\n1,7\n2,9\n4,13\n5,15\n");
  const auto values = [&](const std::string& more) {
    const Scenario scenario = directory.scenario(
        "{type: measured_force, file: data.csv, time_column: clock, column: sensor, " + more + "}", second);
    return scenario.model.excitation.samples->values();
  };
  CHECK(values("unit: kN")[1] == Approx(9000.0));
  CHECK(values("unit: N, detrend: mean")[1] == Approx(-2.0));
  CHECK(values("unit: N, detrend: mean, offset: 3 N")[1] == Approx(1.0));
  for (const double value : values("unit: N, detrend: line")) CHECK(std::abs(value) < 1e-14);
}

TEST_CASE("drives: what is wrong with a file is told where it stands", "[scenarios][drives]") {
  const auto problem = [](const std::string& data, const std::string& more = {}) {
    return Directory(data).problem("{type: measured_base, file: data.csv" + more + "}");
  };
  const auto missing = problem("t,x\n0,1\n1,2\n", ", column: lift");
  CHECK(missing.message.find("there is no column 'lift'") != std::string::npos);
  CHECK(missing.place.file == "data.csv");
  CHECK(missing.place.line == 1);
  CHECK(problem("t,x\n0,1\n1,2\n").message == "there is no column y");
  CHECK(problem("s,y\n0,1\n1,2\n").message == "there is no column t");
  const auto unit = problem("t [s],y [N]\n0,1\n1,2\n");
  CHECK(unit.message.find("the unit of column y") != std::string::npos);
  CHECK(unit.allowed.find("'unit' beside 'column'") != std::string::npos);
  const auto backwards = problem("t [s],y [m]\n0,1\n1,2\n1,3\n0.5,4\n");
  CHECK(backwards.message.find("the time does not increase") != std::string::npos);
  CHECK(backwards.place.line == 4);
  CHECK(problem("t [s],y [m]\n0,1\n").message.find("too few samples") != std::string::npos);
  CHECK(problem("t [s],y [m]\n0,1\n1,nan\n").place.line == 3);
}

TEST_CASE("drives: times without a unit are seconds unless the scenario says otherwise", "[scenarios][drives]") {
  const Directory directory("t,y [mm]\n0,0\n500,2\n1000,-3\n");
  const auto drive = [&](const std::string& more) {
    return directory.scenario("{type: measured_base, file: data.csv" + more + "}",
                              "{type: simulate, duration: 1 s}");
  };
  CHECK(drive(", time_unit: ms").model.excitation.samples->times().back() == Approx(1.0).epsilon(1e-15));
  CHECK(drive(", time_unit: ms").warnings.empty());
  const Scenario plain = drive("");
  CHECK(plain.model.excitation.samples->times().back() == 1000.0);
  REQUIRE(plain.warnings.size() == 1);
  CHECK(plain.warnings.front() == "no unit is stated for t: read t in s; state another one as 'time_unit'");
  CHECK(directory.problem("{type: measured_base, file: data.csv, time_unit: mm}")
            .message.find("not a unit of a time") != std::string::npos);
  const auto comma = Directory("t [s];y [mm]\n0,0;1,5\n1,0;2,5\n").problem("{type: measured_base, file: data.csv}");
  CHECK(comma.allowed.find("for decimal commas decimal: ','") != std::string::npos);
}

TEST_CASE("drives: what a valid drive has to tell", "[scenarios][drives]") {
  const Directory directory("t [s],y [mm]\n0,0\n1,2\n2,-3\n");
  const auto warnings = [&](const std::string& more, const std::string& system = {}) {
    return directory
        .scenario("{type: measured_base, file: data.csv" + more + "}", "{type: simulate, duration: 5 s}", system)
        .warnings;
  };
  REQUIRE(warnings("").size() == 1);
  CHECK(warnings("").front().find("the drive ends at t = 2 s, the motion at 5 s") != std::string::npos);
  REQUIRE(warnings(", repeat: true").size() == 1);
  CHECK(warnings(", repeat: true").front().find("jumps by 0.003 m") != std::string::npos);
}

TEST_CASE("drives: a table, a chirp", "[scenarios][drives]") {
  const Directory directory("");
  const Scenario table = directory.scenario(
      "{type: force_table, times: [0 s, 500 ms, 1 s], values: [0 N, 1 kN, 0 N], interpolation: step, repeat: true}",
      second);
  CHECK(table.model.excitation.samples->values()[1] == 1000.0);
  CHECK(table.model.excitation.samples->times()[1] == 0.5);
  CHECK(table.warnings.empty());
  const Scenario chirp = directory.scenario(
      "{type: base_chirp, amplitude: 2 mm, from: 1 Hz, to: 8 Hz, duration: 3 s, spacing: log}", second);
  const Scenario doubled = directory.scenario(
      "{type: base_table, times: [0 s, 1 s, 1.000001 s, 2 s], values: [0 mm, 1 mm, -1 mm, 0 mm], interpolation: "
      "cubic}",
      second);
  REQUIRE(doubled.warnings.size() == 1);
  CHECK(doubled.warnings.front().find("leaves the range of its samples, -0.001 m to 0.001 m") != std::string::npos);
  CHECK(chirp.model.excitation.chirp.law == sim::ChirpLaw::exponential);
  CHECK(chirp.model.excitation.chirp.to == Approx(16.0 * std::acos(-1.0)).epsilon(1e-15));
  CHECK(chirp.model.excitation.amplitude == 2e-3);
  CHECK_THROWS_AS(
      directory.scenario("{type: base_chirp, amplitude: 2 mm, from: 1 Hz, to: 1 GHz, duration: 3 s}", second),
      core::InputError);
}

TEST_CASE("drives: a measured motion beside the simulated one", "[scenarios][drives][simulate]") {
  constexpr double noise = 2e-4;
  const Directory directory(standard_record(noise));
  const std::string drive = "{type: measured_base, file: data.csv, interpolation: cubic}";
  const auto answer = [&](const std::string& more) {
    const Scenario scenario =
        directory.scenario(drive, "{type: simulate, duration: 4 s, measured: {file: data.csv" + more + "}}");
    CHECK(scenario.data_sha256.size() == 1);
    const auto result = scenarios::run(scenario);
    REQUIRE(result.tables.size() == 2);
    CHECK(result.tables.back().columns.back().name == "residual");
    CHECK(result.tables.back().size() == 801);
    return testing::result_of(result).at("residual");
  };
  // The model is correct, so the residual is noise, known to 1/sqrt(2 801) = 2.5 % and estimated to some 5 %. 126
  // samples a period, 5 (w h)^4/384 of the base motion: 8e-9 m.
  const auto estimated = answer("");
  CHECK(estimated.at("samples") == 801);
  CHECK(estimated.at("rms").get<double>() == Approx(noise).epsilon(0.08));
  CHECK(estimated.at("noise").get<double>() == Approx(noise).epsilon(0.15));
  CHECK(estimated.at("noise_units").get<double>() == Approx(1.0).epsilon(0.2));
  CHECK(answer(", noise: 0.1 mm").at("noise_units").get<double>() == Approx(2.0).epsilon(0.08));
}

TEST_CASE("drives: the other engine confirms a motion under measured base motion", "[scenarios][drives]") {
  const Directory directory(standard_record(0.0));
  for (const char* interpolation : {"linear", "cubic"}) {
    const Scenario scenario = directory.scenario(
        std::string("{type: measured_base, file: data.csv, interpolation: ") + interpolation + "}",
        "{type: simulate, duration: 4 s, sample_rate: 50 Hz}\nnumerics: {verify: true}");
    const auto result = scenarios::run(scenario);
    REQUIRE(result.verification);
    CHECK(result.verification->agrees);
  }
}

TEST_CASE("drives: a synthetic history under a measured force is identified", "[scenarios][drives]") {
  std::string text = "t [s],force [N]\n";
  const core::RandomStream draws{.seed = 8, .stream = 1};
  for (std::size_t i = 0; i <= 400; ++i)
    text += std::to_string(0.05 * static_cast<double>(i)) + "," + std::to_string(8.0 * draws.normal(i)) + "\n";
  const Directory directory(text);
  const Scenario scenario = directory.scenario(
      "{type: measured_force, file: data.csv, interpolation: cubic}",
      "{type: identify, measurement: {type: simulate, duration: 20 s}, sensors: {sample_rate: 500 Hz, x: {noise: 5 "
      "um}}, methods: [output_error]}");
  const auto answer = testing::result_of(scenarios::run(scenario));
  const auto& estimate = answer.at("estimates").at(0);
  CHECK(estimate.at("c").get<double>() == Approx(4.0).epsilon(0.01));
  CHECK(estimate.at("F0").get<double>() == Approx(2.0).epsilon(0.01));
}
