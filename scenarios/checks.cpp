#include "scenarios/checks.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/numbers.hpp"
#include "identify/derived_records.hpp"
#include "identify/methods.hpp"
#include "scenarios/format.hpp"
#include "scenarios/formulas.hpp"
#include "scenarios/result_fields.hpp"

namespace dualdamp::scenarios {

namespace {

namespace fs = std::filesystem;

constexpr double two_pi = 2.0 * std::numbers::pi;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// What is filled in later stands where a file has it.
void put_in_order(Json& values, const Section& section) {
  Json sorted = Json::object();
  for (const auto& [key, value] : values.items())
    if (section.find(key) == nullptr) sorted[key] = value;  // the key that tells which section it is
  for (const Field& field : section.fields)
    if (values.contains(field.name)) sorted[field.name] = values.at(field.name);
  values = std::move(sorted);
}

class Checker {
 public:
  Checker(const Document& document, Reading& reading, const CheckOptions& options)
      : document_(document), reading_(reading), values_(reading.values), options_(options) {}

  std::optional<identify::MeasuredRecord> run() {
    analysis_ = text_at("analysis", "type");
    if (!stands_in_file("analysis", "data")) check_constants();
    if (analysis_.empty()) return std::nullopt;
    needs_ = find_needs();
    if (needs_ != nullptr) {
      check_sections();
      check_excitation();
    }
    resolve_damping();
    resolve_frequency();
    if (analysis_ == "simulate") check_work();
    if (analysis_ == "regime_map") check_map();
    std::optional<identify::MeasuredRecord> data = read_data();
    if (analysis_ == "identify") resolve_methods(data);
    check_expectations();
    return data;
  }

 private:
  void complain(Place place, std::string message, std::string allowed = {}, std::string found = {},
                std::string suggestion = {}) {
    reading_.complain(document_, place, std::move(message), std::move(allowed), std::move(found),
                      std::move(suggestion));
  }

  /// Of the value at `path`, or of what contains it.
  [[nodiscard]] Place place_of(std::string path) const {
    while (true) {
      const auto found = reading_.places.find(path);
      if (found != reading_.places.end()) return found->second;
      const std::size_t cut = path.find_last_of(".[");
      if (cut == std::string::npos) return document_.root().place;
      path.resize(cut);
    }
  }

  [[nodiscard]] const Node* node(std::string_view section) const {
    const Entry* entry = document_.root().find(section);
    return entry == nullptr ? nullptr : &entry->value;
  }

  /// The file has the key, whether or not its value could be read.
  [[nodiscard]] bool stands_in_file(std::string_view section, std::string_view key) const {
    const Node* parent = node(section);
    return parent != nullptr && parent->find(key) != nullptr;
  }

  [[nodiscard]] bool has(const std::string& section, const std::string& key) const {
    return values_.contains(section) && values_.at(section).is_object() && values_.at(section).contains(key);
  }
  [[nodiscard]] std::string text_at(const std::string& section, const std::string& key) const {
    return has(section, key) ? values_.at(section).at(key).get<std::string>() : std::string();
  }
  [[nodiscard]] std::optional<double> number_at(const std::string& section, const std::string& key) const {
    if (!has(section, key)) return std::nullopt;
    return number(values_.at(section).at(key));
  }

  /// nullptr when the file is too faulty to know.
  [[nodiscard]] const Needs* find_needs() const {
    std::string measurement;
    if (analysis_ == "identify") {
      if (stands_in_file("analysis", "data"))
        measurement = "data";
      else if (has("analysis", "measurement"))
        measurement = values_.at("analysis").at("measurement").at("type").get<std::string>();
    }
    const auto row = std::ranges::find_if(needs(), [&](const Needs& candidate) {
      return candidate.analysis == analysis_ && candidate.measurement == measurement;
    });
    return row == needs().end() ? nullptr : &*row;
  }

  /// "analysis 'identify' with a measurement 'xy_curve'"
  [[nodiscard]] std::string subject() const {
    std::string name = "analysis '" + analysis_ + "'";
    if (needs_->measurement.empty()) return name;
    return name +
           (needs_->measurement == "data" ? " with data" : " with a measurement '" + needs_->measurement + "'");
  }

  void check_sections() {
    if (needs_->excitations.empty()) {
      for (const char* section : {"system", "excitation", "initial", "numerics"})
        if (const Entry* entry = document_.root().find(section))
          complain(entry->place, subject() + " has no use for '" + section + "'");
      return;
    }
    if (node("system") == nullptr) {
      complain(place_of("analysis.type"), "'system' is missing: " + subject() + " needs it");
    } else if (needs_->whole_system && !stands_in_file("system", "damping") &&
               !stands_in_file("system", "damping_ratio")) {
      complain(node("system")->head(), "'system' needs one of damping, damping_ratio", "damping, damping_ratio");
    }
  }

