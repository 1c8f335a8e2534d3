#include "sim/conformance/parameter_conformance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "core/constants.hpp"

namespace dualdamp::sim {

namespace {

bool names(const std::vector<friction::ParameterFault>& faults, std::string_view name) {
  return std::any_of(faults.begin(), faults.end(), [&](const auto& fault) { return fault.name == name; });
}

/// Tests the table's entry of one parameter that has a value in `values`.
class ParameterExaminer {
 public:
  ParameterExaminer(const std::vector<friction::Parameter>& table, const friction::ParameterValues& values,
                    Faults& faults)
      : table_(table), values_(values), completed_(values), faults_(faults) {}

  void run() {
    if (!friction::complete(table_, completed_).empty()) return faults_.add("the values of the case are refused");
    for (const friction::Parameter& parameter : table_) {
      examine_text(parameter);
      if (is_numeric(parameter)) examine_number(parameter);
      if (parameter.kind == friction::ParameterKind::choice)
        refuse(parameter, "no such word", parameter.describe());
      examine_presence(parameter);
      if (parameter.fields.empty() || !completed_.has(parameter.name)) continue;
      for (const friction::ParameterValues& record : completed_.list(parameter.name))
        ParameterExaminer(parameter.fields, record, faults_).run();
    }
    friction::ParameterValues unknown = values_;
    unknown.set("no_such_parameter", 1.0);
    if (!names(friction::complete(table_, unknown), "no_such_parameter"))
      faults_.add("an unknown parameter is accepted");
  }

 private:
  static bool is_numeric(const friction::Parameter& parameter) {
    using Kind = friction::ParameterKind;
    return parameter.kind == Kind::number || parameter.kind == Kind::count || parameter.kind == Kind::seed;
  }

  void examine_text(const friction::Parameter& parameter) {
    const bool has_unit = !parameter.unit.empty() || parameter.kind != friction::ParameterKind::number;
    if (parameter.meaning.empty() || !has_unit)
      faults_.add("'" + std::string(parameter.name) + "' has no meaning or no unit");
  }

  void refuse(const friction::Parameter& parameter, const friction::ParameterValues::Value& value,
              const std::string& allowed) {
    // The parameter belongs to the alternative form that this case does not use: it is refused whatever its value.
    if (!parameter.instead_of.empty() && completed_.has(parameter.instead_of)) return;
    friction::ParameterValues wrong = values_;
    const std::string name(parameter.name);
    wrong.set(name, value);
    const auto found = friction::complete(table_, wrong);
    const auto fault = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.name == name; });
    const auto* number = std::get_if<double>(&value);
    const std::string what = "'" + name + "' = " + (number == nullptr ? "another" : std::to_string(*number));
    if (fault == found.end()) return faults_.add(what + " is accepted");
    if (fault->found.empty()) faults_.add(what + " is refused without the value");
    if (fault->allowed != allowed) faults_.add(what + " is refused without the range");
  }

  void examine_number(const friction::Parameter& parameter) {
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), core::infinity, -core::infinity})
      refuse(parameter, value, "a finite number");
    const friction::Range range = parameter.allowed_range();
    const std::string allowed = range.describe(parameter.unit);
    const bool is_whole = parameter.kind != friction::ParameterKind::number;
    const auto beyond = [&](double end) { return is_whole ? 1.0 : 1e-3 * std::max(1.0, std::abs(end)); };
    if (std::isfinite(range.low)) refuse(parameter, range.low - beyond(range.low), allowed);
    if (range.low_open) refuse(parameter, range.low, allowed);
    if (std::isfinite(range.high)) refuse(parameter, range.high + beyond(range.high), allowed);
    if (range.high_open) refuse(parameter, range.high, allowed);
    if (is_whole) refuse(parameter, std::max(range.low, 0.0) + 0.5, parameter.describe());
    if (parameter.at_least.empty() || completed_.number(parameter.at_least) <= range.low) return;
    friction::ParameterValues below = completed_;
    below.set(parameter.name, std::nextafter(completed_.number(parameter.at_least), -core::infinity));
    if (!names(friction::complete(table_, below), parameter.name))
      faults_.add("'" + std::string(parameter.name) + "' below '" + std::string(parameter.at_least) +
                  "' is accepted");
  }

  void examine_presence(const friction::Parameter& parameter) {
    const std::string name(parameter.name);
    // If one form is missing, the other form is required, and all of its parameters.
    if (!parameter.required() || !completed_.has(name)) return;
    friction::ParameterValues missing = values_;
    missing.erase(name);
    if (friction::complete(table_, missing).empty()) faults_.add("a missing '" + name + "' is accepted");
  }

  const std::vector<friction::Parameter>& table_;
  const friction::ParameterValues& values_;
  friction::ParameterValues completed_;
  Faults& faults_;
};

}  // namespace

void examine_parameters(const std::vector<friction::Parameter>& table, const friction::ParameterValues& values,
                        Faults& faults) {
  ParameterExaminer(table, values, faults).run();
}

}  // namespace dualdamp::sim
