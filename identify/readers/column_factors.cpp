#include "identify/readers/column_factors.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "core/uncertain_quantity.hpp"
#include "core/units.hpp"
#include "identify/readers/amplitude_words.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

std::string without_brackets(std::string_view unit) {
  unit = trimmed(unit);
  if (unit.size() > 2 && unit.front() == '(' && unit.back() == ')') unit = unit.substr(1, unit.size() - 2);
  return std::string(trimmed(unit));
}

/// The unit of a scale, split into the unit of the column's quantity and the unit of the signal.
struct ScaleUnit {
  double factor = 1.0;
  std::string signal;           ///< unit of the signal; empty: a number without unit
  bool is_sensitivity = false;  ///< signal per quantity, as mV/g; else quantity per signal
};

/// Tries each `/` of the text: one side must be a unit of the column, the other one is the unit of the signal. A
/// mass makes a force of an acceleration.
std::optional<ScaleUnit> read_scale_unit(const std::string& unit, const KnownColumn& known,
                                         core::Coordinate coordinate) {
  for (std::size_t at = unit.rfind('/'); at != std::string::npos && at > 0; at = unit.rfind('/', at - 1)) {
    const std::string above = without_brackets(std::string_view(unit).substr(0, at));
    const std::string below = without_brackets(std::string_view(unit).substr(at + 1));
    if (above.empty() || below.empty()) continue;
    if (const auto factor = core::unit_factor(above, known.unit, coordinate).value)
      return ScaleUnit{*factor, below, false};
    if (const auto factor = core::unit_factor(below, known.unit, coordinate).value)
      return ScaleUnit{*factor, above, true};
  }
  if (const auto whole = core::unit_factor(unit, known.unit, coordinate).value) return ScaleUnit{*whole, {}, false};
  if (known.unit == "N")  // a mass times an acceleration
    if (const auto mass = core::unit_factor(unit, "kg", coordinate).value)
      return ScaleUnit{*mass, core::unit_for(coordinate, "m/s^2"), false};
  return std::nullopt;
}

/// Angles, their rates, and frequencies must state a unit: numbers in degrees look like numbers in radians.
bool is_angular(const KnownColumn& known, core::Coordinate coordinate) {
  return core::unit_for(coordinate, known.unit).starts_with("rad");
}

/// What else a column of the base's acceleration, or of a force in place of the base, is good for.
std::string other_reading(const KnownColumn& known, const std::string& unit, core::Coordinate coordinate,
                          const core::SettingWords& words) {
  if (known.name == "Y" && core::unit_factor(unit, "N", coordinate).value)
    return "; the amplitude of a force on the mass acts as a base that moves by F/k: for k = 2000 N/m " +
           words(core::Setting::scale, "Y", "0.0005 m/N");
  if (known.name != "y" || !core::unit_factor(unit, "m/s^2", coordinate).value) return {};
  return "; where friction acts against the base, its acceleration is the column 'force' with the scale -m, and x is "
         "the motion relative to the base";
}

}  // namespace

void check_names(const ReadOptions& options, Problems& problems) {
  const auto check = [&](const std::map<std::string, std::string>& map, const char* option, bool numbers_only) {
    for (const auto& [name, value] : map) {
      if (trimmed(value).empty())
        problems.add({{options.name, 0, 0, {}},
                      std::string("the ") + option + " that is stated for column " + name + " is empty",
                      name + "=" + (option == std::string_view("unit") ? "UNIT" : "...") + ", or no statement",
                      {},
                      {}});
      const KnownColumn* known = known_column(name);
      if (known != nullptr && !(numbers_only && known->unit.empty())) continue;
      problems.add({{options.name, 0, 0, {}},
                    std::string(option) + ": there is no column '" + name + "' that could be used",
                    core::joined(column_names(numbers_only)),
                    {},
                    {}});
    }
  };
  check(options.units, "unit", true);
  check(options.scales, "scale", true);
  check(options.columns, "column", false);
}

const std::string* find_for(const std::map<std::string, std::string>& map, const KnownColumn& known) {
  for (const std::string_view name : {known.name, known.alias})
    if (const auto found = map.find(std::string(name)); found != map.end() && !name.empty()) return &found->second;
  return nullptr;
}

bool is_wanted(const ReadOptions& options, const KnownColumn& known) {
  return options.only.empty() || std::ranges::find(options.only, known.name) != options.only.end();
}

