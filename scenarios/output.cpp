#include "scenarios/output.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/build_info.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

namespace {

Json program_json() {
  const core::BuildInfo build = core::build_info();
  Json libraries = Json::object();
  for (const core::Library& library : core::libraries()) libraries[library.name] = library.version;
  return {{"name", "dualdamp"},         {"version", build.version},       {"commit", build.commit},
          {"compiler", build.compiler}, {"build_type", build.build_type}, {"libraries", libraries}};
}

Json provenance_json(const core::Provenance& provenance) {
  Json json = {{"source", provenance.source}, {"source_sha256", provenance.source_sha256}};
  if (!provenance.overrides.empty()) json["set"] = provenance.overrides;
  // Usually there is one file: its digest is then a text instead of a list.
  const std::vector<std::string>& sums = provenance.data_sha256;
  if (!sums.empty()) json["data_sha256"] = sums.size() == 1 ? Json(sums.front()) : Json(sums);
  for (const core::Plugin& plugin : provenance.plugins)
    json["plugins"].push_back(
        {{"law", plugin.law}, {"version", plugin.version}, {"file", plugin.file}, {"sha256", plugin.sha256}});
  json["scenario_sha256"] = provenance.scenario_sha256;
  json["tolerance"] = provenance.tolerance;
  json["started"] = provenance.started;
  json["duration"] = provenance.duration;
  return json;
}

Json diagnostic_json(const core::Diagnostic& diagnostic) {
  Json json = Json::object();
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  add("file", diagnostic.place.file);
  if (diagnostic.place.line > 0) json["line"] = diagnostic.place.line;
  if (diagnostic.place.column > 0) json["column"] = diagnostic.place.column;
  add("text", diagnostic.place.text);
  add("message", diagnostic.message);
  add("allowed", diagnostic.allowed);
  add("found", diagnostic.found);
  add("suggestion", diagnostic.suggestion);
  return json;
}

Json checks_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& check : checks) {
    Json item = {{"value", check.path}, {"expected", check.expected}, {"found", check.found}};
    if (check.difference) item["difference"] = *check.difference;
    item["ok"] = check.ok;
    if (!check.source.empty()) item["source"] = check.source;
    list.push_back(std::move(item));
  }
  return list;
}

/// Units of the numbers in the result, by path: for an angle they differ from those of the reference page.
Json units_json(const std::vector<ResultField>& fields) {
  Json json = Json::object();
  for (const ResultField& field : fields)
    if (!field.unit.empty() && field.unit != "1") json[field.path] = field.unit;
  return json;
}

/// The keys every document has, in order.
Json frame(core::ExitStatus status) {
  Json json;
  json["program"] = program_json();
  json["provenance"] = nullptr;
  json["scenario"] = nullptr;
  json["analysis"] = nullptr;
  json["status"] = static_cast<int>(status);
  json["result"] = nullptr;
  json["warnings"] = Json::array();
  json["checks"] = Json::array();
  json["errors"] = Json::array();
  return json;
}

constexpr int indent = 2;

/// A value whose lines after the first begin with `margin`. A line break inside a text is escaped in JSON.
std::string indented(const Json& json, const std::string& margin) {
  // File names on the command line may not be UTF-8.
  const std::string text = json.dump(indent, ' ', false, Json::error_handler_t::replace);
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result += margin;
  }
  return result;
}

Writer text_writer(std::string text) {
  return [text = std::move(text)](std::ostream& out) { out << text; };
}

Writer document_writer(const Json& json) { return text_writer(indented(json, "") + "\n"); }

/// The members of a map one by one, each written by `write_value(key, value, margin)`.
template <typename WriteValue>
void write_members(std::ostream& out, const Json& json, const std::string& margin, WriteValue write_value) {
  const std::string inner = margin + std::string(indent, ' ');
  const char* separator = "{\n";
  for (const auto& [key, value] : json.items()) {
    out << separator << inner << Json(key).dump() << ": ";
    write_value(key, value, inner);
    separator = ",\n";
  }
  out << "\n" << margin << "}";
}

