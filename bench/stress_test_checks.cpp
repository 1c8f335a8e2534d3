#include "bench/stress_test_checks.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "bench/departure_names.hpp"
#include "bench/random_response.hpp"
#include "bench/truth.hpp"
#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/median.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/method_choice.hpp"
#include "scenarios/measurements/sensors.hpp"
#include "scenarios/measurements/work_checks.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::CheckedFile;
using scenarios::Json;

/// An item of `pairs`; nothing where the reader has refused a part of it.
std::optional<CaseDeparture> pair_of(const Json& item) {
  if (!item.contains("law") || !item.contains("beside")) return std::nullopt;
  return CaseDeparture{find_departure(item.at("law").get<std::string>()),
                       find_departure(item.at("beside").get<std::string>())};
}

/// Beyond its largest severity a departure has no meaning, and equal severities would be one cell twice.
void check_severities(CheckedFile& file, const Json& analysis) {
  std::vector<double> severities = scenarios::grid_values(analysis.at("severities"));
  std::ranges::sort(severities);
  if (const auto twice = std::ranges::adjacent_find(severities); twice != severities.end())
    file.complain("analysis.severities", "'analysis.severities' has a value twice", "each once",
                  core::format_number(*twice, 6));
  const double most = severities.back();
  for (const CaseDeparture& departure : departures_of(analysis)) {
    if (most > departure.largest_severity())
      file.complain("analysis.severities", "'" + departure.name() + "' has no such severity",
                    "at most " + core::format_number(departure.largest_severity(), 3) + ": " +
                        departure.meaning_of_severity(),
                    core::format_number(most, 6));
  }
}

/// The truth satisfies every assumption of the methods: otherwise the rejections without a departure would be
/// right, and would count as false alarms.
void check_assumptions(CheckedFile& file) {
  const auto refuse = [&](const std::string& path, const std::string& what, const std::string& allowed) {
    file.complain(path,
                  file.subject() + " departs from " + what + ": '" + path + "' would be a departure of its own",
                  allowed);
  };
  if (file.number_at("system", "cubic_stiffness").value_or(0.0) != 0.0)
    refuse("system.cubic_stiffness", "a linear spring", "0; the departures cubic_spring and softening_spring");
  if (file.text_at("system", "damper_to") == "base")
    refuse("system.damper_to", "a damper between mass and ground", "ground");
  if (file.has("excitation", "harmonics"))
    refuse("excitation.harmonics", "a drive of one frequency", "without it; the departure base_distortion");
}

/// Whether some range is measured more than once.
bool has_sweeps(const Json& analysis) {
  return std::ranges::any_of(analysis.at("ranges"), [](const Json& range) { return range.value("sweeps", 1) > 1; });
}

void check_sweeps(CheckedFile& file, const Json& analysis) {
  for (const CaseDeparture& departure : departures_of(analysis))
    if (departure.needs_sweeps() && !has_sweeps(analysis))
      file.complain("analysis.ranges", "'" + departure.name() + "' has an effect only in records of several sweeps",
                    "a range with 'sweeps' above 1");
}

