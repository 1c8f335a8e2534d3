#include <algorithm>
#include <numbers>

#include "core/numbers.hpp"
#include "scenarios/checks_of_analyses.hpp"
#include "scenarios/formulas.hpp"
#include "sim/rigs/rigs.hpp"

namespace dualdamp::scenarios {

namespace {

/// Beyond its largest severity a departure has no meaning.
void check_severities(CheckedFile& file, const Json& analysis) {
  const Json& grid = analysis.at("severities");
  double most = 0.0;
  for (const Json& value : grid.is_array() ? grid : Json::array({grid.at("from"), grid.at("to")}))
    most = std::max(most, number(value));
  for (const Json& name : analysis.at("laws")) {
    const sim::Departure& law = *sim::find_departure(name.get<std::string>());
    if (most > law.largest)
      file.complain("analysis.severities", "'" + std::string(law.name) + "' has no such severity",
                    "at most " + core::format_number(law.largest, 3) + ": " + std::string(law.severity),
                    core::format_number(most, 6));
  }
}

void check_names(CheckedFile& file, const std::string& key) {
  if (!file.has("analysis", key)) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < file.values().at("analysis").at(key).size(); ++i) {
    const Json& item = file.values().at("analysis").at(key).at(i);
    if (!item.contains("name")) continue;
    names.push_back(item.at("name").get<std::string>());
    if (std::ranges::count(names, names.back()) > 1)
      file.complain("analysis." + key + "[" + std::to_string(i) + "].name",
                    "there are two " + key + " with this name", "distinct names", names.back());
  }
}

/// Number of steady states of a range.
std::size_t states_of(const Json& range) {
  return grid_size(range.at("amplitudes")) *
         (range.contains("frequencies") ? grid_size(range.at("frequencies")) : 1);
}

/// A record of the kind that each range gives with each set of sensors.
std::vector<identify::Record> outlines(const Json& analysis) {
  std::vector<identify::Record> records;
  const Json sets = analysis.value("sensors", Json::array({Json::object()}));
  for (const Json& range : analysis.at("ranges")) {
    if (!range.contains("amplitudes")) continue;
    for (const Json& sensors : sets) {
      identify::Record& record = records.emplace_back();
      std::vector<identify::Pair>& pairs = record.pairs.emplace().pairs;
      const std::size_t amplitudes = grid_size(range.at("amplitudes"));
      for (std::size_t i = 0; i < states_of(range); ++i) {
        const std::size_t frequency = 1 + i / amplitudes;
        pairs.push_back({.Y = 1.0,
                         .x = 1.0,
                         .omega = static_cast<double>(frequency),
                         .phase = 0.0,
                         .fundamental = 1.0,
                         .mean_square_speed = 1.0});
      }
      if (analysis.contains("decay")) record.decay = identify::DecayRecord{{1.0}, {0.0}};
      if (sensors.contains("sample_rate"))
        record.histories.resize(pairs.size(), {.sample_rate = 1.0, .y = {0.0}, .x = {0.0}, .v = {0.0}, .a = {0.0}});
    }
  }
  return records;
}

/// Histories of one motion are in memory together.
void check_samples(CheckedFile& file, const Json& analysis) {
  if (!analysis.contains("sensors")) return;
  double most = 0.0;
  for (const Json& range : analysis.at("ranges"))
    if (range.contains("amplitudes")) most = std::max(most, static_cast<double>(states_of(range)));
  const double period = 2.0 * std::numbers::pi / file.number_at("excitation", "frequency").value_or(1.0);
  for (const Json& set : analysis.at("sensors"))
    if (set.contains("sample_rate"))
      check_rows(file, most * number(set.at("sample_rate")) * period * set.value("average_cycles", 1));
}

}  // namespace

void check_truth(CheckedFile& file) {
  const std::string allowed = "{law: coulomb, kinetic: ...}";
  if (!file.has("system", "friction")) {
    if (file.node("system") != nullptr && !file.stands_in_file("system", "friction"))
      file.complain(file.node("system")->head(),
                    "'system.friction' is missing: " + file.subject() + " departs from it", allowed);
    return;
  }
  const Json& friction = file.values().at("system").at("friction");
  const bool plain = friction.is_object() && friction.value("law", "") == "coulomb" &&
                     friction.contains("kinetic") && friction.contains("static") &&
                     friction.at("static") == friction.at("kinetic") && friction.size() == 3;
  if (!plain)
    file.complain("system.friction", file.subject() + " departs from Coulomb friction, and from nothing else",
                  allowed);
  else if (number(friction.at("kinetic")) == 0.0)
    file.complain("system.friction.kinetic",
                  "'system.friction.kinetic' is out of range: numbers are relative to it", "> 0 N", "0 N");
  if (file.number_at("system", "damping").value_or(1.0) <= 0.0)
    file.complain("system", "'system' has no damping: numbers are relative to it", "damping > 0 N.s/m");
}

void check_stress_test(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  if (!file.has("analysis", "severities") || !file.has("analysis", "ranges")) return;
  check_truth(file);
  check_names(file, "ranges");
  check_names(file, "sensors");
  check_samples(file, analysis);
  if (!file.stands_in_file("analysis", "laws")) {
    Json all = Json::array();
    for (const sim::Departure& departure : sim::departures()) all.push_back(departure.name);
    file.values()["analysis"]["laws"] = std::move(all);
    put_in_order(file.values()["analysis"], analyses().find(file.analysis())->section);
  }
  resolve_methods_for(file, outlines(analysis));
  if (!analysis.contains("laws")) return;
  check_severities(file, analysis);
  const std::size_t motions =
      (1 + analysis.at("laws").size() * grid_size(analysis.at("severities"))) * analysis.at("ranges").size();
  const std::size_t sets = analysis.contains("sensors") ? analysis.at("sensors").size() : 1;
  const double cases = static_cast<double>(motions) * static_cast<double>(sets) * analysis.value("seeds", 1);
  if (cases > max_cases)
    file.complain("analysis.type", "the stress test has too many cases",
                  "at most " + core::format_number(max_cases, 6) +
                      ": laws times severities times ranges times sensors times seeds",
                  core::format_number(cases, 9));
}

}  // namespace dualdamp::scenarios
