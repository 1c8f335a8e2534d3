#include "cli/conformance.hpp"

#include <stdexcept>

#include "core/diagnostics.hpp"
#include "core/units.hpp"
#include "scenarios/scenario.hpp"
#include "sim/conformance/law_conformance.hpp"

namespace dualdamp::cli {

namespace {

double positive(const std::string& option, const std::string& text, const std::string& unit) {
  const core::QuantityText quantity = core::parse_quantity(text, unit);
  if (!quantity.value) core::refuse({.file = option}, quantity.fault);
  if (!(*quantity.value > 0.0)) core::refuse({.file = option}, "must be above 0");
  return *quantity.value;
}

sim::LawCase case_of(const LawsCommand& command) {
  try {
    sim::LawCase result =
        sim::law_case(command.name, scenarios::law_parameters(command.name, command.set, "--set"));
    result.stroke = positive("--stroke", command.stroke, "m");
    result.stroke_time = positive("--stroke-time", command.stroke_time, "s");
    return result;
  } catch (const std::invalid_argument& error) {
    core::refuse({.file = "laws --check"}, error.what());
  }
}

}  // namespace

Conformance check_law(const LawsCommand& command) {
  const std::vector<std::string> faults = sim::nonconformities(case_of(command));
  if (faults.empty()) return {command.name + " keeps the law contract\n", true};
  std::string text = command.name + " breaks the law contract:\n";
  for (const std::string& fault : faults) text += "  " + fault + "\n";
  return {text, false};
}

}  // namespace dualdamp::cli