/// Refuses pairs within one family, which would cancel or repeat each other, and equal pairs.
void check_pairs(CheckedFile& file, const Json& analysis) {
  const Json pairs = analysis.value("pairs", Json::array());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::string place = "analysis.pairs[" + std::to_string(i) + "]";
    const std::optional<CaseDeparture> both = pair_of(pairs.at(i));
    if (!both) continue;
    if (both->first->family == both->beside->family)
      file.complain(place + ".beside", "both departures lie in one family",
                    "a departure that is not of " + std::string(name_of(both->first->family)),
                    std::string(both->beside->name));
    names.push_back(both->name());
    if (std::ranges::count(names, names.back()) > 1)
      file.complain(place + ".law", "there are two pairs of these departures", "distinct pairs", names.back());
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

/// Smallest F0/k of the rigs [m]: the input amplitude up to which all of them stick. Nothing where it is not known
/// or more than F0 and k decides.
std::optional<double> least_moving_amplitude(const CheckedFile& file, const Json& analysis) {
  const Json& system = file.values().at("system");
  const std::optional<double> k = file.number_at("system", "stiffness");
  if (!k || !file.has("system", "friction") || file.number_at("system", "cubic_stiffness").value_or(0.0) != 0.0 ||
      (file.has("system", "damper_to") && file.text_at("system", "damper_to") != "ground") ||
      file.has("excitation", "harmonics"))
    return std::nullopt;
  const Json& levels = analysis.at("ranges").at(0);
  if (analysis.contains("rigs") && analysis.at("rigs").contains("friction_ratio")) {
    const Json& ratio = analysis.at("rigs").at("friction_ratio");
    if (!levels.contains("amplitudes") || !ratio.contains("from") || !ratio.contains("to")) return std::nullopt;
    return identify::upper_median(scenarios::grid_values(levels.at("amplitudes"))) *
           std::min(scenarios::number(ratio.at("from")), scenarios::number(ratio.at("to")));
  }
  const Json& friction = system.at("friction");
  if (!friction.is_object() || !friction.contains("kinetic")) return std::nullopt;
  return scenarios::number(friction.at("kinetic")) / *k;
}

/// Refuses a range in which every rig sticks at every level: it has no motion that severities could refer to.
void check_motion(CheckedFile& file, const Json& analysis) {
  const std::optional<double> limit = least_moving_amplitude(file, analysis);
  if (!limit) return;
  for (std::size_t i = 0; i < analysis.at("ranges").size(); ++i) {
    const Json& range = analysis.at("ranges").at(i);
    if (!range.contains("amplitudes") || !range.contains("name")) continue;
    const double most = std::ranges::max(scenarios::grid_values(range.at("amplitudes")));
    if (most > *limit) continue;
    constexpr int digits = 3;
    const std::string unit = " " + core::unit_for(file.coordinate(), "m");
    file.complain("analysis.ranges[" + std::to_string(i) + "].amplitudes",
                  "the mass sticks at every level of the range '" + range.at("name").get<std::string>() +
                      "': F0/(kY) is " + core::format_number(*limit / most, digits) + " at the largest Y",
                  "an amplitude above F0/k = " + core::format_number(*limit, digits) + unit,
                  core::format_number(most, digits) + unit);
  }
}

/// Number of steady states of a range.
std::size_t states_of(const Json& range) {
  return scenarios::grid_size(range.at("amplitudes")) *
         (range.contains("frequencies") ? scenarios::grid_size(range.at("frequencies")) : 1) *
         static_cast<std::size_t>(range.value("sweeps", 1));
}

/// A record of the kind that each range gives with each set of sensors.
std::vector<identify::Record> outlines(const CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  std::vector<identify::Record> records;
  const Json sets = analysis.value("sensors", Json::array({Json::object()}));
  for (const Json& range : analysis.at("ranges")) {
    if (!range.contains("amplitudes")) continue;
    for (const Json& sensors : sets) {
      identify::Record& record = records.emplace_back();
      std::vector<identify::Pair>& pairs = record.pairs.emplace().pairs;
      const std::size_t amplitudes = scenarios::grid_size(range.at("amplitudes"));
      const int sweeps = range.value("sweeps", 1);
      const std::size_t in_sweep = states_of(range) / static_cast<std::size_t>(sweeps);
      for (std::size_t i = 0; i < states_of(range); ++i) {
        const std::size_t frequency = 1 + i % in_sweep / amplitudes;
        pairs.push_back({.Y = 1.0,
                         .x = 1.0,
                         .sweep = sweeps > 1 ? std::to_string(1 + i / in_sweep) : "",
                         .omega = static_cast<double>(frequency),
                         .phase = 0.0,
                         .fundamental = 1.0,
                         .mean_square_speed = 1.0});
      }
      if (analysis.contains("decay")) record.decay = identify::DecayRecord{{1.0}, {0.0}};
      // A faulty section is reported once, not also as missing.
      if (file.stands_in_file("analysis", "random_response"))
        record.histories.push_back(random_outline(analysis.value("random_response", Json::object())));
      if (sensors.contains("sample_rate"))
        record.histories.resize(pairs.size(), {.sample_rate = 1.0, .y = {0.0}, .x = {0.0}, .v = {0.0}, .a = {0.0}});
    }
  }
  return records;
}

/// Bounds the samples of one motion, whose histories are in memory together.
void check_samples(CheckedFile& file, const Json& analysis) {
  if (!analysis.contains("sensors")) return;
  double most = 0.0;
  for (const Json& range : analysis.at("ranges"))
    if (range.contains("amplitudes")) most = std::max(most, static_cast<double>(states_of(range)));
  const double period = core::two_pi / file.number_at("excitation", "frequency").value_or(1.0);
  for (std::size_t i = 0; i < analysis.at("sensors").size(); ++i) {
    const Json& set = analysis.at("sensors").at(i);
    if (set.contains("sample_rate"))
      check_rows(file, "analysis.sensors[" + std::to_string(i) + "].sample_rate",
                 most * scenarios::number(set.at("sample_rate")) * period * set.value("average_cycles", 1));
  }
}

}  // namespace

