#include "cli/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "bench/analyses.hpp"
#include "bench/processes.hpp"
#include "cli/charts.hpp"
#include "cli/command_output.hpp"
#include "cli/conformance.hpp"
#include "cli/fit_scenario.hpp"
#include "cli/guarded.hpp"
#include "cli/identify_scenario.hpp"
#include "cli/interrupt.hpp"
#include "cli/isolation.hpp"
#include "cli/lists.hpp"
#include "cli/new_scenario.hpp"
#include "cli/option_text.hpp"
#include "cli/print.hpp"
#include "cli/report/result_directory.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/manual.hpp"
#include "cli/startup.hpp"
#include "cli/stress.hpp"
#include "cli/workers.hpp"
#include "core/cancellation.hpp"
#include "core/numbers.hpp"
#include "friction_models/plugin.hpp"
#include "scenarios/output.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/results/staged_files.hpp"
#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/schema.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;
using core::ExitStatus;
using scenarios::LoadOptions;
using scenarios::Scenario;

/// Throws if results cannot be written, before anything is computed.
void refuse_unusable(const std::string& directory) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw scenarios::OutputError("cannot write results to " + directory + ": it is not a directory");
}

/// The processes that mpirun started; one without mpirun. They are finalised when the program ends.
const std::shared_ptr<bench::Processes>& processes() {
  static const auto all = std::make_shared<bench::Processes>();
  return all;
}

/// Meets the others of several processes; throws if MPI cannot start.
void join_processes() {
  if (bench::Processes::several()) processes();
}

/// Whether this process prints nothing: of several processes, only the first one prints.
bool is_silent() { return bench::Processes::several() && processes()->rank() != 0; }

/// Warnings about a data file name it themselves; it may be the file that was asked about.
std::string warning_line(const std::string& file, std::string_view warning) {
  const std::string place = file + ": ";
  if (warning.starts_with(place)) warning.remove_prefix(place.size());
  return place + "warning: " + std::string(warning) + "\n";
}

CommandOutput run_and_write(Scenario loaded, scenarios::RunOptions options, bool quiet) {
  refuse_unusable(options.directory);
  options.processes = processes();
  if (!quiet && processes()->rank() == 0 && ::isatty(STDERR_FILENO) != 0) options.progress = show;
  const std::string directory = options.directory;
  const auto scenario = std::make_shared<const Scenario>(std::move(loaded));
  const auto result = std::make_shared<const scenarios::RunResult>(scenarios::run(*scenario, options));
  if (is_silent()) return {};
  const std::vector<scenarios::OutputFile> files = scenarios::output_files(scenario, result);

  CommandOutput output;
  output.status = result->status;
  output.json = files.back().write;
  output.text = readable(*scenario, *result);
  if (!result->failure.empty()) output.errors = scenario->file + ": error: " + result->failure + "\n";
  if (result->verification && !result->verification->agrees)
    output.errors += scenario->file + ": error: verification: " + result->verification->reason + "\n";
  for (const std::string& warning : result->warnings) output.messages += warning_line(scenario->file, warning);
  {
    std::unique_lock lock(output_mutex(), std::defer_lock);  // an interrupt ends the wait for another process
    scenarios::StagedFiles staged(directory);
    lock.lock();
    core::stop_if_cancelled();
    for (const std::string& message :
         write_results(staged, result->provenance.source, result->provenance.data_sha256, files))
      output.messages += warning_line(scenario->file, message);
  }
  for (const scenarios::OutputFile& file : files)
    output.messages += "wrote " + (fs::path(directory) / file.name).string() + "\n";
  output.messages += "wrote " + (fs::path(directory) / "report.html").string() + "\n";
  return output;
}

/// The units of `--show-in`, which were checked when the option was read.
void show_in(const std::string& units, Scenario& scenario) {
  if (!units.empty()) static_cast<void>(scenarios::ask_for_units(units, scenario.written_units));
}

/// The question as a campaign; nullptr if it is not a campaign.
const scenarios::Campaign* campaign_of(const Scenario& scenario) {
  return dynamic_cast<const scenarios::Campaign*>(scenario.question.get());
}

