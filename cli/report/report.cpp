#include "cli/report/report.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <sstream>
#include <vector>

#include "cli/report/assets.hpp"
#include "cli/report/main_chart.hpp"
#include "cli/report/page.hpp"
#include "cli/report/stored_run.hpp"
#include "scenarios/results/shown_units.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A table for the page: its text without the lines of provenance, with all rows or every `step`-th one.
Json table(const StoredRun& run, const fs::path& path) {
  const std::size_t most_rows = path.stem() == "map" ? 200'000 : 50'000;
  std::vector<std::string> lines;
  std::istringstream file(run.text_of(path));
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with("#") && !line.empty()) lines.push_back(std::move(line));
  const std::size_t rows = lines.empty() ? 0 : lines.size() - 1;
  const std::size_t step = rows / most_rows + 1;
  std::string csv = lines.empty() ? "" : lines.front() + "\n";
  for (std::size_t i = 1; i < lines.size(); i += step) csv += lines[i] + "\n";
  return {{"rows", rows}, {"step", step}, {"csv", std::move(csv)}};
}

Json tables(const StoredRun& run) {
  Json json = Json::object();
  for (const fs::path& path : run.tables()) json[path.stem().string()] = table(run, path);
  return json;
}

/// The document with the units in which the page shows its numbers, and with the curves of a sweep.
Json document(const StoredRun& run) {
  Json json = run.document();
  run.read([&] {
    for (const auto& [si, shown] : scenarios::shown_units(written_units(run)))
      json["shown_units"][si] = {{"unit", shown.unit}, {"factor", shown.factor}, {"asked", shown.is_asked}};
    const auto curves = json.at("result").contains("sweep") ? swept_curves(run) : std::nullopt;
    if (curves)
      json["swept_curves"] = {{"name", curves->table},
                              {"x", curves->x},
                              {"y", curves->y},
                              {"by_x", curves->is_by_x},
                              {"points", curves->points}};
  });
  return json;
}

}  // namespace

scenarios::OutputFile report_page(const std::string& directory, const std::string& units) {
  return {"report.html", [directory, units](std::ostream& out) {
            const StoredRun run(directory, units);
            write_page(out, document(run), tables(run),
                       {assets::views_js, assets::sweep_js, assets::views_of_analyses_js, assets::page_js});
          }};
}

}  // namespace dualdamp::cli
