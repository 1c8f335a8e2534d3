#include "cli/report/stored_run.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/provenance.hpp"
#include "scenarios/format/json_text.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/results/files.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;
using Json = StoredRun::Json;

constexpr const char* as_no_run_writes = "the file is not as a run wrote it: run the scenario again";

/// A document with long lists cut off: the tables have all rows. The results of the points of a sweep are in its
/// tables as well.
class DocumentBuilder : public scenarios::JsonBuilder {
 protected:
  [[nodiscard]] Use use_of(bool is_object) const override {
    constexpr std::size_t depth_of_items = 3;  // {result: {points: [item
    constexpr std::size_t most_items = 5000;
    if (depth() == 0) return is_object ? Use::keep : Use::stop;
    if (depth() == depth_of_items && is_object && parent().is_array() && parent().size() >= most_items)
      return Use::leave_out;
    const bool is_point = depth() == depth_of_items + 1 && key_at(0) == "result" && key_at(1) == "sweep";
    return is_point && key_at(depth_of_items) == "result" ? Use::leave_out : Use::keep;
  }
  [[nodiscard]] std::size_t most_in_list() const override { return 100'000; }
};

/// The provenance of a document that begins as a run writes it. What follows is not read.
class ProvenanceBuilder : public scenarios::JsonBuilder {
 protected:
  [[nodiscard]] Use use_of(bool is_object) const override {
    if (depth() == 0) return is_object ? Use::keep : Use::stop;
    if (depth() > 1) return Use::keep;
    return key_at(0) == "program" || key_at(0) == "provenance" ? Use::keep : Use::stop;
  }
};

Json read_document(const fs::path& path) {
  if (std::error_code error; !fs::exists(path, error) && !error)
    core::refuse({.file = path.string()}, "there is no result here: the file cannot be opened");
  DocumentBuilder builder;
  if (!scenarios::parse_json_file(path.string(), builder))
    core::refuse({.file = path.string()}, builder.is_beyond_limits()
                                              ? "the file holds more, or nests deeper, than any result of a run"
                                              : "the file is not a whole JSON document");
  Json json = builder.take();
  for (const char* key : {"program", "analysis", "status", "result", "warnings", "checks", "errors"})
    if (!json.is_object() || !json.contains(key))
      core::refuse({.file = path.string()},
                   std::string("this is no result of dualdamp: there is no '") + key + "'");
  if (!json["result"].is_object() || !json["result"].contains("sweep")) return json;
  const Json& points = json["result"]["sweep"];
  if (!points.is_array() || !std::ranges::all_of(points, &Json::is_object))
    core::refuse({.file = path.string()}, as_no_run_writes);
  for (Json& point : json["result"]["sweep"]) point.erase("result");  // a failed one is null
  return json;
}

/// Whether this run, which states no sums, wrote the table. Other files in the directory may come from elsewhere.
bool belongs_to(const std::map<std::string, std::string>& identity, const fs::path& path) {
  constexpr std::size_t most_bytes = 1U << 16U;
  std::size_t found = 0;
  std::string beginning;
  try {
    beginning = scenarios::beginning_of(path.string(), most_bytes);
  } catch (const std::system_error& fault) {
    if (fault.code() == std::errc::permission_denied) return false;
    throw;
  }
  std::istringstream file(std::move(beginning));
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

/// SHA-256 of the tables by name; empty if the run states none.
std::map<std::string, std::string> sums_of(const fs::path& directory, const Json& document) {
  const Json& provenance = document.value("provenance", Json());
  if (!provenance.is_object() || !provenance.contains("tables")) return {};
  std::map<std::string, std::string> sums;
  if (!provenance["tables"].is_object())
    core::refuse({.file = (directory / "result.json").string()}, as_no_run_writes);
  for (const auto& [name, sum] : provenance["tables"].items()) {
    if (!sum.is_string()) core::refuse({.file = (directory / "result.json").string()}, as_no_run_writes);
    sums[name] = sum.get<std::string>();
  }
  return sums;
}

/// The facts that identify a run, as its tables state them above their header.
std::map<std::string, std::string> identity_of(const Json& document) {
  std::map<std::string, std::string> identity;
  for (const char* key : {"source", "scenario_sha256", "started"})
    if (document.contains("provenance") && document["provenance"].is_object())
      if (const auto found = document["provenance"].find(key);
          found != document["provenance"].end() && found->is_string())
        identity[key] = found->get<std::string>();
  return identity;
}

std::vector<fs::path> tables_of(const fs::path& directory, const Json& document,
                                const std::map<std::string, std::string>& sums) {
  const std::map<std::string, std::string> identity = identity_of(document);
  std::vector<fs::path> paths;
  std::error_code unseen;  // what cannot be examined is no table
  for (const fs::directory_entry& entry : fs::directory_iterator(directory))
    if (entry.path().extension() == ".csv" && entry.is_regular_file(unseen) &&
        (sums.empty() ? belongs_to(identity, entry.path()) : sums.contains(entry.path().filename().string())))
      paths.push_back(entry.path());
  std::ranges::sort(paths);
  return paths;
}

/// Fields of one line of CSV.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> list = {""};
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
      list.back() += line[i++];
    else if (line[i] == '"')
      is_quoted = !is_quoted;
    else if (line[i] == ',' && !is_quoted)
      list.emplace_back();
    else
      list.back() += line[i];
  }
  return list;
}

