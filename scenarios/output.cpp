#include "scenarios/output.hpp"

#include <cmath>

#include "core/build_info.hpp"
#include "core/numbers.hpp"
#include "scenarios/json.hpp"

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
  if (!provenance.data_sha256.empty()) json["data_sha256"] = provenance.data_sha256;
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

std::string written(const Json& json) {
  // File names on the command line need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n#") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::string csv_value(const Column& column, std::size_t row) {
  if (!column.texts.empty()) return csv_field(column.texts[row]);
  const double value = column.numbers[row];
  return std::isfinite(value) ? core::format_number(value) : "";
}

}  // namespace

std::string json_document(const Scenario& scenario, const RunResult& result) {
  Json json = frame(result.status);
  json["provenance"] = provenance_json(result.provenance);
  json["scenario"] = Json::parse(scenario.resolved);
  json["analysis"] = scenario.analysis_name;
  json["result"] = Json::parse(result.result);
  json["warnings"] = result.warnings;
  json["checks"] = checks_json(result.checks);
  if (!result.failure.empty()) json["errors"].push_back({{"message", result.failure}});
  return written(json);
}

std::string json_refusal(core::ExitStatus status, const std::vector<core::Diagnostic>& errors) {
  Json json = frame(status);
  for (const core::Diagnostic& error : errors) json["errors"].push_back(diagnostic_json(error));
  return written(json);
}

std::string json_checked(const Scenario& scenario) {
  Json json = frame(core::ExitStatus::done);
  json["scenario"] = Json::parse(scenario.resolved);
  json["analysis"] = scenario.analysis_name;
  return written(json);
}

std::string csv(const Table& table, const core::Provenance& provenance) {
  std::string text;
  for (const auto& [name, value] : core::lines(provenance)) {
    std::string line = value;
    for (char& c : line)
      if (c == '\n' || c == '\r') c = ' ';  // a file name may hold one
    text += "# " + name + ": " + line + "\n";
  }
  const auto add_row = [&](auto field) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) text += (i == 0 ? "" : ",") + field(table.columns[i]);
    text += '\n';
  };
  add_row([](const Column& column) {
    return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
  });
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().size();
  for (std::size_t row = 0; row < rows; ++row)
    add_row([row](const Column& column) { return csv_value(column, row); });
  return text;
}

std::vector<OutputFile> output_files(const Scenario& scenario, const RunResult& result) {
  std::vector<OutputFile> files;
  for (const Table& table : result.tables) files.push_back({table.name + ".csv", csv(table, result.provenance)});
  // Last: where result.json is, the tables are complete.
  files.push_back({"result.json", json_document(scenario, result)});
  return files;
}

}  // namespace dualdamp::scenarios