  /// Only measured data do without them.
  void check_constants() {
    if (node("system") == nullptr) return;
    const Section& section = scenario_format().find("system")->choice->variants.front().section;
    for (const char* key : {"mass", "stiffness"})
      if (!stands_in_file("system", key))
        complain(node("system")->head(), "'system." + std::string(key) + "' is missing",
                 describe_values(*section.find(key)));
    if (number_at("system", "stiffness") == 0.0)
      complain(place_of("system.stiffness"), "'system.stiffness' is out of range: a motion needs a spring",
               "> 0 N/m", "0 N/m");
  }

  void check_excitation() {
    if (needs_->excitations.empty()) return;
    const Node* given = node("excitation");
    const std::string type = given == nullptr ? "none" : text_at("excitation", "type");
    if (type.empty()) return;
    if (!contains(needs_->excitations, type)) {
      complain(given == nullptr ? place_of("analysis.type") : place_of("excitation.type"),
               subject() + " does not work with " +
                   (given == nullptr ? "no excitation" : "excitation type '" + type + "'") + ": " + needs_->reason,
               joined(needs_->excitations));
      return;
    }
    const Section& section = excitations().find(type)->section;
    for (const std::string& key : needs_->drive)
      if (const Field* field = section.find(key); field != nullptr && !stands_in_file("excitation", key))
        complain(given->head(), "'excitation." + key + "' is missing: " + subject() + " needs it",
                 describe_values(*field));
  }

  /// A damping ratio becomes a damping; both are needed for a damped frequency.
  void resolve_damping() {
    const auto m = number_at("system", "mass");
    const auto k = number_at("system", "stiffness");
    const auto ratio = number_at("system", "damping_ratio");
    if (!m || !k || !ratio) return;
    Json& system = values_["system"];
    system.erase("damping_ratio");
    system["damping"] = *ratio * 2.0 * std::sqrt(*m * *k);
    put_in_order(system, scenario_format().find("system")->choice->variants.front().section);
  }

  void resolve_frequency() {
    if (!has("excitation", "frequency")) return;
    Json& frequency = values_["excitation"]["frequency"];
    const auto m = number_at("system", "mass");
    const auto k = number_at("system", "stiffness");
    const auto word = frequency.get<std::string>();
    if (word != "natural" && word != "damped") return;
    for (const char* key : {"mass", "stiffness"})
      if (!stands_in_file("system", key) && !needs_->whole_system)
        complain(place_of("excitation.frequency"), "a " + word + " frequency needs the system's " + key,
                 "a frequency");
    if (!m || !k) return;
    const double natural = std::sqrt(*k / *m);
    double value = natural;
    if (word == "damped") {
      const auto c = number_at("system", "damping");
      if (!c) {
        if (!stands_in_file("system", "damping") && !stands_in_file("system", "damping_ratio"))
          complain(place_of("excitation.frequency"), "a damped frequency needs the system's damping",
                   "natural, or a frequency");
        return;
      }
      const double zeta = *c / (2.0 * std::sqrt(*m * *k));
      if (std::abs(zeta) >= 1.0) {
        complain(place_of("excitation.frequency"), "there is no damped frequency: the damping ratio is not below 1",
                 "natural, or a frequency", "damping ratio " + core::format_number(zeta, 6));
        return;
      }
      value = natural * std::sqrt((1.0 - zeta) * (1.0 + zeta));
    }
    frequency = core::format_number(value) + " rad/s";
  }

  void check_work() {
    const auto m = number_at("system", "mass");
    const auto k = number_at("system", "stiffness");
    const auto cycles = number_at("analysis", "cycles");
    // Still a word when it could not be resolved, and then complained about.
    const bool driven = has("excitation", "frequency") && text_at("excitation", "frequency").ends_with("rad/s");
    if (cycles && !driven) {
      if (!stands_in_file("excitation", "frequency"))
        complain(place_of("analysis.cycles"), "'analysis.cycles' needs a harmonic excitation",
                 "'duration' instead");
      return;
    }
    const double frequency = driven ? *number_at("excitation", "frequency") : 0.0;
    const auto duration = cycles ? std::optional(*cycles * two_pi / frequency) : number_at("analysis", "duration");
    if (!duration) return;
    const double fastest = std::max(frequency, m && k ? std::sqrt(*k / *m) : 0.0);
    if (*duration * fastest / two_pi > max_cycles)
      complain(place_of(cycles ? "analysis.cycles" : "analysis.duration"), "the simulation is too long",
               "at most " + core::format_number(max_cycles, 6) + " forcing or natural periods",
               core::format_number(*duration * fastest / two_pi, 6) + " periods");
    check_noise(*duration);
    const double rows = *duration * number_at("analysis", "sample_rate").value_or(0.0);
    if (rows > max_samples)
      complain(place_of("analysis.sample_rate"), "the history has too many rows",
               "at most " + core::format_number(max_samples, 6), core::format_number(rows, 6));
  }

