#include "cli/command_line/arguments.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "cli/command_line/shared_options.hpp"
#include "cli/command_line/usage_error.hpp"
#include "core/build_info.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::cli {

namespace {

/// Largest number of results of a comparison: curves that a chart and its legend can show.
constexpr int most_compared = 50;

constexpr auto usage = static_cast<int>(core::ExitStatus::usage);

std::string version_text() {
  const core::BuildInfo build = core::build_info();
  return fmt::format("dualdamp {} ({}, {}, {})", build.version, build.commit, build.compiler, build.build_type);
}

/// The libraries in DUALDAMP_PLUGINS.
std::vector<std::string> plugins_of_environment() {
  const char* text = std::getenv("DUALDAMP_PLUGINS");
  std::istringstream list(text == nullptr ? "" : text);
  std::vector<std::string> files;
  for (std::string file; std::getline(list, file, ':');)
    if (!file.empty()) files.push_back(file);
  return files;
}

constexpr int max_jobs = 1024;

class Parser {
 public:
  Parser() {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", version_text());
    add_plugins(app_);
    app_.footer(
        "Exit status: 0 done, 1 a requested check failed, 2 wrong command line, 3 invalid scenario or data,\n"
        "4 numerical failure, 5 some cases of a stress test or points of a sweep failed, 70 a bug of this program, "
        "130 interrupted.");
    add_run();
    add_stress();
    add_check();
    add_identify();
    add_next();
    add_fit();
    add_predict();
    add_report();
    add_new();
    add_compare();
    add_lists();
    add_shell();
    refuse_empty_texts(app_);
  }

  [[nodiscard]] CommandTable table() const { return command_table(app_); }

  Call parse(int argc, const char* const* argv) {
    const bool json = std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      std::ostringstream out;
      std::ostringstream errors;
      const int status = app_.exit(error, out, errors);
      if (status == 0) return {Leave{out.str(), 0, false, {}}};
      return {Leave{usage_error(app_, error), usage, json, help_of(app_)}};
    }
    return {chosen_, plugins_, isolation_.empty() ? 0.0 : std::stod(isolation_), json};
  }

 private:
  static void add_quantity(CLI::App& command, const char* name, std::string& value, const char* text) {
    command.add_option(name, value, text)->type_name("QUANTITY");
  }

  /// What is known of the errors of amplitudes. `sigma_x_text`: explains `--sigma-x`.
  static void add_errors(CLI::App& command, MeasuredOptions& options, const char* sigma_x_text) {
    add_quantity(command, "--sigma-x", options.sigma_x, sigma_x_text);
    add_quantity(command, "--sigma-Y", options.sigma_Y, "Known standard deviation of a measured input amplitude");
    add_gains(command, options.gain_uncertainties);
  }

  static void add_input_and_output(CLI::App& command, MeasuredOptions& options) {
    add_file_options(command, options);
    add_shown_units(command, options);
    add_output_options(command, options);
  }

  void add_plugins(CLI::App& command) {
    const auto append = [this](const std::vector<std::string>& files) {
      plugins_.insert(plugins_.end(), files.begin(), files.end());
    };
    command.add_option_function<std::vector<std::string>>("--plugin", append, "Shared library with a friction law")
        ->allow_extra_args(false)
        ->type_name("LIB");
    command
        .add_flag(
            "--isolate-plugins{600}", isolation_,
            "Execute the command in a child process with a time limit; --isolate-plugins=60: seconds (default: "
            "600)")
        ->option_text("[=SECONDS]")
        ->check(CLI::Range(0.1, 1e6))
        ->check([](const std::string& text) {  // CLI::Range accepts "nan"
          return core::parse_number(text).value ? std::string() : "'" + text + "' is no number of seconds";
        });
  }

  /// A command of the line; when it is read, `options` have what it states.
  template <typename Options>
  CLI::App& add_command(CLI::App& parent, const char* name, const char* text, const Options& options) {
    CLI::App& command = *parent.add_subcommand(name, text);
    command.final_callback([this, &options] { chosen_ = options; });
    return command;
  }

