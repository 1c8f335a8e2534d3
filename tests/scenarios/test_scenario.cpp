#include "scenarios/scenario.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "files.hpp"
#include "scenarios/analyses/frequency_response.hpp"
#include "scenarios/analyses/identify.hpp"
#include "scenarios/analyses/simulate.hpp"
#include "scenarios/analyses/xy_curve.hpp"
#include "tests/support/problems.hpp"

using namespace dualdamp;
using scenarios::Scenario;

namespace {

const std::string base =
    "schema: dualdamp/1\n"
    "system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}\n"
    "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}\n"
    "analysis: {type: steady_state}\n";

Scenario with(std::vector<std::string> assignments) {
  scenarios::LoadOptions options;
  for (std::string& assignment : assignments) options.set.push_back({std::move(assignment)});
  return scenarios::parse_scenario(base, "base.yaml", options);
}

std::vector<core::Diagnostic> problems_with(std::vector<std::string> assignments) {
  return test::problems_of([&] { return with(std::move(assignments)); });
}

}  // namespace

TEST_CASE("scenario: SI numbers arrive in the model", "[scenarios]") {
  const Scenario scenario = with({"initial={position: 3 mm, velocity: -2 mm/s}", "excitation.phase=90 deg",
                                  "excitation.harmonics=[{order: 3, amplitude: 1 cm, phase: 180 deg}]"});
  CHECK(scenario.model.oscillator.mass == 1.0);
  CHECK(scenario.model.oscillator.damping == 4.0);
  CHECK(scenario.model.oscillator.damper_to == sim::DamperTo::ground);
  CHECK(scenario.model.friction.size() == 1);
  CHECK(scenario.model.initial.position == 0.003);
  CHECK(scenario.model.initial.velocity == -0.002);
  CHECK(scenario.model.excitation.phase == std::numbers::pi / 2);
  REQUIRE(scenario.model.excitation.harmonics.size() == 1);
  CHECK(scenario.model.excitation.harmonics[0].order == 3);
  CHECK(scenario.model.excitation.harmonics[0].amplitude == 0.01);
}

TEST_CASE("scenario: words become numbers", "[scenarios]") {
  CHECK(with({"excitation.frequency=natural", "system.mass=4 kg"}).model.excitation.frequency == 5.0);
  const Scenario damped = with({"excitation.frequency=damped"});
  CHECK(damped.model.excitation.frequency == Approx(10.0 * std::sqrt(1.0 - 0.04)).epsilon(1e-15));
  const std::string ratio =
      "schema: dualdamp/1\nsystem: {mass: 4 kg, stiffness: 100 N/m, damping_ratio: 0.2}\n"
      "analysis: {type: simulate, duration: 1 s}\n";
  CHECK(scenarios::parse_scenario(ratio, "r.yaml").model.oscillator.damping == 8.0);
}

TEST_CASE("scenario: a range of amplitudes meets its ends and passes plain decimals", "[scenarios]") {
  const Scenario linear = with({"analysis={type: xy_curve, amplitudes: {from: 0, to: 0.6 m, count: 7}}"});
  const auto& amplitudes = testing::question_of<scenarios::XyCurveQuestion>(linear).amplitudes();
  CHECK(amplitudes == std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6});
  const Scenario log =
      with({"analysis={type: frequency_response, frequencies: {from: 1 Hz, to: 4 Hz, count: 3, spacing: log}}"});
  const auto& frequencies = testing::question_of<scenarios::FrequencyResponseQuestion>(log).frequencies();
  REQUIRE(frequencies.size() == 3);
  CHECK(frequencies[1] == Approx(4.0 * std::numbers::pi).epsilon(1e-15));
  CHECK(frequencies[2] == 8.0 * std::numbers::pi);
}