  void check_noise(double duration) {
    const double nodes = duration * number_at("excitation", "bandwidth").value_or(0.0) / std::numbers::pi;
    if (nodes > max_nodes)
      complain(place_of("excitation.bandwidth"), "the noise is too long",
               "at most " + core::format_number(max_nodes, 8) + " random values, 2 bandwidth a second",
               core::format_number(nodes, 6) + " of them");
  }

  /// Number of points of a curve or map; nothing when the file is too faulty to know.
  [[nodiscard]] std::optional<std::size_t> points() const {
    std::optional<std::size_t> count;
    for (const char* key : {"amplitudes", "frequencies"}) {
      if (has("analysis", key))
        count = count.value_or(1) * grid_size(values_.at("analysis").at(key));
      else if (stands_in_file("analysis", key))
        return std::nullopt;
    }
    return count;
  }

  void check_map() {
    const auto count = points();
    if (count && static_cast<double>(*count) > max_points)
      complain(place_of("analysis.type"), "the map has too many points",
               "at most " + core::format_number(max_points, 6) + " frequencies times amplitudes",
               std::to_string(*count));
  }

  /// The path of a data file, unless it leads out of the scenario's directory.
  std::optional<fs::path> safe_path(const std::string& name) {
    fs::path path(name);
    const std::string allowed = "a relative path inside the scenario's directory";
    const Place place = place_of("analysis.data");
    if (options_.data_anywhere) return path;
    if (name.empty() || path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end()) {
      complain(place, "'analysis.data' must stay inside the scenario's directory", allowed, name);
      return std::nullopt;
    }
    std::error_code error;
    const fs::path root = fs::canonical(options_.directory.empty() ? "." : options_.directory, error);
    fs::path target = fs::canonical(root / path, error);
    if (error) {
      complain(place, "'analysis.data': " + name + " cannot be opened: " + error.message(), allowed);
      return std::nullopt;
    }
    if (std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end()) {
      complain(place, "'analysis.data' leads out of the scenario's directory through a link", allowed,
               target.string());
      return std::nullopt;
    }
    if (!fs::is_regular_file(target, error)) {
      complain(place, "'analysis.data': " + name + " is not a file", allowed);
      return std::nullopt;
    }
    return target;
  }

  /// What the scenario says of columns that the file does not say.
  [[nodiscard]] identify::ReadOptions read_options(const std::string& name) const {
    identify::ReadOptions options;
    options.name = name;
    for (const auto& [key, map] : {std::pair{"units", &options.units}, {"columns", &options.columns}})
      if (has("analysis", key))
        for (const auto& [column, text] : values_.at("analysis").at(key).items())
          map->emplace(column, text.get<std::string>());
    return options;
  }

  std::optional<identify::MeasuredRecord> read_data() {
    if (!has("analysis", "data")) {
      for (const char* key : {"units", "columns"})
        if (stands_in_file("analysis", key))
          complain(place_of(std::string("analysis.") + key),
                   std::string("'analysis.") + key + "' says how to read a data file, and there is none");
      return std::nullopt;
    }
    const std::string name = text_at("analysis", "data");
    const auto path = safe_path(name);
    if (!path) return std::nullopt;
    try {
      identify::MeasuredRecord data = identify::read_record(path->string(), read_options(name));
      // A frequency that could not be resolved is still a word, and complained about elsewhere.
      const bool known = text_at("excitation", "frequency").ends_with("rad/s");
      const double frequency = known ? *number_at("excitation", "frequency") : identify::unknown;
      for (std::string& warning : identify::complete(data.record, frequency))
        data.warnings.push_back(std::move(warning));
      return data;
    } catch (const core::InputError& error) {
      reading_.problems.insert(reading_.problems.end(), error.diagnostics().begin(), error.diagnostics().end());
      return std::nullopt;
    }
  }