  void add_run() {
    CLI::App& run_command = add_command(app_, "run", "Run scenario files", run_);
    run_command.add_option("SCENARIO", run_.files, "Scenario files")->required()->type_name("");
    add_output_options(run_command, run_);
    run_command.add_option("--set", run_.set, "Set a value before the file is checked: --set system.mass='2 kg'")
        ->allow_extra_args(false)
        ->type_name("PATH=VALUE");
    run_command
        .add_option("--jobs", run_.jobs,
                    "Number of threads (default: all cores); with several files, how many run at the same time "
                    "(default: one)")
        ->check(whole_number(max_jobs))
        ->type_name("N");
    run_command.add_flag("--dry-run", run_.dry_run, "Check the files and print what would be run");
    CLI::Option* resume =
        run_command.add_flag("--resume", run_.resume, "Continue an interrupted stress test or sweep");
    run_command
        .add_flag("--overwrite", run_.overwrite,
                  "Discard the cases of an earlier stress test or sweep in the same directory")
        ->excludes(resume);
    run_command.add_flag("--verify", run_.verify,
                         "Compute each result again in another way and compare; the same as numerics.verify");
    add_result_files(run_command, run_);
    add_shown_units(run_command, run_);
    add_plugins(run_command);
  }

  void add_stress() {
    CLI::App& stress_command =
        *app_.add_subcommand("stress", "Export a stress test for other programs, and score their answers");
    stress_command.require_subcommand(1);
    const auto add_common = [&](CLI::App& command, StressOptions& options) {
      command.add_option("SCENARIO", options.file, "A scenario with the analysis stress_test")
          ->required()
          ->type_name("");
      command
          .add_option("--set", options.set, "Set a value before the file is checked, the same for export and score")
          ->allow_extra_args(false)
          ->type_name("PATH=VALUE");
      command.add_option("--jobs", options.jobs, "Number of threads (default: all cores)")
          ->check(whole_number(max_jobs))
          ->type_name("N");
      add_plugins(command);
    };
    CLI::App& export_command =
        add_command(stress_command, "export", "Write the records of all cases, and the key to them", export_);
    add_common(export_command, export_);
    export_command.add_option("--out", export_.out, "Directory for the files; created if missing")
        ->required()
        ->type_name("DIR");
    export_command
        .add_option("--seed", export_.seed,
                    "Seed of the noise, 0 to 9007199254740991 (default: a hidden one, at random)")
        ->type_name("N");
    export_command.add_flag("--overwrite", export_.overwrite, "Remove an earlier export in the directory");
    CLI::App& score_command =
        add_command(stress_command, "score", "Score answers to exported records beside the methods", score_);
    add_common(score_command, score_);
    score_command.add_option("--key", score_.key, "key.json of the export")->required()->type_name("FILE");
    score_command
        .add_option("--answers", score_.answers,
                    "Answers of a program, a CSV file (docs/benchmark.md); may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME=FILE");
    add_output_options(score_command, score_);
  }

  void add_check() {
    CLI::App& check_command = add_command(app_, "check", "Check scenario files without running them", check_);
    check_command.add_option("SCENARIO", check_.files, "Scenario files")->required()->type_name("");
    add_plugins(check_command);
  }

  void add_identify() {
    CLI::App& command =
        add_command(app_, "identify", "Identify friction from measured data, without a scenario", identify_);
    command
        .add_option("DATA", identify_.data, "Data file: CSV, MATLAB .mat or universal file (docs/data-files.md)")
        ->required()
        ->type_name("");
    add_quantity(
        command, "--mass", identify_.mass,
        "Mass, such as '1.042 kg' or '1.042 kg +- 5 g'; without it only methods that do not need it are used");
    add_quantity(command, "--stiffness", identify_.stiffness,
                 "Stiffness, such as '1568 N/m'; '0 N/m' for a mass on a rail without spring");
    add_quantity(
        command, "--gravity-stiffness", identify_.gravity_stiffness,
        "m g l of a pendulum, such as '2.9 N.m': the part of the stiffness, or the whole of it, whose torque "
        "is m g l sin(x)");
    command.add_option("--coordinate", identify_.coordinate, "Kind of the coordinate x (default: from the units)")
        ->type_name("displacement|angle");
    add_quantity(command, "--frequency", identify_.frequency,
                 "Forcing frequency, such as '6.17 Hz'; a free decay has none");
    command
        .add_option(
            "--method", identify_.methods,
            "A method to use; the option is repeated for further ones; default: all methods that can read the data")
        ->allow_extra_args(false)
        ->type_name("METHOD");
    add_errors(command, identify_,
               "Known standard deviation of a measured output amplitude or extreme, such as '0.02 mm'");
    command.add_flag("--robust", identify_.robust, "Bound the influence of outliers (Huber), and replace spikes");
    add_input_and_output(command, identify_);
  }

