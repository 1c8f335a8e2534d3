#include "cli/charts.hpp"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/guarded.hpp"
#include "cli/report/asked_units.hpp"
#include "cli/report/comparison.hpp"
#include "cli/report/main_chart.hpp"
#include "cli/report/report.hpp"
#include "cli/report/result_directory.hpp"
#include "cli/report/stored_run.hpp"
#include "cli/report/svg.hpp"
#include "core/diagnostics.hpp"
#include "core/input_file.hpp"
#include "scenarios/results/files.hpp"
#include "scenarios/results/mat_file.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::cli {

namespace fs = std::filesystem;

namespace {

/// Writes one file. Returns messages.
std::string write_file(const std::string& file, const scenarios::Writer& writer) {
  const fs::path path(file);
  std::string messages;
  for (const std::string& warning : write_keeping(path.has_parent_path() ? path.parent_path().string() : ".",
                                                  {{path.filename().string(), writer}}))
    messages += warning + "\n";
  return messages + "wrote " + file + "\n";
}

/// A stored table as a run had it.
scenarios::Table table_of(const StoredRun& run, const std::string& name) {
  scenarios::Table table{.name = name};
  for (StoredColumn& column : run.table(name).columns) {
    scenarios::Column& added = table.columns.emplace_back();
    added.kind = column.is_text ? scenarios::CellKind::text : scenarios::CellKind::number;
    added.name = std::move(column.name);
    added.unit = std::move(column.unit);
    added.numbers = std::move(column.numbers);
    added.texts = std::move(column.texts);
  }
  return table;
}

}  // namespace

std::string plot_result(const std::string& directory, const std::string& file, const std::string& units) {
  const Chart chart = main_chart(directory, units);
  std::string messages;
  if (!chart.note.empty()) messages += "warning: " + file + ": " + chart.note + "; all are in the tables\n";
  return messages + write_file(file, [&](std::ostream& out) { write_svg(out, chart); });
}

std::string export_result(const std::string& directory, const std::string& file) {
  const StoredRun run(directory);
  std::vector<scenarios::Table> tables;
  for (const fs::path& path : run.tables()) tables.push_back(table_of(run, path.stem().string()));
  return write_file(
      file, [&](std::ostream& out) { scenarios::write_mat(out, tables, run.document().at("provenance").dump()); });
}

void add_files(CommandOutput& output, const std::string& directory, const ResultFiles& files) {
  try {
    if (!files.mat.empty()) output.messages += export_result(directory, files.mat);
    if (!files.plot.empty()) output.messages += plot_result(directory, files.plot);
  } catch (const core::InputError& error) {
    for (const core::Diagnostic& problem : error.diagnostics()) output.errors += core::format(problem) + "\n";
    output.status = std::max(output.status, core::ExitStatus::usage);
  }
}

CommandOutput report_on(const std::string& directory, const std::string& units, const ResultFiles& files) {
  // A missing directory has no result; it is not created.
  if (std::error_code error; !fs::is_directory(directory, error)) {
    if (error && !core::is_fault_of_name(error.value()))
      throw std::system_error(error, directory + ": cannot be opened");
    const bool says_more = error && error != std::errc::no_such_file_or_directory;
    return refused(core::ExitStatus::invalid_input,
                   directory + ": there is no such directory" + (says_more ? " (" + error.message() + ")" : ""));
  }
  CommandOutput done;
  if (const std::string idle = warning_of_asked_units({directory}, units); !idle.empty())
    done.messages += directory + ": " + idle;
  for (const std::string& warning : write_keeping(directory, {report_page(directory, units)}))
    done.messages += warning + "\n";
  done.messages += "wrote " + (fs::path(directory) / "report.html").string() + "\n";
  if (!files.mat.empty()) done.messages += export_result(directory, files.mat);
  if (!files.plot.empty()) done.messages += plot_result(directory, files.plot, units);
  return done;
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
