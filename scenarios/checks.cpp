#include "scenarios/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/record.hpp"
#include "scenarios/check_expectations.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/drives.hpp"

namespace dualdamp::scenarios {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// The analyses with this ability, for a message.
std::string names_of(const AnalysisList& analyses, bool Analysis::* ability) {
  std::vector<std::string> names;
  for (const Analysis* analysis : analyses)
    if (analysis->*ability) names.emplace_back(analysis->name);
  return core::joined(names);
}

void check_sections(CheckedFile& file) {
  if (file.needs()->excitations.empty()) {
    for (const char* section : {"system", "excitation", "initial", "numerics"})
      if (const Entry* entry = file.entry(section))
        file.complain(entry->place, file.subject() + " has no use for '" + section + "'");
    return;
  }
  if (file.node("system") == nullptr) {
    file.complain("analysis.type", "'system' is missing: " + file.subject() + " needs it");
  } else if (file.needs()->whole_system && !file.stands_in_file("system", "damping") &&
             !file.stands_in_file("system", "damping_ratio")) {
    file.complain(file.node("system")->head(), "'system' needs one of damping, damping_ratio",
                  "damping, damping_ratio");
  }
}

/// Without a spring, gravity is the whole stiffness.
void resolve_gravity(CheckedFile& file) {
  const auto gravity = file.number_at("system", "gravity_stiffness");
  if (!gravity) return;
  const std::string path = "system.gravity_stiffness";
  if (moves_base(file.text_at("excitation", "type")))
    file.complain(path, "'" + path + "' does not work with a base in motion: gravity has a direction of its own",
                  "excitation type none, or one of force");
  const auto stiffness = file.number_at("system", "stiffness");
  if (stiffness && *stiffness < *gravity)
    file.complain("system.stiffness", "'system.stiffness' is below its own part, 'system.gravity_stiffness'",
                  ">= " + core::format_number(*gravity) + " N.m/rad", core::format_number(*stiffness) + " N.m/rad");
  if (stiffness || file.stands_in_file("system", "stiffness")) return;
  Json& system = file.values()["system"];
  system["stiffness"] = *gravity;
  put_in_order(system, file.keys_of("system"));
}

/// The units of measured data may show what the coordinate is.
void check_pendulum(CheckedFile& file) {
  const std::string path = "system.gravity_stiffness";
  if (file.number_at("system", "gravity_stiffness") && file.coordinate() != core::Coordinate::angle)
    file.complain(path, "'" + path + "' is of a pendulum, and the coordinate is no angle",
                  "with coordinate: angle, or with the units of rotation");
}

/// Only analyses of measured data can do without them.
void check_constants(CheckedFile& file) {
  if (file.node("system") == nullptr) return;
  const Section& section = file.keys_of("system");
  const std::string unit = core::unit_for(file.coordinate(), "N/m");
  for (const char* key : {"mass", "stiffness"})
    if (!file.stands_in_file("system", key) && !file.has("system", key))
      file.complain(file.node("system")->head(), "'system." + std::string(key) + "' is missing",
                    describe_values(*section.find(key), file.coordinate()));
  if (file.number_at("system", "stiffness") == 0.0)
    file.complain("system.stiffness", "'system.stiffness' is out of range: a motion needs a spring", "> 0 " + unit,
                  "0 " + unit);
}

/// A resolved scenario has numbers without units, which do not show that the coordinate is an angle.
void resolve_coordinate(CheckedFile& file) {
  if (file.coordinate() != core::Coordinate::angle || !file.values().contains("system")) return;
  Json& system = file.values()["system"];
  system["coordinate"] = core::name_of(core::Coordinate::angle);
  put_in_order(system, file.keys_of("system"));
}

void check_excitation(CheckedFile& file) {
  if (file.needs()->excitations.empty()) return;
  const Node* given = file.node("excitation");
  const std::string type = given == nullptr ? "none" : file.text_at("excitation", "type");
  if (type.empty()) return;
  if (!contains(file.needs()->excitations, type)) {
    file.complain(given == nullptr ? "analysis.type" : "excitation.type",
                  file.subject() + " does not work with " +
                      (given == nullptr ? "no excitation" : "excitation type '" + type + "'") + ": " +
                      file.needs()->reason,
                  core::joined(file.needs()->excitations));
    return;
  }
  const Section& section = excitations().find(type)->section;
  for (const auto& [key, varied] : {std::pair{"amplitude", "amplitudes"}, {"frequency", "frequencies"}}) {
    // A measurement states the quantities that it varies.
    const bool given_there = file.is_given(std::string("analysis.measurement.") + varied);
    const bool wanted = contains(file.needs()->drive, key) || (file.measurement() != nullptr && !given_there);
    if (const Field* field = section.find(key);
        wanted && field != nullptr && !file.stands_in_file("excitation", key))
      file.complain(given->head(),
                    std::string("'excitation.") + key + "' is missing: " + file.subject() + " needs it",
                    describe_values(*field, file.coordinate()));
  }
}

/// A scenario may state the amplitude that a list replaces; an option or a sweep that names it would have no
/// effect.
void check_replaced(CheckedFile& file) {
  for (const auto& [key, list] : {std::pair{"amplitude", "analysis.amplitudes"},
                                  {"amplitude", "analysis.measurement.amplitudes"},
                                  {"frequency", "analysis.frequencies"},
                                  {"frequency", "analysis.measurement.frequencies"}}) {
    const std::string path = std::string("excitation.") + key;
    // The uncertainty of a frequency has an effect where lists replace its value.
    if (!file.is_given(list) || !file.is_chosen(path) || file.has("excitation", uncertainty_key(key))) continue;
    const Node* section = file.node("excitation");
    const Entry* entry = section == nullptr ? nullptr : section->find(key);
    file.complain(entry == nullptr ? file.place_of(path) : entry->place,
                  "'" + path + "' has no effect: '" + list + "' replaces it",
                  "values in '" + std::string(list) + "'");
  }
}

/// Converts a damping ratio into a damping; a damped frequency needs both.
void resolve_damping(CheckedFile& file) {
  const auto m = file.number_at("system", "mass");
  const auto k = file.number_at("system", "stiffness");
  const auto ratio = file.number_at("system", "damping_ratio");
  if (!m || !k || !ratio) return;
  Json& system = file.values()["system"];
  const double damping = *ratio * identify::critical_damping(*m, *k);
  if (!std::isfinite(damping)) return;  // mass and stiffness are refused
  system.erase("damping_ratio");
  system["damping"] = damping;
  put_in_order(system, file.keys_of("system"));
}

/// Beyond these limits squares of forces and products would overflow.
void check_mass_and_stiffness(CheckedFile& file) {
  const auto m = file.number_at("system", "mass");
  const auto k = file.number_at("system", "stiffness");
  if (!m || !k || *k == 0.0) return;
  constexpr double least = 1e-40;
  constexpr double most = 1e40;
  const auto check = [&](double value, const char* name, const std::string& allowed) {
    if (value >= least && value <= most) return;
    file.complain(
        file.stands_in_file("system", "mass") ? "system.mass" : "system",
        std::string("the ") + name + " of this mass and stiffness is out of range", allowed,
        "a mass of " + core::format_number(*m, 6) + " on a stiffness of " + core::format_number(*k, 6) + " (SI)");
  };
  check(std::sqrt(*k / *m), "natural frequency", "1e-40 rad/s to 1e40 rad/s");
  check(std::sqrt(*m) * std::sqrt(*k), "critical damping",
        "sqrt(m k) of 1e-40 to 1e40 " + core::unit_for(file.coordinate(), "N.s/m"));
}

/// Below 1e-160 m the energies of a motion vanish, and forces with squares in them are wrong. Mass, stiffness and
/// damping have ranges of their own.
void check_magnitudes(CheckedFile& file, const Json& value, const std::string& path) {
  if (path == "system.mass" || path == "system.stiffness" || path == "system.damping") return;
  if (value.is_number_float()) {
    const double size = std::abs(value.get<double>());
    if (size == 0.0 || (size >= core::least_magnitude && size <= core::most_magnitude)) return;
    file.complain(
        path, "'" + path + "' is too " + (size > core::most_magnitude ? "large" : "small") + " to compute with",
        "0, or " + std::string(core::magnitude_range) + " in SI", core::format_number(value.get<double>(), 6));
  } else if (value.is_object()) {
    for (const auto& [key, item] : value.items())
      check_magnitudes(file, item, path.empty() ? key : path + "." + key);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      check_magnitudes(file, value[i], path + "[" + std::to_string(i) + "]");
  }
}

void check_magnitudes(CheckedFile& file) {
  const Json values = file.values();
  for (const char* section : {"system", "excitation", "initial", "analysis"})
    if (values.contains(section)) check_magnitudes(file, values.at(section), section);
}

void resolve_frequency(CheckedFile& file) {
  if (!file.has("excitation", "frequency")) return;
  Json& frequency = file.values()["excitation"]["frequency"];
  const auto m = file.number_at("system", "mass");
  const auto k = file.number_at("system", "stiffness");
  const auto word = frequency.get<std::string>();
  if (word != "natural" && word != "damped") return;
  for (const char* key : {"mass", "stiffness"})
    if (!file.stands_in_file("system", key) && file.needs() != nullptr && !file.needs()->whole_system)
      file.complain("excitation.frequency", "a " + word + " frequency needs the system's " + key, "a frequency");
  if (!m || !k) return;
  const double natural = std::sqrt(*k / *m);
  double value = natural;
  if (word == "damped") {
    const auto c = file.number_at("system", "damping");
    if (!c) {
      if (!file.stands_in_file("system", "damping") && !file.stands_in_file("system", "damping_ratio"))
        file.complain("excitation.frequency", "a damped frequency needs the system's damping",
                      "natural, or a frequency");
      return;
    }
    const double zeta = *c / identify::critical_damping(*m, *k);
    if (std::abs(zeta) >= 1.0) {
      file.complain("excitation.frequency", "there is no damped frequency: the damping ratio is not below 1",
                    "natural, or a frequency", "damping ratio " + core::format_number(zeta, 6));
      return;
    }
    value = natural * std::sqrt((1.0 - zeta) * (1.0 + zeta));
  }
  frequency = core::format_number(value) + " rad/s";
}

/// Structural damping is defined at one frequency; the system may also have one damper.
void check_loss_factor(CheckedFile& file, const Analysis& analysis, const AnalysisList& analyses) {
  const std::string path = "system.loss_factor";
  if (file.number_at("system", "loss_factor").value_or(0.0) == 0.0) return;
  if (!analysis.steady_vibrations) {
    file.complain(path,
                  "'" + path + "' does not work with " + file.subject() +
                      ": structural damping is not causal: it has a steady vibration but no motion in time",
                  names_of(analyses, &Analysis::steady_vibrations));
    return;
  }
  if (file.is_given("excitation.harmonics"))
    file.complain(path,
                  "'" + path + "' does not work with a drive of several harmonics: it is that of one frequency",
                  "an excitation without harmonics");
  const bool damped = file.number_at("system", "damping").value_or(0.0) != 0.0;
  if (damped && moves_base(file.text_at("excitation", "type")) && file.text_at("system", "damper_to") == "ground")
    file.complain(path,
                  "'" + path +
                      "' acts between mass and base, and 'system.damping' between mass and ground: the "
                      "system has one damper",
                  "with damper_to: base, or damping: 0");
}

/// A load that follows the drive needs a drive.
void check_load_modulation(CheckedFile& file) {
  const Json& values = file.values();
  if (!values.contains("system") || !values.at("system").contains("friction")) return;
  if (excitation_named(file.text_at("excitation", "type")).is_harmonic()) return;
  const Json& friction = values.at("system").at("friction");
  const Json list = friction.is_array() ? friction : Json::array({friction});
  for (const Json& law : list)
    if (law.is_object() && law.contains("load_modulation"))
      file.complain("system.friction",
                    "'load_modulation' follows a harmonic excitation, and there is none; a load that varies with "
                    "position is a 'load_gradient'",
                    core::joined(harmonic_excitations()));
}

/// A result that cannot be computed again in another way cannot be verified.
void check_verification(CheckedFile& file, const Analysis& analysis, const AnalysisList& analyses) {
  const Json& values = file.values();
  if (analysis.verifiable || !values.contains("numerics") || !values.at("numerics").value("verify", false)) return;
  file.complain("numerics.verify",
                "'numerics.verify' does not work with " + file.subject() +
                    ": no other engine can compute its result again, point by point",
                names_of(analyses, &Analysis::verifiable));
}

/// Section and key of each number that may state an uncertainty.
constexpr std::array uncertain_numbers = {std::pair{"system", "mass"}, std::pair{"system", "stiffness"},
                                          std::pair{"excitation", "frequency"}};

/// An uncertainty as large as the value is refused: a constant that may be zero or negative is not known, and no
/// interval can contain its effect.
void check_size_of_uncertainties(CheckedFile& file) {
  for (const auto& [section, key] : uncertain_numbers) {
    const std::optional<double> uncertainty = file.number_at(section, uncertainty_key(key));
    const std::optional<double> value = file.number_at(section, key);
    if (!uncertainty || !value || *value == 0.0 || *uncertainty < std::abs(*value)) continue;
    const std::string path = std::string(section) + "." + key;
    file.complain(std::string(section) + "." + uncertainty_key(key),
                  "the uncertainty of '" + path + "' is too large",
                  "less than 100 % of its value; without a value the methods that do not need it are used",
                  core::percent(*uncertainty / std::abs(*value), 3));
  }
}

/// An uncertainty that affects no number of the result is refused.
void check_uncertainties(CheckedFile& file, const Analysis& analysis, const AnalysisList& analyses) {
  if (analysis.uses_uncertainties) return check_size_of_uncertainties(file);
  for (const auto& [section, key] : uncertain_numbers)
    if (file.has(section, uncertainty_key(key)))
      file.complain(std::string(section) + "." + uncertainty_key(key),
                    std::string("'") + section + "." + key + "' states an uncertainty, and " + file.subject() +
                        " does not use it",
                    "with analysis.type " + names_of(analyses, &Analysis::uses_uncertainties));
}

/// A damped frequency is that of the stated damping.
bool sets_frequency(const CheckedFile& file, const IdleKey& idle) {
  return idle.section == "system" && (idle.key == "damping" || idle.key == "damping_ratio") &&
         file.text_at("excitation", "frequency") == "damped";
}

/// A default may be stated: a resolved scenario states all of them.
bool states_default(const CheckedFile& file, const IdleKey& idle) {
  const Choice& section = *file.format().find(idle.section)->choice;
  const Variant* variant =
      section.key.empty() ? &section.variants.front() : section.find(file.text_at(idle.section, section.key));
  const Field* field = variant == nullptr ? nullptr : variant->section.find(idle.key);
  return field == nullptr || !file.has(idle.section, idle.key) ||
         file.values().at(idle.section).at(idle.key) == field->fallback;
}

/// A stated value that affects no number of the result is told; one that contradicts the analysis is refused.
void check_idle_keys(CheckedFile& file) {
  for (const IdleKey& idle : file.needs()->idle) {
    if (!file.stands_in_file(idle.section, idle.key) || states_default(file, idle) || sets_frequency(file, idle))
      continue;
    const std::string path = idle.section + "." + idle.key;
    const std::string message = "'" + path + "' has no effect: " + idle.reason;
    if (idle.allowed.empty())
      file.warnings.push_back(message);
    else
      file.complain(path, message, idle.allowed);
  }
}

/// Number of items of the result's lists, as far as it is known before the run.
std::size_t result_rows(const CheckedFile& file, const Analysis& analysis) {
  std::set<std::string> lists;
  for (const ResultField& field : result_fields(analysis, file.values().at("analysis")))
    if (const std::size_t end = field.path.find("[]"); end != std::string::npos)
      lists.insert(field.path.substr(0, end));
  std::size_t rows = 0;
  for (const std::string& list : lists)
    if (analysis.length_of != nullptr) rows += analysis.length_of(file, list).value_or(0);
  return rows;
}

}  // namespace

