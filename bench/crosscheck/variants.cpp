#include "bench/crosscheck/variants.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/format/excitations.hpp"

namespace dualdamp::crosscheck {

namespace {

/// Exponents of force, length and time.
struct Dimension {
  int force = 0;
  int length = 0;
  int time = 0;
};

Dimension dimension_of(std::string_view unit) {
  static const std::map<std::string_view, Dimension> units = {{"", {}},
                                                              {"1", {}},
                                                              {"kg", {1, -1, 2}},
                                                              {"N", {1, 0, 0}},
                                                              {"N/m", {1, -1, 0}},
                                                              {"N/m^3", {1, -3, 0}},
                                                              {"N.s/m", {1, -1, 1}},
                                                              {"N/s", {1, 0, -1}},
                                                              {"m", {0, 1, 0}},
                                                              {"m/s", {0, 1, -1}},
                                                              {"s", {0, 0, 1}},
                                                              {"1/s", {0, 0, -1}},
                                                              {"rad/s", {0, 0, -1}},
                                                              {"W", {1, 1, -1}},
                                                              {"1/m", {0, -1, 0}},
                                                              {"rad", {}},
                                                              {"m^2.s", {0, 2, 1}},
                                                              {"N^2.s", {2, 0, 1}}};
  const auto found = units.find(unit);
  if (found == units.end()) throw std::logic_error("crosscheck does not know the unit " + std::string(unit));
  return found->second;
}

double factor(const Scales& scales, std::string_view unit) {
  const Dimension d = dimension_of(unit);
  // By repeated multiplication, which keeps powers of two exact.
  const auto power = [](double base, int exponent) {
    double result = 1.0;
    for (int i = 0; i < std::abs(exponent); ++i) result *= base;
    return exponent < 0 ? 1.0 / result : result;
  };
  return power(scales.force, d.force) * power(scales.length, d.length) * power(scales.time, d.time);
}

void scale(Json& section, const char* key, std::string_view unit, const Scales& scales) {
  if (!section.contains(key)) return;
  Json& value = section[key];
  const double by = factor(scales, unit);
  if (value.is_array()) {
    for (Json& item : value) item = item.get<double>() * by;
  } else if (value.is_string()) {  // a frequency: '10 rad/s'
    const core::NumberText number = core::read_number(value.get<std::string>());
    value = core::format_number(*number.value * by) + " rad/s";
  } else {
    value = value.get<double>() * by;
  }
}

void scale_parameters(Json& values, const std::vector<friction::Parameter>& table, const Scales& scales) {
  for (const friction::Parameter& parameter : table) {
    const std::string name(parameter.name);
    if (!values.contains(name)) continue;
    if (parameter.kind == friction::ParameterKind::number) scale(values, name.c_str(), parameter.unit, scales);
    if (parameter.kind == friction::ParameterKind::record) scale_parameters(values[name], parameter.fields, scales);
    if (parameter.kind == friction::ParameterKind::list)
      for (Json& item : values[name]) scale_parameters(item, parameter.fields, scales);
  }
}

void scale_law(Json& law, const Scales& scales) {
  scale_parameters(law, friction::find_law(law.at("law").get<std::string>())->parameters, scales);
}

bool is_base(const Json& excitation) { return scenarios::moves_base(excitation.at("type").get<std::string>()); }

void scale_excitation(Json& excitation, const Scales& scales) {
  const char* unit = is_base(excitation) ? "m" : "N";
  scale(excitation, "amplitude", unit, scales);
  scale(excitation, "frequency", "rad/s", scales);
  scale(excitation, "from", "rad/s", scales);
  scale(excitation, "to", "rad/s", scales);
  scale(excitation, "duration", "s", scales);
  scale(excitation, "times", "s", scales);
  scale(excitation, "values", unit, scales);
  scale(excitation, "offset", "N", scales);
  scale(excitation, "velocity", "m/s", scales);
  scale(excitation, "rate", "N/s", scales);
  scale(excitation, "bandwidth", "rad/s", scales);
  scale(excitation, "intensity", is_base(excitation) ? "m^2.s" : "N^2.s", scales);
  if (excitation.contains("harmonics"))
    for (Json& harmonic : excitation["harmonics"]) scale(harmonic, "amplitude", unit, scales);
}

double number_or(const Json& section, const char* key, double fallback) {
  return section.contains(key) ? section.at(key).get<double>() : fallback;
}

void negate(Json& section, const char* key) {
  if (section.contains(key)) section[key] = -section[key].get<double>();
}

/// Names of values by direction: what holds forward holds backward, and the other way round.
void swap_directions(Json& law) {
  Json result;
  for (const auto& [key, value] : law.items()) {
    constexpr std::string_view forward = "_forward";
    constexpr std::string_view backward = "_backward";
    const std::string_view name = key;
    if (name.ends_with(forward))
      result[std::string(name.substr(0, name.size() - forward.size())).append(backward)] = value;
    else if (name.ends_with(backward))
      result[std::string(name.substr(0, name.size() - backward.size())).append(forward)] = value;
    else
      result[key] = value;
  }
  law = std::move(result);
}

}  // namespace

Json scaled(const Json& scenario, const Scales& scales) {
  Json result = scenario;
  Json& system = result["system"];
  scale(system, "mass", "kg", scales);
  scale(system, "stiffness", "N/m", scales);
  scale(system, "damping", "N.s/m", scales);
  scale(system, "cubic_stiffness", "N/m^3", scales);
  if (system.contains("friction"))
    for (Json& law : system["friction"]) scale_law(law, scales);
  scale_excitation(result["excitation"], scales);
  if (result.contains("initial")) {
    scale(result["initial"], "position", "m", scales);
    scale(result["initial"], "velocity", "m/s", scales);
    scale(result["initial"], "travel", "m", scales);
  }
  scale(result["analysis"], "duration", "s", scales);
  return result;
}

Json mirrored(const Json& scenario) {
  Json result = scenario;
  Json& excitation = result["excitation"];
  const auto turn = [](Json& harmonic) {
    harmonic["phase"] = number_or(harmonic, "phase", 0.0) + std::numbers::pi;
  };
  if (excitation.contains("amplitude")) turn(excitation);
  if (excitation.contains("harmonics"))
    for (Json& harmonic : excitation["harmonics"]) turn(harmonic);
  for (const char* key : {"offset", "velocity", "rate"}) negate(excitation, key);
  if (excitation.contains("values"))
    for (Json& value : excitation["values"]) value = -value.get<double>();
  if (result.contains("initial"))
    for (const char* key : {"position", "velocity", "travel"}) negate(result["initial"], key);
  if (result.at("system").contains("friction"))
    for (Json& law : result["system"]["friction"]) {
      negate(law, "load_gradient");
      swap_directions(law);
    }
  return result;
}

bool has_mirror(const Json& scenario) {
  if (scenario.at("excitation").contains("seed")) return false;
  for (const Json& law : scenario.at("system").value("friction", Json::array())) {
    const friction::LawEntry* entry = friction::find_law(law.at("law").get<std::string>());
    if (entry->is_random || (!entry->is_odd && !law.contains("kinetic_backward"))) return false;
    if (law.contains("fluctuation") && law.at("fluctuation").contains("correlation_length")) return false;
  }
  return true;
}

Json perturbed(const Json& scenario, double share, double length, Draws& draws) {
  const auto by = [&] { return 1.0 + share * draws.uniform(-1.0, 1.0); };
  Json result = scenario;
  Json& system = result["system"];
  for (const char* key : {"mass", "stiffness", "damping", "cubic_stiffness"})
    if (system.contains(key)) system[key] = system[key].get<double>() * by();
  if (system.contains("friction"))
    for (Json& law : system["friction"]) scale_law(law, {.force = by()});
  Json& excitation = result["excitation"];
  scale_excitation(excitation, is_base(excitation) ? Scales{.length = by()} : Scales{.force = by()});
  if (excitation.contains("frequency"))
    excitation["phase"] = number_or(excitation, "phase", 0.0) + share * draws.uniform(-1.0, 1.0);
  Json& initial = result["initial"];
  initial["position"] = number_or(initial, "position", 0.0) * by() + length * share * draws.uniform(-1.0, 1.0);
  initial["velocity"] = number_or(initial, "velocity", 0.0) * by();
  return result;
}

}  // namespace dualdamp::crosscheck