TEST_CASE("scenario: a range of frequencies has the values of the list in the same unit", "[scenarios]") {
  const auto frequencies = [](const std::string& stated) {
    const Scenario scenario = with({"analysis={type: frequency_response, frequencies: " + stated + "}"});
    return testing::question_of<scenarios::FrequencyResponseQuestion>(scenario).frequencies();
  };
  CHECK(frequencies("{from: 450 rpm, to: 750 rpm, count: 3}") == frequencies("[450 rpm, 600 rpm, 750 rpm]"));
  CHECK(frequencies("{from: 1 Hz, to: 1.6 Hz, count: 7}") ==
        frequencies("[1 Hz, 1.1 Hz, 1.2 Hz, 1.3 Hz, 1.4 Hz, 1.5 Hz, 1.6 Hz]"));
  // In two units there is no such list: nothing is rounded.
  const std::vector<double> mixed = frequencies("{from: 450 rpm, to: 12.5 Hz, count: 3}");
  CHECK(mixed[1] == Approx(20.0 * std::numbers::pi).epsilon(2e-16));
  CHECK(mixed[2] == frequencies("[12.5 Hz]")[0]);
}

TEST_CASE("scenario: `cycles` are forcing periods", "[scenarios]") {
  const Scenario scenario = with({"analysis={type: simulate, cycles: 2.5}"});
  CHECK(testing::question_of<scenarios::SimulateQuestion>(scenario).duration() ==
        Approx(0.5 * std::numbers::pi).epsilon(1e-15));
}

TEST_CASE("scenario: --set replaces, adds and reaches into lists", "[scenarios]") {
  CHECK(with({"system.mass=2 kg"}).model.oscillator.mass == 2.0);
  CHECK(with({"numerics.tolerance=1e-10"}).tolerance == 1e-10);
  CHECK(with({"system.friction=[{law: coulomb, kinetic: 1 N}, {law: coulomb, kinetic: 2 N}]",
              "system.friction[1].static=3 N"})
            .model.friction.size() == 2);
}

TEST_CASE("scenario: what one --set states no other one replaces", "[scenarios]") {
  CHECK_THROWS_WITH(with({"system.mass=2 kg", "system.mass=3 kg"}),
                    Catch::Contains("'system.mass' is stated twice") && Catch::Contains("set: system.mass=2 kg"));
  CHECK_THROWS_WITH(with({"system.friction=[{law: coulomb, kinetic: 1 N}]", "system.friction[0].kinetic=3 N"}),
                    Catch::Contains("'system.friction[0].kinetic' is stated twice"));
}

TEST_CASE("scenario: what is wrong with --set is said there", "[scenarios]") {
  const auto only = [](std::vector<std::string> assignments) {
    const auto problems = problems_with(std::move(assignments));
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].place.file == "set");
    CHECK(problems[0].place.line == 1);
    return problems[0];
  };
  CHECK(only({"system.mass=-1 kg"}).place.column == 13);
  CHECK(only({"system.mass=-1 kg"}).place.text == "system.mass=-1 kg");
  CHECK(only({"system.mas=1 kg"}).suggestion == "mass");
  CHECK(only({"system.friction[0].kinetic=1 N"}).message == "there is no such list item");
  CHECK(only({"system.mass.value=1 N"}).message.find("has no keys") != std::string::npos);
  CHECK(only({"initial=3"}).allowed == "a map of position, velocity, travel");
  CHECK(only({"system.mass"}).message == "this does not name a value");
  CHECK(only({"=1"}).message == "this does not name a value");
  CHECK(only({"a..b=1"}).message == "this does not name a value");
  CHECK(only({"system.mass="}).message == "a value is missing after '='");
  CHECK(only({"system.mass=&a 1"}).message.find("anchors") != std::string::npos);
  CHECK(only({"system.mass=\"1 kg"}).message.find("not closed") != std::string::npos);
}

TEST_CASE("scenario: the resolved scenario is a scenario with the same meaning", "[scenarios]") {
  std::vector<std::filesystem::path> files;
  for (const std::string folder : {"scenarios/paper", "scenarios/examples", "tests/valid"})
    for (const auto& path : testing::yaml_files(folder)) files.push_back(path);
  for (const auto& path : files) {
    CAPTURE(path.string());
    const Scenario first = testing::load(path);
    const Scenario second =
        scenarios::parse_scenario(first.resolved, path.string(), {.analyses = bench::analyses()});
    CHECK(second.resolved == first.resolved);
  }
}

