#include "scenarios/checks.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "core/numbers.hpp"
#include "identify/derived_records.hpp"
#include "identify/methods.hpp"
#include "scenarios/format.hpp"
#include "scenarios/formulas.hpp"
#include "scenarios/result_fields.hpp"
#include "sim/departures.hpp"

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
    if (analysis_ == "simulate")
      check_work(values_.at("analysis"), "analysis", number_at("analysis", "sample_rate"), 1);
    if (analysis_ == "identify") check_measurement();
    if (analysis_ == "regime_map") check_map();
    std::optional<identify::MeasuredRecord> data = read_data();
    if (analysis_ == "identify") resolve_methods(data);
    if (analysis_ == "stress_test") check_stress_test();
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
    for (const auto& [key, varied] : {std::pair{"amplitude", "amplitudes"}, {"frequency", "frequencies"}}) {
      // What a measurement varies it gives itself.
      const bool given_there = reading_.places.contains(std::string("analysis.measurement.") + varied);
      const bool wanted = contains(needs_->drive, key) || (measurement() != nullptr && !given_there);
      if (const Field* field = section.find(key); wanted && field != nullptr && !stands_in_file("excitation", key))
        complain(given->head(), std::string("'excitation.") + key + "' is missing: " + subject() + " needs it",
                 describe_values(*field));
    }
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

  /// A motion followed in time, which `section` of the file at `path` asks for.
  void check_work(const Json& section, const std::string& path, std::optional<double> rate, double tests) {
    const auto m = number_at("system", "mass");
    const auto k = number_at("system", "stiffness");
    const bool by_cycles = section.contains("cycles");
    // Still a word when it could not be resolved, and then complained about.
    const bool driven = has("excitation", "frequency") && text_at("excitation", "frequency").ends_with("rad/s");
    if (by_cycles && !driven) {
      if (!stands_in_file("excitation", "frequency"))
        complain(place_of(path + ".cycles"), "'" + path + ".cycles' needs a harmonic excitation",
                 "'duration' instead");
      return;
    }
    const double frequency = driven ? *number_at("excitation", "frequency") : 0.0;
    if (!by_cycles && !section.contains("duration")) return;
    const double recorded =
        by_cycles ? number(section.at("cycles")) * two_pi / frequency : number(section.at("duration"));
    const double duration = recorded + (section.contains("settle") ? number(section.at("settle")) : 0.0);
    const double fastest = std::max(frequency, m && k ? std::sqrt(*k / *m) : 0.0);
    if (duration * fastest / two_pi > max_cycles)
      complain(place_of(path + (by_cycles ? ".cycles" : ".duration")), "the simulation is too long",
               "at most " + core::format_number(max_cycles, 6) + " forcing or natural periods",
               core::format_number(duration * fastest / two_pi, 6) + " periods");
    check_noise(duration);
    check_rows(recorded * rate.value_or(0.0) * tests);
  }

  void check_rows(double rows) {
    if (rows > max_samples)
      complain(place_of(analysis_ == "identify" ? "analysis.sensors.sample_rate" : "analysis.sample_rate"),
               "the history has too many rows", "at most " + core::format_number(max_samples, 6),
               core::format_number(rows, 6));
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

  /// All methods that such a record allows, or those of the file, each of which it must allow.
  void resolve_methods_for(const identify::Record& record) {
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
  }

  void check_stress_test() {
    const Json& analysis = values_.at("analysis");
    if (!has("analysis", "severities") || !has("analysis", "ranges")) return;
    check_truth();
    check_names("ranges");
    check_names("sensors");
    if (!stands_in_file("analysis", "laws")) {
      Json all = Json::array();
      for (const sim::Departure& departure : sim::departures()) all.push_back(departure.name);
      values_["analysis"]["laws"] = std::move(all);
      put_in_order(values_["analysis"], analyses().find(analysis_)->section);
    }
    identify::Record record;
    record.pairs.emplace().pairs.resize(
        3, {.Y = 1.0, .x = 1.0, .omega = 1.0, .phase = 0.0, .fundamental = 1.0, .mean_square_speed = 1.0});
    if (analysis.contains("decay")) record.decay = identify::DecayRecord{{1.0}, {0.0}};
    resolve_methods_for(record);
    if (!analysis.contains("laws")) return;
    const std::size_t motions =
        (1 + analysis.at("laws").size() * grid_size(analysis.at("severities"))) * analysis.at("ranges").size();
    const std::size_t sets = analysis.contains("sensors") ? analysis.at("sensors").size() : 1;
    const double cases = static_cast<double>(motions) * static_cast<double>(sets) * analysis.value("seeds", 1);
    if (cases > max_cases)
      complain(place_of("analysis.type"), "the stress test has too many cases",
               "at most " + core::format_number(max_cases, 6) +
                   ": laws times severities times ranges times sensors times seeds",
               core::format_number(cases, 9));
  }

  /// The truth is Coulomb + viscous friction.
  void check_truth() {
    const std::string allowed = "{law: coulomb, kinetic: ...}";
    if (!has("system", "friction")) {
      if (node("system") != nullptr && !stands_in_file("system", "friction"))
        complain(node("system")->head(), "'system.friction' is missing: a stress test departs from it", allowed);
      return;
    }
    const Json& friction = values_.at("system").at("friction");
    const bool plain = friction.is_object() && friction.value("law", "") == "coulomb" &&
                       friction.contains("kinetic") && friction.contains("static") &&
                       friction.at("static") == friction.at("kinetic") && friction.size() == 3;
    if (!plain)
      complain(place_of("system.friction"), "a stress test departs from Coulomb friction, and from nothing else",
               allowed);
    else if (number(friction.at("kinetic")) == 0.0)
      complain(place_of("system.friction.kinetic"),
               "'system.friction.kinetic' is out of range: errors are relative to it", "> 0 N", "0 N");
    if (number_at("system", "damping").value_or(1.0) <= 0.0)
      complain(place_of("system"), "'system' has no damping: errors are relative to it", "damping > 0 N.s/m");
  }

  void check_names(const std::string& key) {
    if (!has("analysis", key)) return;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < values_.at("analysis").at(key).size(); ++i) {
      const Json& item = values_.at("analysis").at(key).at(i);
      if (!item.contains("name")) continue;
      names.push_back(item.at("name").get<std::string>());
      if (std::ranges::count(names, names.back()) > 1)
        complain(place_of("analysis." + key + "[" + std::to_string(i) + "].name"),
                 "there are two " + key + " with this name", "distinct names", names.back());
    }
  }

  void resolve_methods(const std::optional<identify::MeasuredRecord>& data) {
    const bool synthetic = needs_ != nullptr && needs_->measurement != "data";
    if (needs_ == nullptr || (!synthetic && !data)) return;
    const identify::Record record = synthetic ? outline() : data->record;
    resolve_methods_for(record);
    const bool is_free = node("excitation") == nullptr || text_at("excitation", "type") == "none";
    const bool pairs = record.pairs.has_value();
    if (pairs && is_free &&
        std::ranges::any_of(record.pairs->pairs, [](const identify::Pair& pair) { return std::isnan(pair.omega); }))
      complain(place_of("analysis.data"), "x-Y pairs need the forcing frequency at which they were measured",
               "excitation: {type: base_harmonic, frequency: ...}; on the command line --frequency");
    check_pairs(pairs ? record.pairs->pairs.size() : 0);
  }

  [[nodiscard]] const Json* measurement() const {
    return has("analysis", "measurement") ? &values_.at("analysis").at("measurement") : nullptr;
  }

  [[nodiscard]] std::optional<double> sensor_number(const std::string& key) const {
    if (!has("analysis", "sensors") || !values_.at("analysis").at("sensors").contains(key)) return std::nullopt;
    return number(values_.at("analysis").at("sensors").at(key));
  }

  /// 1 where the file is too faulty to know.
  [[nodiscard]] int sweeps() const {
    return measurement()->contains("sweeps") ? measurement()->at("sweeps").get<int>() : 1;
  }

  /// How many motions a synthetic measurement makes.
  [[nodiscard]] double tests() const {
    double count = sweeps();
    for (const char* key : {"amplitudes", "frequencies"})
      if (measurement()->contains(key)) count *= static_cast<double>(grid_size(measurement()->at(key)));
    return count;
  }

  void check_measurement() {
    const std::string rate_path = "analysis.sensors.sample_rate";
    if (measurement() == nullptr) {
      if (stands_in_file("analysis", "sensors") && !stands_in_file("analysis", "measurement"))
        complain(place_of("analysis.sensors"),
                 "'analysis.sensors' belongs to a synthetic measurement, and there is none");
      return;
    }
    if (tests() > max_points)
      complain(place_of("analysis.measurement"), "the measurement has too many points",
               "at most " + core::format_number(max_points, 7) + " in all sweeps", core::format_number(tests(), 7));
    check_lags();
    const auto type = measurement()->at("type").get<std::string>();
    const auto rate = sensor_number("sample_rate");
    if (type == "simulate") {
      if (!reading_.places.contains(rate_path))
        complain(place_of("analysis.measurement.type"),
                 "'" + rate_path + "' is missing: time histories are samples", "a rate such as '1 kHz'");
      check_work(*measurement(), "analysis.measurement", rate, tests());
    } else if (rate && type == "free_decay") {
      complain(place_of(rate_path), "extremes of a free vibration are read, not sampled",
               "a measurement 'simulate' without excitation");
    } else if (rate) {
      check_rows(tests() * sensor_number("average_cycles").value_or(1.0) * *rate * longest_period());
    }
  }

  /// Of the forcing in a measurement [s]; 0 where it is not known yet.
  [[nodiscard]] double longest_period() const {
    double slowest = number_at("excitation", "frequency").value_or(0.0);
    if (measurement()->contains("frequencies")) {
      const Json& grid = measurement()->at("frequencies");
      slowest = std::numeric_limits<double>::infinity();
      for (const Json& value : grid.is_array() ? grid : Json::array({grid.at("from"), grid.at("to")}))
        slowest = std::min(slowest, number(value));
    }
    return slowest > 0.0 ? two_pi / slowest : 0.0;
  }

  void check_lags() {
    if (!has("analysis", "sensors") || text_at("excitation", "type").ends_with("_harmonic")) return;
    for (const auto& [name, sensor] : values_.at("analysis").at("sensors").items())
      if (sensor.is_object() && sensor.contains("phase_lag"))
        complain(place_of("analysis.sensors." + name + ".phase_lag"),
                 "a phase lag needs a harmonic excitation: it is an angle at the forcing frequency", "a delay");
  }

  /// Two frequencies are outlined as different, no more.
  [[nodiscard]] identify::PairRecord outline_pairs() const {
    const auto count = [&](const char* key) {
      return measurement()->contains(key) ? grid_size(measurement()->at(key)) : std::size_t{1};
    };
    identify::PairRecord record;
    for (int sweep = 1; sweep <= sweeps(); ++sweep)
      for (std::size_t i = 0; i < count("frequencies"); ++i)
        record.pairs.insert(record.pairs.end(), count("amplitudes"),
                            {.Y = 1.0,
                             .x = 1.0,
                             .sweep = sweeps() > 1 ? std::to_string(sweep) : "",
                             .omega = static_cast<double>(i + 1),
                             .phase = 0.0,
                             .fundamental = 1.0,
                             .mean_square_speed = 1.0});
    return record;
  }

  [[nodiscard]] identify::History outline_history() const {
    identify::History history{.sample_rate = 1.0};
    const auto type = text_at("excitation", "type");
    if (type.starts_with("base_")) history.y = {0.0};
    if (type.starts_with("force_")) history.force = {0.0};
    history.x = {0.0};
    const auto records = [&](const char* signal) {
      if (!measurement()->contains("signals")) return true;
      const Json& signals = measurement()->at("signals");
      return std::ranges::find(signals, signal) != signals.end();
    };
    if (records("v")) history.v = {0.0};
    if (records("a")) history.a = {0.0};
    return history;
  }

  /// A record of the kind that the measurement will give: enough to tell which methods it allows.
  [[nodiscard]] identify::Record outline() const {
    identify::Record record;
    const auto type = measurement()->at("type").get<std::string>();
    if (type == "free_decay") {
      record.decay = identify::DecayRecord{{1.0}, {0.0}};
      return record;
    }
    if (sensor_number("sample_rate")) record.histories.resize(static_cast<std::size_t>(tests()), outline_history());
    if (text_at("excitation", "type") == "base_harmonic") record.pairs = outline_pairs();
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