/// The rows of a table as a list of maps, the columns as their keys.
void write_rows(std::ostream& out, const Table& table, const std::string& margin) {
  std::vector<std::string> keys;
  for (const Column& column : table.columns)
    keys.push_back(margin + std::string(2 * std::size_t{indent}, ' ') + Json(column.name).dump() + ": ");
  const std::string inner = margin + std::string(indent, ' ');
  if (table.size() == 0) {
    out << "[]";
    return;
  }
  for (std::size_t row = 0; row < table.size(); ++row) {
    out << (row == 0 ? "[\n" : ",\n") << inner;
    const char* separator = "{\n";
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::string cell = json_cell(table.columns[i], row);
      if (cell.empty()) continue;
      out << separator << keys[i] << cell;
      separator = ",\n";
    }
    out << "\n" << inner << "}";
  }
  out << "\n" << margin << "]";
}

void write_result(std::ostream& out, const RunResult& result, const std::string& margin) {
  const Json json = Json::parse(result.result);
  if (!json.is_object() || json.empty()) {
    out << indented(json, margin);
    return;
  }
  write_members(out, json, margin, [&](const std::string& key, const Json& value, const std::string& inner) {
    const auto table = std::ranges::find(result.tables, key, &Table::key);
    if (table == result.tables.end())
      out << indented(value, inner);
    else
      write_rows(out, *table, inner);
  });
}

std::string csv_value(const Column& column, std::size_t row) {
  if (column.kind == CellKind::text) return csv_field(column.text(row));
  return csv_field(column.numbers[row]);
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n#") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::string csv_field(double value) { return std::isfinite(value) ? core::format_number(value) : std::string(); }

Writer json_document(std::shared_ptr<const Scenario> scenario, std::shared_ptr<const RunResult> result,
                     std::vector<OutputFile> tables) {
  return
      [scenario = std::move(scenario), result = std::move(result), tables = std::move(tables)](std::ostream& out) {
        Json json = frame(result->status);
        json["provenance"] = provenance_json(result->provenance);
        if (!scenario->written_units.empty()) json["provenance"]["written_units"] = scenario->written_units;
        for (const OutputFile& table : tables)
          if (table.sha256 && !table.sha256->empty()) json["provenance"]["tables"][table.name] = *table.sha256;
        json["scenario"] = Json::parse(scenario->resolved);
        json["analysis"] = scenario->analysis_name;
        if (scenario->model.oscillator.coordinate == core::Coordinate::angle)
          json["units"] = units_json(scenario->result_fields);
        json["warnings"] = result->warnings;
        json["checks"] = checks_json(result->checks);
        if (result->verification) json["verification"] = json_of(*result->verification);
        if (!result->failure.empty()) json["errors"].push_back({{"message", result->failure}});
        write_members(out, json, "", [&](const std::string& key, const Json& value, const std::string& margin) {
          if (key == "result")
            write_result(out, *result, margin);
          else
            out << indented(value, margin);
        });
        out << "\n";
      };
}

Writer json_refusal(core::ExitStatus status, const std::vector<core::Diagnostic>& errors) {
  Json json = frame(status);
  for (const core::Diagnostic& error : errors) json["errors"].push_back(diagnostic_json(error));
  return document_writer(json);
}

Writer json_checked(const Scenario& scenario) {
  Json json = frame(core::ExitStatus::done);
  json["scenario"] = Json::parse(scenario.resolved);
  json["analysis"] = scenario.analysis_name;
  return document_writer(json);
}

void write_csv(std::ostream& out, const Table& table, const core::Provenance& provenance) {
  for (const auto& [name, value] : core::lines(provenance)) {
    std::string line = value;
    for (char& c : line)
      if (c == '\n' || c == '\r') c = ' ';  // a file name may hold one
    out << "# " << name << ": " << line << "\n";
  }
  const auto add_row = [&](auto field) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) out << (i == 0 ? "" : ",") << field(table.columns[i]);
    out << '\n';
  };
  add_row([](const Column& column) {
    return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
  });
  for (std::size_t row = 0; row < table.size(); ++row)
    add_row([row](const Column& column) { return csv_value(column, row); });
}

std::vector<OutputFile> output_files(std::shared_ptr<const Scenario> scenario,
                                     std::shared_ptr<const RunResult> result) {
  std::vector<OutputFile> files;
  for (const Table& table : result->tables)
    if (table.is_file)
      files.push_back({table.name + ".csv",
                       [result, &table](std::ostream& out) { write_csv(out, table, result->provenance); },
                       std::make_shared<std::string>()});
  for (const TextFile& file : result->files) files.push_back({file.name, text_writer(sealed(file.text))});
  // Last: if result.json exists, the tables are complete.
  files.push_back({"result.json", json_document(std::move(scenario), std::move(result), files)});
  return files;
}

}  // namespace dualdamp::scenarios
