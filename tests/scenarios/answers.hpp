#pragma once
/// Answers of analyses of the system of the paper's numerical example, and parts of answers.

#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "scenarios/output.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::testing {

/// m = 1 kg, k = 100 N/m, c = 4 N.s/m, F_0 = 2 N, base motion of 0.1 m at resonance, the analysis as YAML in one
/// line.
inline scenarios::Scenario scenario_of(const std::string& analysis, const std::string& more = {}) {
  return scenarios::parse_scenario(
      "schema: dualdamp/1\n"
      "system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 N}}\n"
      "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}\n"
      "analysis: " +
          analysis + "\n" + more,
      "test.yaml");
}

/// The document that the program writes.
inline nlohmann::ordered_json document_of(const scenarios::Scenario& scenario, const scenarios::RunResult& result) {
  std::ostringstream text;
  scenarios::json_document(std::make_shared<scenarios::Scenario>(scenario),
                           std::make_shared<scenarios::RunResult>(result))(text);
  return nlohmann::ordered_json::parse(text.str());
}

/// Its `result`.
inline nlohmann::json result_of(const scenarios::RunResult& result) {
  return document_of({.resolved = "null"}, result).at("result");
}

/// The same for an analysis that must succeed.
inline nlohmann::json answer_to(const std::string& analysis, const std::string& more = {}) {
  return result_of(scenarios::run(scenario_of(analysis, more)));
}

/// The numbers of a column of a table; empty if there is none of this name.
inline std::vector<double> column_of(const scenarios::RunResult& result, const std::string& table,
                                     const std::string& name) {
  for (const scenarios::Table& candidate : result.tables)
    if (const scenarios::Column* column = candidate.name == table ? candidate.find(name) : nullptr)
      return column->numbers;
  return {};
}

/// A file beside the test's scenarios, deleted with the object.
class File {
 public:
  File(const std::string& name, const std::string& text) : path_(name) { std::ofstream(path_) << text; }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { std::remove(path_.c_str()); }

 private:
  std::string path_;
};

}  // namespace dualdamp::testing
