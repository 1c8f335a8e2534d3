#pragma once
/// A scenario: the question a file asks, checked and in SI.
///
///     run(load_scenario("decay.yaml"))                                      // the analyses of this library
///     run(load_scenario("rig.yaml", {.analyses = bench::analyses()}))       // those of bench/ too
///
/// `load_scenario` reads a file by the tables of the format. If any part of it cannot be run, the file is refused,
/// with all problems at once. Format: docs/user-guide.md. Errors: `core::InputError`.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostics.hpp"
#include "friction_models/parameters.hpp"
#include "scenarios/analyses.hpp"
#include "scenarios/analysis.hpp"
#include "sim/model.hpp"

namespace dualdamp::scenarios {

/// One expected value of a result.
struct Expectation {
  std::string path;  ///< into the result: points[0].x
  std::variant<double, bool, std::string> equals;
  std::optional<double> within;  ///< largest absolute difference
  std::optional<double> within_relative;
  std::string source;
  core::SourcePlace place;  ///< of the path, for messages
};

struct Scenario {
  std::string file;  ///< as named by the user
  std::string title;
  sim::Model model;  ///< meaningless for a formula
  std::string analysis_name;
  std::shared_ptr<const Question> question;
  std::vector<ResultField> result_fields;  ///< what the result may hold
  std::size_t result_rows = 0;             ///< items of its lists, as far as they are known before the run
  std::vector<Expectation> expect;
  double tolerance = 0.0;
  bool verify = false;                ///< whether the result is computed again in another way
  std::vector<std::string> warnings;  ///< of parameters of laws, and of the drive

  std::map<std::string, std::string> written_units;  ///< of quantities, by path; used for printed results
  std::string resolved;     ///< the scenario as JSON on one line: SI, defaults filled in; itself a valid scenario
  std::string file_sha256;  ///< of the bytes of the file
  std::vector<std::string> data_sha256;  ///< of the bytes of its data files
  std::vector<std::string> overrides;    ///< PATH=VALUE texts
};

/// One `PATH=VALUE`, and the name of its file in messages.
struct Override {
  std::string assignment;
  std::string origin = "set";
};

struct LoadOptions {
  std::vector<Override> set = {};
  /// Data files may be outside the scenario's directory, because their names come from the command line and not
  /// from a file.
  bool data_anywhere = false;
  DataTexts data_texts = {};
  core::SettingWords words = {};                  ///< how messages name what a user may state
  AnalysisList analyses = scenarios::analyses();  ///< what the file may ask for
  /// Runs this analysis on the record of the file's own analysis (`design` on that of `identify`). Keys that only
  /// the other analysis has, and `expect`, are left out with a warning. Empty: the analysis of the file.
  std::string_view instead = {};
};

/// Reads a file. A file that cannot be read is an `InputError` too.
[[nodiscard]] Scenario load_scenario(const std::string& path, const LoadOptions& options = {});

/// Reads a scenario from text; `name` stands for the file in messages, and data files are looked for in `name`'s
/// directory.
[[nodiscard]] Scenario parse_scenario(const std::string& text, const std::string& name,
                                      const LoadOptions& options = {});

/// The parameters of one law, `set` as the user writes them (`kinetic=2 N`), checked as in a file, defaults filled
/// in. `origin`: as of an Override. Errors: `core::InputError`, also when there is no such law.
[[nodiscard]] friction::ParameterValues law_parameters(const std::string& law, const std::vector<std::string>& set,
                                                       const std::string& origin);

}  // namespace dualdamp::scenarios