  void resolve_methods(const std::optional<identify::MeasuredRecord>& data) {
    const bool synthetic = needs_ != nullptr && needs_->measurement != "data";
    if (needs_ == nullptr || (!synthetic && !data)) return;
    const identify::Record record = synthetic ? outline() : data->record;
    std::vector<std::string> fitting;
    for (const identify::MethodEntry& method : identify::methods())
      if (method.lacks(record).empty()) fitting.emplace_back(method.name);

    Json& analysis = values_["analysis"];
    if (!stands_in_file("analysis", "methods")) {
      analysis["methods"] = fitting;
      put_in_order(analysis, analyses().find(analysis_)->section);
    } else if (analysis.contains("methods")) {
      for (std::size_t i = 0; i < analysis["methods"].size(); ++i) {
        const auto name = analysis["methods"][i].get<std::string>();
        if (const std::string lack = identify::find_method(name)->lacks(record); !lack.empty())
          complain(place_of("analysis.methods[" + std::to_string(i) + "]"),
                   "method '" + name + "' cannot be used: " + lack, joined(fitting));
      }
    }
    const bool is_free = node("excitation") == nullptr || text_at("excitation", "type") == "none";
    const bool pairs = record.pairs.has_value();
    if (pairs && is_free &&
        std::ranges::any_of(record.pairs->pairs, [](const identify::Pair& pair) { return std::isnan(pair.omega); }))
      complain(place_of("analysis.data"), "x-Y pairs need the forcing frequency at which they were measured",
               "excitation: {type: base_harmonic, frequency: ...}; on the command line --frequency");
    check_pairs(pairs ? record.pairs->pairs.size() : 0);
  }

  /// A record of the kind that the measurement will give: enough to tell which methods it allows.
  [[nodiscard]] identify::Record outline() const {
    const Json& measurement = values_.at("analysis").at("measurement");
    identify::Record record;
    if (measurement.contains("amplitudes"))
      record.pairs.emplace().pairs.resize(grid_size(measurement.at("amplitudes")));
    else
      record.decay = identify::DecayRecord{{1.0}, {0.0}};
    return record;
  }

  void check_pairs(std::size_t count) {
    if (!has("analysis", "pairs")) return;
    const Json& pairs = values_.at("analysis").at("pairs");
    if (pairs[0] == pairs[1])
      complain(place_of("analysis.pairs"), "'analysis.pairs' names one pair twice", "two pairs");
    for (std::size_t i = 0; i < 2 && count > 0; ++i)
      if (pairs[i].get<std::size_t>() > count)
        complain(place_of("analysis.pairs[" + std::to_string(i) + "]"), "there is no such pair",
                 "1 to " + std::to_string(count), pairs[i].dump());
  }

  void check_expectations() {
    if (!values_.contains("expect")) return;
    std::string formula;
    if (has("analysis", "formula")) formula = values_.at("analysis").at("formula").at("name").get<std::string>();
    std::vector<std::string> patterns;
    for (const ResultField& field : result_fields(analysis_, formula)) patterns.push_back(field.path);
    for (std::size_t i = 0; i < values_.at("expect").size(); ++i) {
      const Json& expectation = values_.at("expect").at(i);
      if (!expectation.contains("value") || patterns.empty()) continue;
      const Place place = place_of("expect[" + std::to_string(i) + "].value");
      const auto text = expectation.at("value").get<std::string>();
      const auto path = parse_result_path(text);
      if (!path || !contains(patterns, path->pattern)) {
        complain(place, "the result of analysis '" + analysis_ + "' has no number '" + text + "'", joined(patterns),
                 {}, nearest(path ? path->pattern : text, patterns));
      } else {
        check_index(place, *path);
      }
    }
  }

  /// Indices whose bound is known before the run.
  void check_index(Place place, const ResultPath& path) {
    std::optional<std::size_t> count;
    if (path.pattern.starts_with("points[]")) count = points();
    if (path.pattern.starts_with("boundary[]") && has("analysis", "frequencies"))
      count = grid_size(values_.at("analysis").at("frequencies"));
    if (path.pattern.starts_with("estimates[]") && has("analysis", "methods"))
      count = values_.at("analysis").at("methods").size();
    if (count && path.indices.front() >= *count)
      complain(place, "there is no such item in the result", "an index below " + std::to_string(*count),
               std::to_string(path.indices.front()));
  }

  const Document& document_;
  Reading& reading_;
  Json& values_;
  const CheckOptions& options_;
  std::string analysis_;
  const Needs* needs_ = nullptr;
};

}  // namespace

std::optional<identify::MeasuredRecord> check(const Document& document, Reading& reading,
                                              const CheckOptions& options) {
  return Checker(document, reading, options).run();
}

std::optional<ResultPath> parse_result_path(const std::string& text) {
  ResultPath path;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '[') {
      path.pattern += text[at];
      continue;
    }
    const std::size_t end = text.find(']', at);
    const std::string digits = text.substr(at + 1, end == std::string::npos ? 0 : end - at - 1);
    constexpr std::size_t longest = 9;
    const bool is_index = !digits.empty() && digits.size() <= longest &&
                          std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!is_index) return std::nullopt;
    path.indices.push_back(std::stoul(digits));
    path.pattern += "[]";
    at = end;
  }
  return path;
}

std::size_t grid_size(const Json& grid) {
  return grid.is_array() ? grid.size() : grid.at("count").get<std::size_t>();
}

}  // namespace dualdamp::scenarios