/// The departures in the order of the file: single ones, then the pairs.
std::vector<CaseDeparture> departures_of(const Json& analysis) {
  std::vector<CaseDeparture> list;
  for (const Json& name : analysis.at("laws")) list.push_back({find_departure(name.get<std::string>())});
  for (const Json& item : analysis.value("pairs", Json::array()))
    if (const std::optional<CaseDeparture> pair = pair_of(item)) list.push_back(*pair);
  return list;
}

void check_stress_test(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  if (!file.has("analysis", "severities") || !file.has("analysis", "ranges")) return;
  check_truth(file);
  check_assumptions(file);
  refuse_replaced_amplitude(file);
  check_names(file, "ranges");
  check_names(file, "sensors");
  check_samples(file, analysis);
  for (std::size_t i = 0; i < analysis.value("sensors", Json::array()).size(); ++i)
    scenarios::check_outliers(file, "analysis.sensors[" + std::to_string(i) + "]");
  check_random_response(file);
  if (!file.stands_in_file("analysis", "laws")) {
    Json all = Json::array();
    for (const Departure& departure : departures())
      if (!departure.needs_sweeps || has_sweeps(analysis)) all.push_back(departure.name);
    file.fill_in("laws", std::move(all));
  }
  resolve_methods(file, outlines(file), scenarios::SlowMethods::only_where_named);
  if (!analysis.contains("laws")) return;
  check_pairs(file, analysis);
  check_severities(file, analysis);
  check_motion(file, analysis);
  check_sweeps(file, analysis);
  const std::size_t departures = departures_of(analysis).size();
  const std::size_t motions =
      (1 + departures * scenarios::grid_size(analysis.at("severities"))) * analysis.at("ranges").size();
  const std::size_t sets = analysis.contains("sensors") ? analysis.at("sensors").size() : 1;
  constexpr double most_cases = 1e7;
  const int rigs = analysis.contains("rigs") ? analysis.at("rigs").value("count", 1) : 1;
  const double cases = static_cast<double>(motions) * static_cast<double>(sets) * analysis.value("seeds", 1) *
                       static_cast<double>(rigs);
  if (cases > most_cases)
    file.complain("analysis.type", "the stress test has too many cases",
                  "at most " + core::format_number(most_cases, 6) +
                      ": laws times severities times ranges times sensors times rigs times seeds",
                  core::format_number(cases, 9));
}

}  // namespace dualdamp::bench