  void add_next() {
    CLI::App& command =
        add_command(app_, "next", "Say which measurement would narrow the ranges over friction laws", next_);
    command
        .add_option("DATA", next_.data,
                    "Data file with steady states (docs/data-files.md), or a scenario of the analysis identify or "
                    "design")
        ->required()
        ->type_name("");
    add_quantity(command, "--mass", next_.mass, "Mass, such as '1.042 kg'");
    add_quantity(command, "--stiffness", next_.stiffness, "Stiffness, such as '1568 N/m'");
    add_quantity(command, "--frequency", next_.frequency,
                 "Forcing frequency, such as '6.17 Hz', where the data do not state it");
    add_quantity(command, "--most-level", next_.most_level,
                 "Largest input amplitude of the drive, such as '8 mm': none beyond it is advised");
    add_quantity(command, "--most-frequency", next_.most_frequency,
                 "Largest frequency of the drive: none beyond it is advised");
    add_errors(command, next_, "Known standard deviation of a measured output amplitude, such as '0.02 mm'");
    add_input_and_output(command, next_);
  }

  /// The options of `fit` and `predict` about their records.
  void add_record_options(CLI::App& command, RecordOptions& options) {
    command.add_option("--frequency", options.frequency, "Forcing frequency of the base motion, such as '6.17 Hz'")
        ->type_name("QUANTITY");
    command
        .add_option("--amplitude", options.amplitude, "Amplitude of the base motion of histories, such as '5 mm'")
        ->type_name("QUANTITY");
    command
        .add_option("--sigma", options.sigmas,
                    "Known standard deviation of the noise of x, v, a, force or phase: --sigma x='2 um'")
        ->allow_extra_args(false)
        ->type_name("SIGNAL=QUANTITY");
    add_record_kind(command, options.loop, options.drive);
    command.add_option("--set", options.set, "Set a value of the scenario: --set system.friction.sigma2='0 N.s/m'")
        ->allow_extra_args(false)
        ->type_name("PATH=VALUE");
    add_file_options(command, options);
    add_shown_units(command, options);
    add_output_options(command, options);
    add_plugins(command);
  }