Checked check(const Document& document, Reading& reading, const Section& format, const AnalysisList& analyses,
              const DataPlace& data_place) {
  const Json nothing = Json::object();
  const Json& section = reading.values.contains("analysis") ? reading.values.at("analysis") : nothing;
  const Analysis* analysis =
      section.contains("type") ? find_analysis(analyses, section.at("type").get<std::string>()) : nullptr;
  static const std::vector<Needs> unknown;
  CheckedFile file(document, reading, format, analysis == nullptr ? unknown : analysis->needs, data_place);
  resolve_gravity(file);
  if (!file.stands_in_file("analysis", "data")) check_constants(file);
  if (analysis == nullptr) return {};
  if (file.needs() != nullptr) {
    check_sections(file);
    check_excitation(file);
    check_replaced(file);
    if (!file.needs()->excitations.empty()) check_verification(file, *analysis, analyses);
  }
  if (file.needs() != nullptr) {
    check_uncertainties(file, *analysis, analyses);
    check_idle_keys(file);
  }
  resolve_damping(file);
  if (file.needs() != nullptr) check_loss_factor(file, *analysis, analyses);
  check_load_modulation(file);
  check_mass_and_stiffness(file);
  check_magnitudes(file);
  resolve_frequency(file);
  if (file.needs() != nullptr && !file.needs()->excitations.empty()) read_drive(file);
  if (analysis->check != nullptr) analysis->check(file);
  check_pendulum(file);
  if (file.values().contains("expect"))
    check_expectations(file, {result_fields(*analysis, file.values().at("analysis")),
                              "analysis '" + file.analysis() + "'", [&](std::string_view list) {
                                return analysis->length_of == nullptr ? std::nullopt
                                                                      : analysis->length_of(file, list);
                              }});
  const std::size_t rows = result_rows(file, *analysis);
  resolve_coordinate(file);
  if (file.data) file.sha256.push_back(file.data->sha256);
  for (const DataFile& data : file.files) file.sha256.push_back(data.data.sha256);
  return {.analysis = analysis,
          .data = std::move(file.data),
          .result_rows = rows,
          .files = std::move(file.files),
          .compared = std::move(file.compared),
          .drive = std::move(file.drive),
          .drive_start = file.drive_start,
          .sha256 = std::move(file.sha256),
          .warnings = std::move(file.warnings)};
}

}  // namespace dualdamp::scenarios