TEST_CASE("scenario: measured data are read and checked with the file", "[scenarios]") {
  const Scenario scenario = scenarios::load_scenario((testing::root / "tests/valid/data.yaml").string());
  const auto& question = testing::question_of<scenarios::IdentifyQuestion>(scenario);
  REQUIRE(question.measured() != nullptr);
  REQUIRE(question.measured()->pairs);
  CHECK(question.measured()->pairs->pairs.size() == 4);
  CHECK(question.methods().constants.frequency == 10.0);
  REQUIRE(scenario.data_sha256.size() == 1);
  CHECK(scenario.data_sha256.front().size() == 64);
  for (const identify::MethodEntry* method : question.methods().list)
    CHECK(method->lacks(*question.measured()).empty());
}

TEST_CASE("scenario: data cannot be reached through a link out of the directory", "[scenarios]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() /
                          ("dualdamp-link-" + std::to_string(std::hash<std::string>()(testing::root.string())));
  fs::remove_all(folder);
  fs::create_directories(folder / "inside");
  fs::create_symlink(testing::root / "tests/valid/pairs.csv", folder / "inside/pairs.csv");
  fs::create_symlink(testing::root / "tests/valid", folder / "inside/away");
  std::ofstream(folder / "good.csv") << "Y [m],x [m]\n0.1,0.2\n0.2,0.5\n";
  fs::create_symlink(folder / "good.csv", folder / "link.csv");
  const auto read = [&](const std::string& name) {
    return scenarios::parse_scenario(
        "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 100}\n"
        "excitation: {type: base_harmonic, frequency: natural}\n"
        "analysis: {type: identify, data: " +
            name + "}\n",
        (folder / "s.yaml").string());
  };
  CHECK_NOTHROW(read("good.csv"));
  CHECK_NOTHROW(read("link.csv"));
  CHECK_THROWS_AS(read("inside/pairs.csv"), core::InputError);
  CHECK_THROWS_AS(read("inside/away/pairs.csv"), core::InputError);
  CHECK_THROWS_AS(read("inside"), core::InputError);
  fs::remove_all(folder);
}

TEST_CASE("scenario: line ends and byte order marks of other systems", "[scenarios]") {
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : base) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(scenarios::parse_scenario(windows, "w.yaml").resolved == with({}).resolved);
}

TEST_CASE("scenario: structural damping belongs to steady vibrations of one frequency", "[scenarios]") {
  const std::vector<std::string> eta = {"system.loss_factor=0.1", "system.damper_to=base"};
  const auto also = [&](std::vector<std::string> assignments) {
    assignments.insert(assignments.begin(), eta.begin(), eta.end());
    return assignments;
  };
  const Scenario scenario = with(eta);
  CHECK(scenario.model.oscillator.loss_factor == 0.1);
  // Warnings: it is not causal, and friction makes further harmonics.
  REQUIRE(scenario.warnings.size() == 2);
  CHECK_THAT(scenario.warnings[0], Catch::Contains("not causal"));
  const auto refused = [&](std::vector<std::string> assignments, const std::string& because) {
    const auto problems = problems_with(std::move(assignments));
    REQUIRE(problems.size() == 1);
    CHECK_THAT(problems[0].message, Catch::Contains("system.loss_factor") && Catch::Contains(because));
  };
  refused(also({"analysis={type: simulate, duration: 1 s}"}), "not causal");
  refused(also({"excitation={type: none}", "analysis={type: free_decay, peaks: 3}", "initial={position: 1 m}"}),
          "not causal");
  refused(also({"excitation.harmonics=[{order: 3, amplitude: 1 cm}]"}), "several harmonics");
  refused({"system.loss_factor=0.1"}, "one damper");
  CHECK(problems_with({"system.loss_factor=0.1", "system.damping=0"}).empty());
}

TEST_CASE("scenario: a load that follows the drive needs a harmonic one", "[scenarios]") {
  const std::string law =
      "system.friction={law: coulomb, kinetic: 2, load_modulation: {ratio: 0.5, phase: 90 deg}}";
  CHECK(problems_with({law}).empty());
  const auto problems = problems_with({law, "excitation={type: none}", "analysis={type: simulate, duration: 1 s}"});
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, Catch::Contains("load_modulation"));
}