  void add_fit() {
    CLI::App& command =
        add_command(app_, "fit", "Fit a friction law and constants of the rig to measured records", fit_);
    command
        .add_option("LAW", fit_.law, "A law of 'dualdamp laws'; several laws, separated by commas, are compared")
        ->required()
        ->type_name("");
    command.add_option("DATA", fit_.data, "Data files, fitted together (docs/data-files.md)")
        ->required()
        ->type_name("");
    command
        .add_option("--free", fit_.free,
                    "Parameters to fit although they are stated, separated by commas: --free mass,sigma2")
        ->type_name("NAMES");
    add_quantity(command, "--mass", fit_.mass,
                 "Mass, such as '1.042 kg'; fitted if it is not stated, zero for loops alone");
    add_quantity(command, "--stiffness", fit_.stiffness,
                 "Stiffness; fitted if it is not stated, zero for loops alone");
    add_quantity(command, "--damping", fit_.damping,
                 "Viscous damping; fitted if it is not stated, zero for loops alone");
    command.add_option("--validate", fit_.validate, "A data file to predict with the fitted rig")
        ->allow_extra_args(false)
        ->type_name("DATA");
    command
        .add_option("--starts", fit_.starts,
                    "Number of starts of the search (default: 40, or 8 if every parameter has a stated value)")
        ->check(whole_number(10'000))
        ->type_name("N");
    command.add_flag("--robust", fit_.robust, "Bound the influence of outliers (Huber)");
    command.add_flag("--no-profile", fit_.no_profile, "Leave out the intervals by the profile of the likelihood");
    add_record_options(command, fit_);
  }

  void add_predict() {
    CLI::App& command = add_command(app_, "predict", "Predict other records with a fitted rig", predict_);
    command.add_option("RESULT", predict_.result, "result.json of a fit, or its directory")
        ->required()
        ->type_name("");
    command.add_option("DATA", predict_.data, "Data files that were not fitted")->required()->type_name("");
    add_record_options(command, predict_);
  }

  void add_report() {
    CLI::App& report_command =
        add_command(app_, "report", "Write report.html of a result directory again", report_);
    report_command.add_option("DIR", report_.directories, "Directories with a result.json")
        ->required()
        ->type_name("");
    add_result_files(report_command, report_);
    add_shown_units(report_command, report_);
  }

  void add_new() {
    CLI::App& new_command = add_command(app_, "new", "Print a commented scenario as a first file", new_);
    new_command.add_option("ANALYSIS", new_.analysis, "Its analysis, such as xy_curve; see dualdamp analyses")
        ->required()
        ->type_name("");
  }

  void add_compare() {
    CLI::App& compare_command =
        add_command(app_, "compare", "Draw the curves of several results in one chart", compare_);
    compare_command.add_option("DIR", compare_.directories, "Two or more directories with a result.json")
        ->required()
        ->expected(2, most_compared)
        ->type_name("");
    add_shown_units(compare_command, compare_);
    compare_command.add_option("--out", compare_.out, "Directory for compare.html, compare.csv and compare.svg")
        ->type_name("DIR")
        ->capture_default_str()
        ->check([](const std::string& text) { return text.empty() ? "DIR is empty" : std::string(); });
  }

  void add_lists() {
    CLI::App& laws_command = add_command(app_, "laws", "List the friction laws, or explain one", laws_);
    CLI::Option* name = laws_command.add_option("LAW", laws_.name, "A law")->type_name("");
    CLI::Option* check =
        laws_command.add_flag("--check", laws_.check, "Test whether the law keeps its contract")->needs(name);
    laws_command.add_option("--set", laws_.set, "A parameter of the law that is tested: --set kinetic='2 N'")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUE")
        ->needs(check);
    laws_command.add_option("--stroke", laws_.stroke, "Longest stroke of the test; it should reach all modes")
        ->type_name("QUANTITY")
        ->capture_default_str()
        ->needs(check);
    laws_command.add_option("--stroke-time", laws_.stroke_time, "Time of such a stroke")
        ->type_name("QUANTITY")
        ->capture_default_str()
        ->needs(check);
    add_plugins(laws_command);
    CLI::App& methods_command =
        add_command(app_, "methods", "List the identification methods, or explain one", methods_);
    methods_command.add_option("METHOD", methods_.name, "A method")->type_name("");
    CLI::App& analyses_command = add_command(app_, "analyses", "List the analyses, or explain one", analyses_);
    analyses_command.add_option("ANALYSIS", analyses_.name, "An analysis")->type_name("");
    CLI::App& schema_command = add_command(app_, "schema", "Print the JSON Schema of scenario files", schema_);
    schema_command.add_flag("--markdown", schema_.markdown, "Print the reference page instead");
    add_plugins(schema_command);
  }

  void add_shell() {
    CLI::App& completion_command =
        add_command(app_, "completion", "Print the completion of commands for a shell", completion_);
    completion_command.add_option("bash|zsh|fish", completion_.shell, "The shell")
        ->required()
        ->type_name("")
        ->check([](const std::string& shell) {
          const bool is_known = shell == "bash" || shell == "zsh" || shell == "fish";
          return is_known ? std::string()
                          : "there is no completion for '" + shell + "'; there are: bash, zsh, fish";
        });
    add_plugins(completion_command);
    add_command(app_, "manual", "Print the manual page: dualdamp manual | man -l -", manual_);
  }

  CLI::App app_{"How far can a friction estimate be trusted when the friction is not what the estimator assumes?",
                "dualdamp"};
  std::vector<std::string> plugins_ = plugins_of_environment();
  std::string isolation_;  ///< seconds, as text: CLI11 accepts only integers as the value of a flag
  RunCommand run_;
  ExportCommand export_;
  ScoreCommand score_;
  CheckCommand check_;
  IdentifyCommand identify_;
  NextCommand next_;
  FitCommand fit_;
  PredictCommand predict_;
  ReportCommand report_;
  CompareCommand compare_;
  NewCommand new_;
  LawsCommand laws_;
  MethodsCommand methods_;
  AnalysesCommand analyses_;
  SchemaCommand schema_;
  CompletionCommand completion_;
  ManualCommand manual_;
  Command chosen_;
};

}  // namespace

Call parse(int argc, const char* const* argv) { return Parser().parse(argc, argv); }

CommandTable command_table() { return Parser().table(); }

}  // namespace dualdamp::cli
