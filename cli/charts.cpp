#include "cli/charts.hpp"

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "cli/report/asked_units.hpp"
#include "cli/report/comparison.hpp"
#include "cli/report/main_chart.hpp"
#include "cli/report/result_directory.hpp"
#include "cli/report/svg.hpp"
#include "core/diagnostics.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

namespace fs = std::filesystem;

std::string plot_result(const std::string& directory, const std::string& file, const std::string& units) {
  const Chart chart = main_chart(directory, units);
  const fs::path path(file);
  std::string messages;
  if (!chart.note.empty()) messages += "warning: " + file + ": " + chart.note + "; all are in the tables\n";
  for (const std::string& warning :
       write_keeping(path.has_parent_path() ? path.parent_path().string() : ".",
                     {{path.filename().string(), [&](std::ostream& out) { write_svg(out, chart); }}}))
    messages += warning + "\n";
  return messages + "wrote " + file + "\n";
}

void add_plot(CommandOutput& output, const std::string& directory, const std::string& file) {
  try {
    output.messages += plot_result(directory, file);
  } catch (const core::InputError& error) {
    for (const core::Diagnostic& problem : error.diagnostics()) output.errors += core::format(problem) + "\n";
    output.status = std::max(output.status, core::ExitStatus::usage);
  }
}

std::string compare_results(const std::vector<std::string>& directories, const std::string& out,
                            const std::string& units) {
  const std::vector<scenarios::OutputFile> files = comparison(directories, units);
  std::string messages = warning_of_asked_units(directories, units);
  for (const std::string& warning : write_keeping(out, files)) messages += warning + "\n";
  for (const scenarios::OutputFile& file : files)
    messages += "wrote " + (fs::path(out) / file.name).string() + "\n";
  return messages;
}

}  // namespace dualdamp::cli
