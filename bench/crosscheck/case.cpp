#include "bench/crosscheck/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/crosscheck/motions.hpp"
#include "bench/crosscheck/orbits.hpp"
#include "bench/crosscheck/random_scenario.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "friction_models/law_fault.hpp"
#include "friction_models/modifiers/modifiers.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::crosscheck {

namespace {

using scenarios::Json;

/// "1e-2 to 1e0": the two decades of a value.
std::string decades(double value) {
  if (value == 0.0) return "0";
  const double low = 2.0 * std::floor(std::log10(std::abs(value)) / 2.0);
  return fmt::format("{}1e{} to 1e{}", value < 0.0 ? "negative, " : "", low, low + 2.0);
}

}  // namespace

Verdict CaseReport::verdict() const {
  Verdict worst = Verdict::not_compared;
  for (const Finding& finding : findings) {
    // Any verdict stands above `not_compared`; otherwise the worst verdict counts.
    if (finding.verdict == Verdict::not_compared) continue;
    if (worst == Verdict::not_compared || finding.verdict > worst) worst = finding.verdict;
  }
  return worst;
}

std::vector<std::string> features(const Json& scenario) {
  std::vector<std::string> result;
  const Json& system = scenario.at("system");
  const Json& drive = scenario.at("excitation");
  const double natural = std::sqrt(system.at("stiffness").get<double>() / system.at("mass").get<double>());
  result.push_back("drive: " + drive.at("type").get<std::string>());
  const double critical = 2.0 * system.at("mass").get<double>() * natural;
  result.push_back("damping ratio: " + decades(system.at("damping").get<double>() / critical));
  if (drive.contains("frequency"))
    result.push_back("frequency ratio: " +
                     decades(*core::read_number(drive.at("frequency").get<std::string>()).value / natural));
  if (drive.contains("harmonics")) result.emplace_back("drive: with harmonics");
  if (system.contains("damper_to")) result.emplace_back("damper to base");
  if (system.contains("cubic_stiffness")) result.emplace_back("cubic spring");
  const Json& laws = system.at("friction");
  result.push_back(fmt::format("laws in parallel: {}", laws.size()));
  for (const Json& law : laws) {
    result.push_back("law: " + law.at("law").get<std::string>());
    if (law.contains("static")) result.emplace_back("static above kinetic");
    if (law.contains("contact_damping")) result.emplace_back("damped contact");
    for (const std::string_view modifier : friction::all_modifiers())
      if (law.contains(modifier)) result.push_back("modifier: " + std::string(modifier));
  }
  return result;
}

CaseReport check_case(const Json& scenario, std::uint64_t seed, std::uint32_t index) {
  CaseReport report{index, {}, features(scenario)};
  const auto add = [&](Findings findings) {
    for (Finding& finding : findings) report.findings.push_back(std::move(finding));
  };
  try {
    const scenarios::Scenario read = scenarios::parse_scenario(yaml(scenario), "case");
    add(compare_motions(scenario, seed ^ (std::uint64_t{index} << 32U)));
    if (read.model.excitation.is_harmonic()) add(compare_orbits(read));
  } catch (const core::InputError& error) {
    report.findings.push_back({"reading", Verdict::refused, 0.0, error.diagnostics().front().message});
  } catch (const friction::LawFault& fault) {
    report.findings.push_back({"law", Verdict::refused, 0.0, fault.what()});
  }
  return report;
}

Json to_json(const CaseReport& report) {
  Json json = {{"index", report.index}, {"features", report.features}, {"findings", Json::array()}};
  for (const Finding& finding : report.findings)
    json["findings"].push_back({{"comparison", finding.comparison},
                                {"verdict", static_cast<int>(finding.verdict)},
                                {"worst", core::format_number(finding.worst)},
                                {"text", finding.text}});
  return json;
}

CaseReport case_report(const Json& json) {
  CaseReport report;
  report.index = json.at("index").get<std::uint32_t>();
  report.features = json.at("features").get<std::vector<std::string>>();
  for (const Json& item : json.at("findings")) {
    const auto worst = core::parse_number(item.at("worst").get<std::string>()).value;
    report.findings.push_back(
        {item.at("comparison").get<std::string>(), static_cast<Verdict>(item.at("verdict").get<int>()),
         worst.value_or(std::numeric_limits<double>::infinity()), item.at("text").get<std::string>()});
  }
  return report;
}

}  // namespace dualdamp::crosscheck
