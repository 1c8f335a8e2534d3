#include "cli/commands.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <new>
#include <optional>
#include <string>

#include "bench/analyses.hpp"
#include "bench/processes.hpp"
#include "cli/charts.hpp"
#include "cli/command_line/option_text.hpp"
#include "cli/command_output.hpp"
#include "cli/conformance.hpp"
#include "cli/fit_scenario.hpp"
#include "cli/guarded.hpp"
#include "cli/identify_scenario.hpp"
#include "cli/interrupt.hpp"
#include "cli/isolation.hpp"
#include "cli/lists.hpp"
#include "cli/new_scenario.hpp"
#include "cli/scenario_run.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/manual.hpp"
#include "cli/startup.hpp"
#include "cli/stress.hpp"
#include "cli/workers.hpp"
#include "core/cancellation.hpp"
#include "friction_models/plugin.hpp"
#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/schema.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;
using core::ExitStatus;
using scenarios::Scenario;

/// Fails if stdout is full or closed, since the result did not arrive.
int finish(ExitStatus status) {
  std::cout.flush();
  if (std::cout) return static_cast<int>(status);
  std::cerr << "error: cannot write to standard output\n";
  return static_cast<int>(ExitStatus::usage);
}

int say(const CommandOutput& output, const Style& style) {
  if (style.json) output.json(std::cout);
  print(output, style);
  return finish(output.status);
}

/// Refuses two files with the same result directory: they would overwrite each other.
std::string clash(const RunCommand& command) {
  std::map<std::string, std::string> owners;
  for (const std::string& file : command.files) {
    const auto [owner, is_new] = owners.emplace(output_directory(command, file), file);
    if (!is_new) return owner->second + " and " + file + " would both write to " + owner->first;
  }
  return {};
}

int execute(const RunCommand& command) {
  const Style style{command.json, command.quiet};
  for (const std::string& assignment : command.set)
    if (assignment.find('=') == std::string::npos)
      return say(refused(ExitStatus::usage, "--set needs PATH=VALUE, not '" + assignment + "'"), style);
  if (!command.plot.empty() && command.files.size() > 1)
    return say(refused(ExitStatus::usage, "--plot takes the chart of one scenario, not of several"), style);
  if (!command.mat.empty() && command.files.size() > 1)
    return say(refused(ExitStatus::usage, "--mat takes the tables of one scenario, not of several"), style);
  if (const std::string problem = clash(command); !problem.empty())
    return say(refused(ExitStatus::usage, problem), style);
  const CommandOutput joined = guarded([] {
    join_processes();
    return CommandOutput{};
  });
  if (joined.status != ExitStatus::done) return say(joined, style);

  InOrder outputs(command.files.size(), style);
  {
    // Processes that share stress tests must take the files in the same order.
    const int jobs = bench::Processes::several() ? 1 : std::max(command.jobs, 1);
    const std::size_t workers = std::min(static_cast<std::size_t>(jobs), command.files.size());
    std::optional<sim::ThreadLimit> limit;
    if (command.jobs > 0) limit.emplace(std::max(command.jobs - static_cast<int>(workers) + 1, 1));
    share_among(workers, command.files.size(),
                [&](std::size_t i) { outputs.put(i, run_file(command, command.files[i])); });
  }
  if (command.json && !is_silent()) outputs.write_json(std::cout);
  return finish(outputs.worst());
}

int execute(const CheckCommand& command) {
  InOrder outputs(command.files.size(), {});
  for (std::size_t i = 0; i < command.files.size(); ++i)
    outputs.put(i, guarded([&] {
                  return checked(scenarios::load_scenario(command.files[i], {.words = key_or_option_of_setting,
                                                                             .analyses = bench::analyses()}),
                                 {});
                }));
  return finish(outputs.worst());
}

/// Runs a scenario about files. Unless an option names the directory, the results are named after the first file.
template <typename FileCommand>
int execute_on_files(const FileCommand& command, const std::string& file, const char* suffix = "",
                     scenarios::RunOptions options = {}) {
  const Style style{command.json, command.quiet};
  return say(guarded([&] {
               const fs::path standard = fs::path("results") / (stem_of(file) + suffix);
               Scenario scenario = scenario_of(command);
               if constexpr (requires { command.shown_units; }) show_in(command.shown_units, scenario);
               options.directory = command.out.empty() ? standard.string() : command.out;
               return run_and_write(std::move(scenario), std::move(options), command.quiet);
             }),
             style);
}

int execute(const IdentifyCommand& command) { return execute_on_files(command, command.data); }

int execute(const NextCommand& command) { return execute_on_files(command, command.data, "_next"); }