/// `directory`: where the results would be written; empty if nothing would be run.
CommandOutput checked(const Scenario& scenario, const std::string& directory) {
  CommandOutput output;
  output.text = scenario.file + ": valid: " + scenario.analysis_name;
  if (!directory.empty()) output.text += ", results would go to " + directory;
  output.text += "\n";
  const scenarios::Campaign* campaign = campaign_of(scenario);
  if (campaign != nullptr && !directory.empty())
    output.text += "  " + campaign->size(scenarios::context_of(scenario, {})) + "\n";
  output.json = scenarios::json_checked(scenario);
  return output;
}

/// The name of the results: the file name without extension. Not for `..yaml` and `...yaml`, whose names would be
/// other directories.
std::string stem_of(const std::string& file) {
  const fs::path path(file);
  const std::string stem = path.stem().string();
  return stem == "." || stem == ".." ? path.filename().string() : stem;
}

std::string output_directory(const RunCommand& command, const std::string& file) {
  if (!command.out.empty() && command.files.size() == 1) return command.out;
  const fs::path base = command.out.empty() ? "results" : command.out;
  return (base / stem_of(file)).string();
}

scenarios::FoundCases found_cases(const RunCommand& command) {
  if (command.resume) return scenarios::FoundCases::resume;
  return command.overwrite ? scenarios::FoundCases::overwrite : scenarios::FoundCases::refuse;
}

/// The scenario; or the output in place of a run: a refusal, or the text of a dry run.
CommandOutput load(const RunCommand& command, const std::string& file, std::optional<Scenario>& scenario) {
  return guarded([&]() -> CommandOutput {
    LoadOptions options{.words = key_or_option_of_setting, .analyses = bench::analyses()};
    for (const std::string& assignment : command.set) options.set.push_back({assignment, "--set"});
    if (command.verify) options.set.push_back({"numerics.verify=true", "--verify"});
    Scenario loaded = scenarios::load_scenario(file, options);
    show_in(command.shown_units, loaded);
    if ((command.resume || command.overwrite) && campaign_of(loaded) == nullptr)
      return refused(ExitStatus::usage, file + (command.resume ? ": --resume continues" : ": --overwrite repeats") +
                                            " a stress test or a sweep; this scenario is neither");
    if (command.dry_run) return checked(loaded, output_directory(command, file));
    scenario.emplace(std::move(loaded));
    return {};
  });
}

/// If any of several processes refuses a file, all do. The first process with a reason reports it.
CommandOutput agreed(CommandOutput output) {
  if (!bench::Processes::several()) return output;
  const auto failure = processes()->first_failure(static_cast<int>(output.status));
  if (failure ? failure->rank == processes()->rank() : !is_silent()) return output;
  CommandOutput silent;
  if (failure) silent.status = static_cast<ExitStatus>(failure->status);
  return silent;
}

CommandOutput run_file(const RunCommand& command, const std::string& file) {
  std::optional<Scenario> scenario;
  CommandOutput output = agreed(load(command, file, scenario));
  if (!scenario || output.status != ExitStatus::done) return output;
  bool is_done = false;
  output = guarded([&] {
    CommandOutput result = run_and_write(
        std::move(*scenario),
        {.directory = output_directory(command, file), .threads = command.jobs, .found = found_cases(command)},
        command.quiet);
    is_done = true;
    if (!command.plot.empty() && !is_silent()) add_plot(result, output_directory(command, file), command.plot);
    return result;
  });
  if (is_done || !bench::Processes::several()) return output;
  // All processes must stop, since the others would wait for this one.
  if (command.json) output.json(std::cout);
  print(output, {command.json, command.quiet});
  std::cout.flush();
  announce_end(static_cast<int>(output.status));
  processes()->abort(static_cast<int>(output.status));
}

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
  ExitStatus worst = ExitStatus::done;
  for (const std::string& directory : command.directories) {
    const CommandOutput output = guarded([&] { return report_on(directory, command.shown_units, command.plot); });
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