double ColumnFactors::refuse(const core::Diagnostic& where, std::string message, std::string allowed,
                             std::string suggestion) {
  problems_.add({where.place, std::move(message), std::move(allowed), where.found, std::move(suggestion)});
  return 1.0;
}

std::string ColumnFactors::scale_of_voltage(const KnownColumn& known, const std::string& unit) const {
  if (!core::unit_factor(unit, "V", options_.coordinate).value) return {};
  return "; a voltage of a sensor needs a scale, as " +
         options_.words(core::Setting::scale, known.name,
                        "2.5 " + core::unit_for(options_.coordinate, known.unit) + "/V");
}

double ColumnFactors::factor_of(KnownColumn known, const std::string& stated, const core::Diagnostic& where) {
  const std::string name(known.name);
  if (options_.force_levels && name == "Y") known.unit = "N";
  const std::string* given = find_for(options_.units, known);
  const std::string unit = without_amplitude_words(given != nullptr ? *given : stated);
  if (known.unit.empty())
    return unit.empty() ? 1.0 : refuse(where, "column " + name + " is a label and has no unit", name);
  if (given != nullptr && !stated.empty() && stated != *given)
    warnings_.push_back("column " + name + " is read in " + *given + ", not in " + stated + " as the file states");
  if (const std::string* scale = find_for(options_.scales, known)) return scaled(known, *scale, unit, where);
  const std::string si_unit = core::unit_for(options_.coordinate, known.unit);
  if (unit.empty() && is_angular(known, options_.coordinate) && known.unit != "rad/s") {
    const std::string degrees = "deg" + si_unit.substr(std::string_view("rad").size());
    return refuse(where, "column " + name + ": an angle needs its unit, because degrees and radians differ",
                  "'" + name + " [" + degrees + "]' or '" + name + " [" + si_unit + "]' in the file, or " +
                      options_.words(core::Setting::unit, name, degrees));
  }
  if (unit.empty() && !is_angular(known, options_.coordinate)) {
    assume(name, si_unit);
    return 1.0;
  }
  const core::QuantityText factor = core::unit_factor(unit, known.unit, options_.coordinate);
  if (factor.value) {
    stated_[name] = unit;
    return *factor.value;
  }
  core::Diagnostic fault = where;
  if (given != nullptr) fault.found = *given;
  return refuse(fault,
                "the unit of column " + name +
                    (known.unit == "N" && name == "Y" ? ", the amplitude of the force" : "") + ": " + factor.fault,
                core::describe_dimension(known.unit, options_.coordinate) + "; in the file as '" + name +
                    " [unit]', or as " + options_.words(core::Setting::unit, name, "UNIT") +
                    scale_of_voltage(known, unit) +
                    other_reading(known, unit, options_.coordinate, options_.words) +
                    (options_.coordinate_reason.empty() ? "" : "; " + options_.coordinate_reason),
                factor.suggestion);
}

void ColumnFactors::check_suffix(const KnownColumn& known, const std::string& name, const std::string& unit,
                                 bool has_output, const core::Diagnostic& where) {
  const std::size_t mark = name.find_last_of("_-.");
  const bool is_suffix = mark != std::string::npos && std::string_view(name).substr(mark + 1) == unit;
  if (!is_suffix || (unit != "in" && unit != "m") || find_for(options_.units, known) != nullptr) return;
  const std::string column(known.name);
  const std::string stated = options_.words(core::Setting::unit, column, "UNIT");
  if (unit == "in" && has_output) {
    refuse(where, "the end of '" + name + "' may mean inches or an input",
           "the unit, as " + stated + " or in square brackets");
    return;
  }
  std::string warning = "the end of '" + name + "' is read as the unit of column " + column +
                        (unit == "in" ? ", inches" : ", metres") +
                        "; if it belongs to the name, state the unit: " + stated;
  if (std::ranges::find(warnings_, warning) == warnings_.end()) warnings_.push_back(std::move(warning));
}

