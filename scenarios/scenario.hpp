#pragma once
/// A scenario: the question a file asks, checked and in SI.
///
/// `load_scenario` reads a file by the tables of the format and refuses it, with every problem at once, unless the
/// whole of it can be run. Format: docs/user-guide.md. Errors: `core::InputError`.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnostics.hpp"
#include "friction_models/parameters.hpp"
#include "identify/methods.hpp"
#include "scenarios/measure.hpp"
#include "scenarios/mechanism_study.hpp"
#include "scenarios/stress_test.hpp"
#include "sim/model.hpp"
#include "sim/orbits/continuation.hpp"

namespace dualdamp::scenarios {

struct Simulate {
  double duration = 0.0;     ///< s
  double sample_rate = 0.0;  ///< 1/s; 0: no history
};

struct SteadyStateQuestion {};

struct XyCurve {
  std::vector<double> amplitudes;  ///< m or N
};

struct FrequencyResponse {
  std::vector<double> frequencies;  ///< rad/s
};

struct RegimeMap {
  std::vector<double> frequencies;  ///< rad/s
  std::vector<double> amplitudes;   ///< m or N
  bool sticking_boundary = false;   ///< find it too
};

/// A branch of steady states; amplitudes in m or N, frequencies in rad/s.
struct BranchQuestion {
  sim::BranchParameter parameter = sim::BranchParameter::amplitude;
  double from = 0.0;
  double to = 0.0;
};

struct FreeDecayQuestion {
  int peaks = 0;
};

struct Identify {
  /// Measured data, or how to measure this scenario's system.
  std::variant<identify::Record, Measurement> source;
  identify::Sensors sensors;  ///< of a synthetic measurement
  std::uint64_t sensor_seed = 0;
  std::string data_file;  ///< as named in the scenario; empty for a synthetic measurement
  std::string data_sha256;
  std::vector<std::string> data_warnings;
  std::vector<const identify::MethodEntry*> methods;
  identify::KnownConstants constants;
  identify::MethodOptions options;
};

struct Formula {
  std::string name;
  std::string arguments;  ///< JSON, SI
};

using Analysis = std::variant<Simulate, SteadyStateQuestion, XyCurve, FrequencyResponse, RegimeMap, BranchQuestion,
                              FreeDecayQuestion, Identify, StressTest, MechanismStudy, Formula>;

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
  Analysis analysis;
  std::vector<Expectation> expect;
  double tolerance = 0.0;
  std::vector<std::string> warnings;  ///< of the laws, about their parameters

  std::string resolved;     ///< the scenario as JSON on one line: SI, defaults filled in; itself a valid scenario
  std::string file_sha256;  ///< of the bytes of the file
  std::vector<std::string> overrides;  ///< `--set` texts
};

/// One `PATH=VALUE`, and what stands for its file in messages.
struct Override {
  std::string assignment;
  std::string origin = "--set";
};

struct LoadOptions {
  std::vector<Override> set;
  /// Data files may lie outside the scenario's directory: their names come from the command line, not from a file.
  bool data_anywhere = false;
};

/// Reads a file. A file that cannot be read is an `InputError` too.
[[nodiscard]] Scenario load_scenario(const std::string& path, const LoadOptions& options = {});

/// The same from text; `name` stands for the file in messages, and data files are looked for in `name`'s directory.
[[nodiscard]] Scenario parse_scenario(const std::string& text, const std::string& name,
                                      const LoadOptions& options = {});

/// The parameters of one law, `set` as the user writes them (`kinetic=2 N`), checked as in a file, defaults filled
/// in. Errors: `core::InputError`, also when there is no such law.
[[nodiscard]] friction::ParameterValues law_parameters(const std::string& law, const std::vector<std::string>& set);

}  // namespace dualdamp::scenarios
