#include <algorithm>
#include <cmath>
#include <filesystem>

#include "identify/methods.hpp"
#include "identify/records/derived_records.hpp"
#include "scenarios/checks_of_analyses.hpp"

namespace dualdamp::scenarios {

namespace {

namespace fs = std::filesystem;

/// The path of a data file, unless it leads out of the scenario's directory.
std::optional<fs::path> safe_path(CheckedFile& file, const CheckOptions& options, const std::string& name) {
  fs::path path(name);
  const std::string allowed = "a relative path inside the scenario's directory";
  const Place place = file.place_of("analysis.data");
  if (options.data_anywhere) return path;
  if (name.empty() || path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end()) {
    file.complain(place, "'analysis.data' must stay inside the scenario's directory", allowed, name);
    return std::nullopt;
  }
  std::error_code error;
  const fs::path root = fs::canonical(options.directory.empty() ? "." : options.directory, error);
  fs::path target = fs::canonical(root / path, error);
  if (error) {
    file.complain(place, "'analysis.data': " + name + " cannot be opened: " + error.message(), allowed);
    return std::nullopt;
  }
  if (std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end()) {
    file.complain(place, "'analysis.data' leads out of the scenario's directory through a link", allowed,
                  target.string());
    return std::nullopt;
  }
  if (!fs::is_regular_file(target, error)) {
    file.complain(place, "'analysis.data': " + name + " is not a file", allowed);
    return std::nullopt;
  }
  return target;
}

/// What the scenario says of columns that the file does not say.
identify::ReadOptions read_options(const CheckedFile& file, const std::string& name) {
  identify::ReadOptions options;
  options.name = name;
  for (const auto& [key, map] : {std::pair{"units", &options.units}, {"columns", &options.columns}})
    if (file.has("analysis", key))
      for (const auto& [column, text] : file.values().at("analysis").at(key).items())
        map->emplace(column, text.get<std::string>());
  return options;
}

void check_pairs(CheckedFile& file, std::size_t count) {
  if (!file.has("analysis", "pairs")) return;
  const Json& pairs = file.values().at("analysis").at("pairs");
  if (pairs[0] == pairs[1]) file.complain("analysis.pairs", "'analysis.pairs' names one pair twice", "two pairs");
  for (std::size_t i = 0; i < 2 && count > 0; ++i)
    if (pairs[i].get<std::size_t>() > count)
      file.complain("analysis.pairs[" + std::to_string(i) + "]", "there is no such pair",
                    "1 to " + std::to_string(count), pairs[i].dump());
}

}  // namespace

std::optional<identify::MeasuredRecord> read_data(CheckedFile& file, const CheckOptions& options) {
  if (!file.has("analysis", "data")) {
    for (const char* key : {"units", "columns"})
      if (file.stands_in_file("analysis", key))
        file.complain(std::string("analysis.") + key,
                      std::string("'analysis.") + key + "' says how to read a data file, and there is none");
    return std::nullopt;
  }
  const std::string name = file.text_at("analysis", "data");
  const auto path = safe_path(file, options, name);
  if (!path) return std::nullopt;
  try {
    identify::MeasuredRecord data = identify::read_record(path->string(), read_options(file, name));
    // A frequency that could not be resolved is still a word, and complained about elsewhere.
    const bool known = file.text_at("excitation", "frequency").ends_with("rad/s");
    const double frequency = known ? *file.number_at("excitation", "frequency") : identify::unknown;
    for (std::string& warning : identify::complete(data.record, frequency))
      data.warnings.push_back(std::move(warning));
    return data;
  } catch (const core::InputError& error) {
    file.take_over(error.diagnostics());
    return std::nullopt;
  }
}

void resolve_methods_for(CheckedFile& file, const std::vector<identify::Record>& records) {
  const auto lack_of = [&](const identify::MethodEntry& method) {
    for (const identify::Record& record : records)
      if (std::string lack = method.lacks(record); !lack.empty()) return lack;
    return std::string();
  };
  std::vector<std::string> fitting;
  for (const identify::MethodEntry& method : identify::methods())
    if (lack_of(method).empty()) fitting.emplace_back(method.name);

  Json& analysis = file.values()["analysis"];
  if (!file.stands_in_file("analysis", "methods")) {
    analysis["methods"] = fitting;
    put_in_order(analysis, analyses().find(file.analysis())->section);
  } else if (analysis.contains("methods")) {
    for (std::size_t i = 0; i < analysis["methods"].size(); ++i) {
      const auto name = analysis["methods"][i].get<std::string>();
      if (const std::string lack = lack_of(*identify::find_method(name)); !lack.empty())
        file.complain("analysis.methods[" + std::to_string(i) + "]",
                      "method '" + name + "' cannot be used: " + lack, joined(fitting));
    }
  }
}

void resolve_methods(CheckedFile& file, const std::optional<identify::MeasuredRecord>& data) {
  const bool synthetic = file.needs() != nullptr && file.needs()->measurement != "data";
  if (file.needs() == nullptr || (!synthetic && !data)) return;
  const identify::Record record = synthetic ? outline(file) : data->record;
  resolve_methods_for(file, {record});
  const bool is_free = file.node("excitation") == nullptr || file.text_at("excitation", "type") == "none";
  const bool pairs = record.pairs.has_value();
  if (pairs && is_free &&
      std::ranges::any_of(record.pairs->pairs, [](const identify::Pair& pair) { return std::isnan(pair.omega); }))
    file.complain("analysis.data", "x-Y pairs need the forcing frequency at which they were measured",
                  "excitation: {type: base_harmonic, frequency: ...}; on the command line --frequency");
  check_pairs(file, pairs ? record.pairs->pairs.size() : 0);
}

}  // namespace dualdamp::scenarios