StoredColumn column_of(const std::string& heading) {
  StoredColumn column{.name = heading};
  const std::size_t open = heading.find(" [");
  if (open == std::string::npos || !heading.ends_with(']')) return column;
  column.name = heading.substr(0, open);
  column.unit = heading.substr(open + 2, heading.size() - open - 3);
  return column;
}

void finish(StoredColumn& column) {
  for (const std::string& text : column.texts) {
    const auto number = core::parse_number(text).value;
    column.is_text = column.is_text || (!number && !text.empty());
    column.numbers.push_back(number.value_or(scenarios::none));
  }
}

}  // namespace

std::map<std::string, std::string> written_units(const StoredRun& run) {
  const Json provenance = run.document().value("provenance", Json());
  if (!provenance.is_object()) return {};
  return provenance.value("written_units", Json::object()).get<std::map<std::string, std::string>>();
}

std::string shown(const fs::path& path) {
  const std::string whole = Json(path.string()).dump(-1, ' ', false, Json::error_handler_t::replace);
  auto text = Json::parse(whole).get<std::string>();
  std::ranges::replace_if(text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::optional<EarlierResult> earlier_result(const std::string& directory) {
  const fs::path path = fs::path(directory) / "result.json";
  if (std::error_code error; !fs::is_regular_file(path, error)) return std::nullopt;
  ProvenanceBuilder builder;
  static_cast<void>(scenarios::parse_json_file(path.string(), builder));
  const Json document = builder.take();
  const auto has = [](const Json& object, const char* key, const char* of) {
    return object.is_object() && object.contains(key) && object[key].is_object() && object[key].contains(of);
  };
  if (!has(document, "program", "name") || document["program"]["name"] != "dualdamp" ||
      !has(document, "provenance", "source"))
    return std::nullopt;
  try {
    EarlierResult result{.sums = sums_of(directory, document)};
    const auto identity = identity_of(document);
    if (identity.contains("source")) result.source = identity.at("source");
    for (const fs::path& table : tables_of(directory, document, result.sums))
      result.tables.push_back(table.filename().string());
    return result;
  } catch (const core::InputError&) {
    return std::nullopt;  // its provenance is not as a run wrote it
  }
}

const StoredColumn* StoredTable::find(std::string_view name) const {
  const auto found = std::ranges::find(columns, name, &StoredColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

StoredRun::StoredRun(const std::string& directory, const std::string& units)
    : directory_(directory),
      document_(read_document(directory_ / "result.json")),
      sums_(sums_of(directory_, document_)),
      tables_(tables_of(directory_, document_, sums_)) {
  if (units.empty()) return;
  read([&] {
    std::map<std::string, std::string> written = written_units(*this);
    std::erase_if(written, [](const auto& entry) { return scenarios::is_asked_for(entry.first); });
    static_cast<void>(scenarios::ask_for_units(units, written));
    document_["provenance"]["written_units"] = written;
  });
}

void StoredRun::read(const std::function<void()>& work) const {
  try {
    work();
  } catch (const Json::exception&) {
    core::refuse({.file = (directory_ / "result.json").string()}, as_no_run_writes);
  } catch (const ChangedResult& fault) {
    core::refuse({.file = (directory_ / "result.json").string()},
                 std::string("the file or a table beside it is not as a run wrote it: ") + fault.what());
  }
}

std::string StoredRun::text_of(const fs::path& table) const {
  std::string text = scenarios::read_file(table.string(), std::numeric_limits<std::size_t>::max());
  const auto sum = sums_.find(table.filename().string());
  if (sum != sums_.end() && sum->second != core::sha256(text))
    core::refuse({.file = table.string()}, "the table is not as the run wrote it: run the scenario again");
  return text;
}

StoredTable StoredRun::table(std::string_view name) const {
  StoredTable table;
  const auto path = std::ranges::find(tables_, name, [](const fs::path& p) { return p.stem().string(); });
  if (path == tables_.end()) return table;
  std::istringstream file(text_of(*path));
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.starts_with("#")) continue;
    const std::vector<std::string> row = fields(line);
    if (table.columns.empty()) {
      for (const std::string& heading : row) table.columns.push_back(column_of(heading));
      continue;
    }
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      table.columns[i].texts.push_back(i < row.size() ? row[i] : "");
  }
  for (StoredColumn& column : table.columns) finish(column);
  return table;
}

StoredTable StoredRun::list(std::string_view path) const {
  StoredTable table;
  const Json* const found = scenarios::find_value(document_.at("result"), path);
  if (found == nullptr || !found->is_array()) return table;
  const Json& rows = *found;
  for (const Json& row : rows)
    for (const auto& [key, value] : row.items())
      if (table.find(key) == nullptr) table.columns.push_back({.name = key});
  for (StoredColumn& column : table.columns)
    for (const Json& row : rows) {
      const Json value = row.value(column.name, Json());
      column.numbers.push_back(value.is_number() ? value.get<double>() : scenarios::none);
      column.texts.push_back(value.is_string() ? value.get<std::string>() : "");
      column.is_text = column.is_text || value.is_string();
    }
  return table;
}

}  // namespace dualdamp::cli