int execute(const FitCommand& command) { return execute_on_files(command, command.data.front()); }

int execute(const PredictCommand& command) { return execute_on_files(command, command.data.front()); }

int execute(const ExportCommand& command) {
  return say(guarded([&] {
               CommandOutput output;
               output.messages = export_stress_test(command);
               return output;
             }),
             {});
}

int execute(const ScoreCommand& command) {
  // The estimates of the methods are stored, and are the same for all entries.
  return execute_on_files(command, command.file, "-scored",
                          {.threads = command.jobs, .found = scenarios::FoundCases::resume});
}

int execute(const ReportCommand& command) {
  if (!command.plot.empty() && command.directories.size() > 1)
    return say(refused(ExitStatus::usage, "--plot takes the chart of one directory, not of several"), {});
  if (!command.mat.empty() && command.directories.size() > 1)
    return say(refused(ExitStatus::usage, "--mat takes the tables of one directory, not of several"), {});
  ExitStatus worst = ExitStatus::done;
  for (const std::string& directory : command.directories) {
    const CommandOutput output = guarded([&] { return report_on(directory, command.shown_units, command); });
    print(output, {});
    worst = std::max(worst, output.status);
  }
  return finish(worst);
}

int execute(const CompareCommand& command) {
  return say(guarded([&] {
               refuse_unusable(command.out);
               CommandOutput output;
               output.messages = compare_results(command.directories, command.out, command.shown_units);
               return output;
             }),
             {});
}

CommandOutput text_output(std::string text) {
  CommandOutput output;
  output.text = std::move(text);
  return output;
}

CommandOutput of_list(const Listing& listing) {
  return listing.found ? text_output(listing.text) : refused(ExitStatus::usage, listing.text);
}

int execute(const LawsCommand& command) {
  const Listing listing = list_laws(command.name);
  if (!command.check || !listing.found) return say(of_list(listing), {});
  return say(guarded([&] {
               const Conformance conformance = check_law(command);
               CommandOutput output;
               output.status = conformance.holds ? ExitStatus::done : ExitStatus::check_failed;
               output.text = conformance.text;
               return output;
             }),
             {});
}

int execute(const MethodsCommand& command) { return say(of_list(list_methods(command.name)), {}); }

int execute(const AnalysesCommand& command) { return say(of_list(list_analyses(command.name)), {}); }

int execute(const NewCommand& command) { return say(of_list(new_scenario(command.analysis)), {}); }

int execute(const SchemaCommand& command) {
  return say(text_output(command.markdown ? scenarios::reference_page(bench::analyses())
                                          : scenarios::json_schema(bench::analyses())),
             {});
}

int execute(const CompletionCommand& command) {
  return say(text_output(completion_script(command.shell, command_table())), {});
}

int execute(const ManualCommand& /*command*/) { return say(text_output(manual_page(command_table())), {}); }

int execute(const Leave& leave) {
  if (leave.status == 0) {
    std::cout << leave.message << (leave.message.ends_with('\n') ? "" : "\n");
    return finish(ExitStatus::done);
  }
  CommandOutput output = refused(ExitStatus::usage, leave.message);
  output.errors += "see: " + leave.help + "\n";
  return say(output, {leave.json, false});
}

/// Loads the plugins. If one is refused, prints the reason and returns the exit status.
std::optional<int> load_plugins(const std::vector<std::string>& files, const Style& style) {
  try {
    for (const std::string& file : files) friction::load_plugin(file);
    return std::nullopt;
  } catch (const core::InputError& error) {
    return say(refused(ExitStatus::usage, error.diagnostics()), style);
  }
}

int interrupted() {
  say_interrupted();
  return static_cast<int>(ExitStatus::interrupted);
}

template <typename ChosenCommand>
Style style_of(const ChosenCommand& command) {
  if constexpr (requires { command.quiet; }) return {command.json, command.quiet};
  return {};
}

}  // namespace

int execute(const Call& call) noexcept {
  try {
    int status = 0;
    const CommandOutput fault = guarded([&] {
      status = std::visit(
          [&](const auto& chosen) {
            const std::optional<int> failed = load_plugins(call.plugins, style_of(chosen));
            return failed ? *failed : execute(chosen);
          },
          call.command);
      return CommandOutput{};
    });
    if (fault.status != ExitStatus::done) status = say(fault, {call.json, false});
    return core::cancellation_requested() ? interrupted() : status;
  } catch (const core::Cancelled&) {
    return interrupted();
  } catch (const std::bad_alloc&) {  // there is none left for a message either
    return say_out_of_memory();
  }
}

}  // namespace dualdamp::cli
