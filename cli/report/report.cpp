#include "cli/report/report.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "cli/report/assets.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const fs::path& file, std::string message) {
  core::Diagnostic problem;
  problem.place.file = file.string();
  problem.message = std::move(message);
  throw core::InputError(std::move(problem));
}

/// The document without the far end of long lists: their rows are in the tables.
Json document(const fs::path& path) {
  constexpr int depth_of_items = 3;  // {result: {points: [item
  constexpr std::size_t most_items = 5000;
  std::ifstream file(path);
  if (!file) refuse(path, "there is no result here: the file cannot be opened");
  std::size_t items = 0;
  const auto keep = [&](int depth, Json::parse_event_t event, const Json& /*parsed*/) {
    if (event == Json::parse_event_t::array_start && depth < depth_of_items) items = 0;
    const bool is_item = event == Json::parse_event_t::object_end && depth == depth_of_items;
    return !is_item || ++items <= most_items;
  };
  Json json = Json::parse(file, keep, false);
  if (json.is_discarded()) refuse(path, "the file is not a whole JSON document");
  for (const char* key : {"program", "analysis", "status", "result", "warnings", "checks", "errors"})
    if (!json.is_object() || !json.contains(key))
      refuse(path, std::string("this is no result of dualdamp: there is no '") + key + "'");
  // What the points of a sweep hold is in its tables.
  if (json["result"].is_object() && json["result"].contains("sweep"))
    for (Json& point : json["result"]["sweep"]) point.erase("result");
  return json;
}

/// A table as the page gets it: its text without the lines of provenance, all rows or every `step`-th.
Json table(const fs::path& path) {
  const std::size_t most_rows = path.stem() == "map" ? 200'000 : 50'000;
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with("#") && !line.empty()) lines.push_back(std::move(line));
  const std::size_t rows = lines.empty() ? 0 : lines.size() - 1;
  const std::size_t step = rows / most_rows + 1;
  std::string csv = lines.empty() ? "" : lines.front() + "\n";
  for (std::size_t i = 1; i < lines.size(); i += step) csv += lines[i] + "\n";
  return {{"rows", rows}, {"step", step}, {"csv", std::move(csv)}};
}

/// What identifies a run, as its tables state it above their header.
std::map<std::string, std::string> identity_of(const Json& document) {
  std::map<std::string, std::string> identity;
  for (const char* key : {"source", "scenario_sha256", "started"})
    if (document.contains("provenance") && document["provenance"].is_object())
      if (const auto found = document["provenance"].find(key);
          found != document["provenance"].end() && found->is_string())
        identity[key] = found->get<std::string>();
  return identity;
}

/// Was the table written by this run? What somebody else put into the directory was not.
bool belongs_to(const std::map<std::string, std::string>& identity, const fs::path& path) {
  std::size_t found = 0;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with("# ");) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    const auto entry = identity.find(line.substr(2, colon - 2));
    if (entry == identity.end()) continue;
    std::string value = entry->second;
    std::ranges::replace_if(value, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    found += value == line.substr(colon + 2) ? 1 : 0;
  }
  return !identity.empty() && found == identity.size();
}

std::vector<fs::path> tables_of(const fs::path& directory, const Json& document) {
  const std::map<std::string, std::string> identity = identity_of(document);
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    if (entry.path().extension() == ".csv" && entry.is_regular_file() && belongs_to(identity, entry.path()))
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

Json tables(const fs::path& directory, const Json& document) {
  Json json = Json::object();
  for (const fs::path& path : tables_of(directory, document)) json[path.stem().string()] = table(path);
  return json;
}

/// JSON inside a script element: nothing in it may look like the end of one.
std::string embedded(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

/// The template with its places filled; what fills one is not looked through again.
void write_page(std::ostream& out, const std::map<std::string, std::string>& fillings) {
  std::string_view page = assets::page_html;
  while (true) {
    const std::size_t open = page.find('@');
    const std::size_t close = open == std::string_view::npos ? open : page.find('@', open + 1);
    if (close == std::string_view::npos) break;
    out << page.substr(0, open) << fillings.at(std::string(page.substr(open + 1, close - open - 1)));
    page.remove_prefix(close + 1);
  }
  out << page;
}

}  // namespace

scenarios::OutputFile report_page(const std::string& directory) {
  return {"report.html", [directory](std::ostream& out) {
            const fs::path place(directory);
            std::string script;
            for (const std::string_view part :
                 {assets::d3_min_js, assets::data_js, assets::elements_js, assets::chart_js, assets::views_js,
                  assets::sweep_js, assets::views_of_analyses_js, assets::page_js})
              script += std::string(part) + "\n";
            const Json result = document(place / "result.json");
            write_page(out, {{"style", std::string(assets::page_css)},
                             {"document", embedded(result)},
                             {"tables", embedded(tables(place, result))},
                             {"script", std::move(script)}});
          }};
}

std::optional<StoredResult> stored_result(const std::string& directory) {
  const fs::path place(directory);
  std::error_code error;
  if (!fs::is_regular_file(place / "result.json", error)) return std::nullopt;
  try {
    const Json result = document(place / "result.json");
    StoredResult stored;
    if (const auto identity = identity_of(result); identity.contains("source"))
      stored.source = identity.at("source");
    for (const fs::path& path : tables_of(place, result)) stored.tables.push_back(path.filename().string());
    return stored;
  } catch (const core::InputError&) {
    return std::nullopt;  // no result of ours
  }
}

}  // namespace dualdamp::cli
