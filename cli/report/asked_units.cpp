#include "cli/report/asked_units.hpp"

#include <map>
#include <set>

#include "bench/analyses.hpp"
#include "cli/report/stored_run.hpp"
#include "scenarios/analyses.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/results/shown_units.hpp"

namespace dualdamp::cli {

namespace {

using Json = StoredRun::Json;

/// The kinds of the quantities of a result: those of its analysis, and those of the columns of its tables.
void collect_kinds(const StoredRun& run, std::set<std::string>& kinds) {
  const Json units = run.document().value("units", Json::object());
  for (const auto& [path, unit] : units.items()) kinds.insert(scenarios::kind_of(unit.get<std::string>(), path));
  if (!run.document().contains("units") && run.document().at("analysis").is_string()) {
    const auto* analysis =
        scenarios::find_analysis(bench::analyses(), run.document().at("analysis").get<std::string>());
    if (analysis != nullptr)
      for (const scenarios::ResultField& field : analysis->results)
        if (field.unit != scenarios::unit_of_drive) kinds.insert(scenarios::kind_of(field.unit, field.path));
  }
  for (const std::filesystem::path& path : run.tables())
    for (const StoredColumn& column : run.table(path.stem().string()).columns)
      kinds.insert(scenarios::kind_of(column.unit, column.name));
}

}  // namespace

std::string warning_of_asked_units(const std::vector<std::string>& directories, const std::string& units) {
  if (units.empty()) return {};
  std::set<std::string> kinds;
  std::map<std::string, std::string> written;
  for (const std::string& directory : directories) {
    const StoredRun run(directory, units);
    run.read([&] {
      collect_kinds(run, kinds);
      written = written_units(run);
    });
  }
  const std::vector<std::string> unused = scenarios::unused_units(written, kinds);
  for (const std::string_view none : {"", "1"}) kinds.erase(std::string(none));
  const std::string warning = scenarios::warning_of_units(unused, written, {kinds.begin(), kinds.end()});
  return warning.empty() ? warning : "warning: " + warning + "\n";
}

}  // namespace dualdamp::cli
