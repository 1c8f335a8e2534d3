/// Scenarios as text, the whole reader: tree, keys, units, checks of every analysis. What it accepts is resolved to
/// a scenario that it accepts again and resolves to the same text.

#include <string>
#include <string_view>

#include "bench/analyses.hpp"
#include "core/diagnostics.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

std::string resolved(const std::string& text) {
  return dualdamp::scenarios::parse_scenario(text, "case.yaml", {.analyses = dualdamp::bench::analyses()}).resolved;
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  std::string first;
  try {
    first = resolved(std::string(input));
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
    for (const core::Diagnostic& problem : error.diagnostics())
      require(!core::format(problem).empty() && !problem.message.empty(), "a problem has a message");
    return;
  }
  try {
    require(resolved(first) == first, "a resolved scenario resolves to itself");
  } catch (const core::InputError& error) {
    require(false, "a resolved scenario is valid: " + core::format(error.diagnostics().front()));
  }
}
