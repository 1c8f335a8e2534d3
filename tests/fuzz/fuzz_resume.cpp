/// Files of finished points that a sweep is to go on with: the parts of the input before and after the first zero
/// byte are the points of this process and those of a second one, without their first lines and the checks of
/// lines.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/diagnostics.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/case_file.hpp"
#include "scenarios/results/files.hpp"
#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;
using fuzz::require;

constexpr const char* sweep =
    "schema: dualdamp/1\n"
    "system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}\n"
    "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}\n"
    "analysis: {type: steady_state}\n"
    "sweep: {system.friction.kinetic: [1 N, 1.5 N, 2 N]}\n";

const scenarios::Scenario& scenario() {
  static const scenarios::Scenario read = scenarios::parse_scenario(sweep, "sweep.yaml");
  return read;
}

scenarios::RunResult run(const std::string& folder, scenarios::FoundCases found) {
  return scenarios::run(scenario(), {.directory = folder, .threads = 1, .found = found});
}

/// The first line of every file of points of this sweep.
const std::string& head(const std::string& folder) {
  static const std::string line = [&] {
    (void)run(folder, scenarios::FoundCases::overwrite);
    std::string first;
    std::ifstream file(folder + "/points.jsonl");
    std::getline(file, first);
    return first + "\n";
  }();
  return line;
}

/// With the right check after each line: a wrong one alone would leave the contents unread.
std::string with_checks(std::string_view lines) {
  std::string text;
  while (!lines.empty()) {
    const auto end = lines.find('\n');
    const std::string_view line = lines.substr(0, end);
    text += line.empty() ? std::string() : scenarios::checked_line(line);
    if (end == std::string_view::npos) break;
    text += '\n';
    lines.remove_prefix(end + 1);
  }
  return text;
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  const std::string place = folder().string();
  const auto zero = input.find('\0');
  (void)written("points.jsonl", head(place) + with_checks(input.substr(0, zero)));
  std::filesystem::remove(folder() / "points.1.jsonl");
  if (zero != std::string_view::npos)
    (void)written("points.1.jsonl", head(place) + with_checks(input.substr(zero + 1)));
  try {
    const scenarios::RunResult result = run(place, scenarios::FoundCases::resume);
    require(!result.result.empty() && result.result != "null", "a sweep that is gone on with has a result");
    require(scenarios::Json::accept(result.result), "a result is JSON");
    require(run(place, scenarios::FoundCases::resume).result == result.result,
            "a finished sweep that is gone on with has the same result");
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
  } catch (const scenarios::OutputError& error) {
    require(*error.what() != '\0', "a refusal says why");
  }
}