void ColumnFactors::check_amplitude(const KnownColumn& known, const std::string& heading, const std::string& unit,
                                    const core::Diagnostic& where) {
  if (known.name != "Y" && known.name != "x" && known.name != "fundamental") return;
  std::optional<AmplitudeWords> said = amplitude_words(heading);
  if (!said) said = amplitude_words(unit);
  if (!said) return;
  const std::string column(known.name);
  const bool has_unit = find_for(options_.units, known) != nullptr;
  const std::string* scale = find_for(options_.scales, known);
  const bool is_number = scale != nullptr && core::read_number(*scale).length == trimmed(*scale).size();
  if (scale != nullptr && (is_number || has_unit)) return;
  const std::string factor(said->to_amplitude);
  refuse(where,
         "column " + column + " is " + std::string(said->name) +
             " by its heading, and an amplitude is half of peak to trough",
         scale == nullptr
             ? options_.words(core::Setting::scale, column, factor) +
                   (factor == "0.5" ? "" : ", right for a sine") + "; or amplitudes under a heading that says so"
             : "a scale that contains the factor " + factor + ", beside the unit of the signal, " +
                   options_.words(core::Setting::unit, column, "V"));
}

double ColumnFactors::scaled(const KnownColumn& known, const std::string& scale, const std::string& unit,
                             const core::Diagnostic& where) {
  const std::string name(known.name);
  const std::string allowed = "such as '2.5 " + core::unit_for(options_.coordinate, known.unit) + "/V'";
  core::Diagnostic fault = where;
  fault.found = scale;
  const std::string text(trimmed(scale));
  // `identify` takes an uncertainty from the scale before its file is read.
  const core::SplitQuantityText split = core::split_uncertainty(text);
  if (split.relative || !split.fault.empty())
    return refuse(fault, "the scale of column " + name + " states an uncertainty, which only 'identify' uses",
                  split.relative ? "'" + split.quantity + "'" : allowed);
  const core::NumberText number = core::read_number(text);
  if (!number.value || *number.value == 0.0)
    return refuse(fault, "the scale of column " + name + " does not begin with a number other than zero", allowed);
  const std::string scale_unit(trimmed(std::string_view(text).substr(number.length)));
  if (scale_unit.empty()) {  // in the column's own unit
    if (unit.empty() && is_angular(known, options_.coordinate))
      return refuse(fault, "the scale of column " + name + " needs its unit", allowed);
    const core::QuantityText factor = core::unit_factor(unit, known.unit, options_.coordinate);
    if (factor.value) return *number.value * *factor.value;
    return refuse(fault,
                  "the scale of column " + name + " does not lead from " + unit + " to " +
                      core::describe_dimension(known.unit, options_.coordinate),
                  allowed);
  }
  const auto read = read_scale_unit(scale_unit, known, options_.coordinate);
  if (!read)
    return refuse(fault,
                  "the scale of column " + name + " does not lead to " +
                      core::describe_dimension(known.unit, options_.coordinate),
                  allowed);
  double per_signal = 1.0;
  if (unit.empty()) {
    if (!read->signal.empty()) assume(name, read->signal);
  } else if (unit != read->signal) {
    const auto conversion = read->signal.empty() ? std::nullopt : core::unit_factor(unit, read->signal).value;
    if (!conversion) {
      const std::string stated = text.substr(0, number.length);
      const bool is_own = core::unit_factor(unit, known.unit, options_.coordinate).value.has_value();
      return refuse(
          fault,
          "the scale of column " + name + " is for numbers " +
              (read->signal.empty() ? "without a unit" : "in " + read->signal) +
              ", and those of the column are in " + unit,
          is_own ? "'" + stated + "', which leaves the numbers in " + unit
                 : "such as '" + stated + " " + core::unit_for(options_.coordinate, known.unit) + "/" + unit + "'");
    }
    per_signal = *conversion;
  }
  const double gain = read->is_sensitivity ? 1.0 / *number.value : *number.value;
  return gain * read->factor * per_signal;
}

/// Adds the column to the assumed ones, once for all tests.
void ColumnFactors::assume(const std::string& name, const std::string& unit) {
  if (std::ranges::find(assumed_, name, &AssumedUnit::name) == assumed_.end()) assumed_.push_back({name, unit});
}

ColumnUnits ColumnFactors::take_units() {
  if (assumed_.empty()) return {{}, std::move(stated_)};
  std::vector<std::string> names;
  std::vector<std::string> units;
  for (const AssumedUnit& assumed : assumed_) {
    names.push_back(assumed.name);
    units.push_back(assumed.name + " in " + assumed.unit);
  }
  warnings_.push_back("no unit is stated for " + core::joined(names, " and ") + ": read " +
                      core::joined(units, " and ") + "; state another one as " +
                      options_.words(core::Setting::unit, names.back(), "UNIT"));
  return {std::move(names), std::move(stated_)};
}

}  // namespace dualdamp::identify
