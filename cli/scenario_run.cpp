#include "cli/scenario_run.hpp"

#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/analyses.hpp"
#include "bench/processes.hpp"
#include "cli/charts.hpp"
#include "cli/command_line/option_text.hpp"
#include "cli/guarded.hpp"
#include "cli/interrupt.hpp"
#include "cli/isolation.hpp"
#include "cli/print.hpp"
#include "cli/report/result_directory.hpp"
#include "core/cancellation.hpp"
#include "scenarios/output.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/results/staged_files.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;
using core::ExitStatus;
using scenarios::Scenario;

/// The processes that mpirun started; one without mpirun. They are finalised when the program ends.
const std::shared_ptr<bench::Processes>& processes() {
  static const auto all = std::make_shared<bench::Processes>();
  return all;
}

/// Warnings about a data file name it themselves; it may be the file that was asked about.
std::string warning_line(const std::string& file, std::string_view warning) {
  const std::string place = file + ": ";
  if (warning.starts_with(place)) warning.remove_prefix(place.size());
  return place + "warning: " + std::string(warning) + "\n";
}

/// The question as a campaign; nullptr if it is not a campaign.
const scenarios::Campaign* campaign_of(const Scenario& scenario) {
  return dynamic_cast<const scenarios::Campaign*>(scenario.question.get());
}

scenarios::FoundCases found_cases(const RunCommand& command) {
  if (command.resume) return scenarios::FoundCases::resume;
  return command.overwrite ? scenarios::FoundCases::overwrite : scenarios::FoundCases::refuse;
}

/// The scenario; or the output in place of a run: a refusal, or the text of a dry run.
CommandOutput load(const RunCommand& command, const std::string& file, std::optional<Scenario>& scenario) {
  return guarded([&]() -> CommandOutput {
    scenarios::LoadOptions options{.words = key_or_option_of_setting, .analyses = bench::analyses()};
    for (const std::string& assignment : command.set) options.set.push_back({assignment, "--set"});
    if (command.verify) options.set.push_back({"numerics.verify=true", "--verify"});
    Scenario loaded = scenarios::load_scenario(file, options);
    show_in(command.shown_units, loaded);
    if ((command.resume || command.overwrite) && campaign_of(loaded) == nullptr)
      return refused(ExitStatus::usage, file + (command.resume ? ": --resume continues" : ": --overwrite repeats") +
                                            " a stress test or a sweep; this scenario is neither");
    if (command.dry_run) return checked(loaded, output_directory(command, file), command);
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

}  // namespace

void refuse_unusable(const std::string& directory) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw scenarios::OutputError("cannot write results to " + directory + ": it is not a directory");
}

void join_processes() {
  if (bench::Processes::several()) processes();
}

bool is_silent() { return bench::Processes::several() && processes()->rank() != 0; }

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

void show_in(const std::string& units, Scenario& scenario) {
  if (!units.empty()) static_cast<void>(scenarios::ask_for_units(units, scenario.written_units));
}

CommandOutput checked(const Scenario& scenario, const std::string& directory, const ResultFiles& files) {
  CommandOutput output;
  output.text = scenario.file + ": valid: " + scenario.analysis_name;
  if (!directory.empty()) {
    output.text += ", results would go to " + directory;
    if (!files.plot.empty()) output.text += ", the chart to " + files.plot;
    if (!files.mat.empty()) output.text += ", the tables to " + files.mat;
    if (scenario.verify) output.text += ", and each result would be computed again in another way";
  }
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
    if (!is_silent()) add_files(result, output_directory(command, file), command);
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

}  // namespace dualdamp::cli
