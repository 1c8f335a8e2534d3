#pragma once
/// One case of the campaign: a scenario, its comparisons, their findings.

#include <cstdint>
#include <string>
#include <vector>

#include "bench/crosscheck/finding.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::crosscheck {

struct CaseReport {
  std::uint32_t index = 0;
  Findings findings;
  std::vector<std::string> features;  ///< for the table of what was drawn: "law: coulomb", "drive: force_harmonic"

  /// The worst of its findings; `agreed` only if something was compared.
  [[nodiscard]] Verdict verdict() const;
};

[[nodiscard]] CaseReport check_case(const scenarios::Json& scenario, std::uint64_t seed, std::uint32_t index);

/// The features of a scenario, for the table of what was drawn.
[[nodiscard]] std::vector<std::string> features(const scenarios::Json& scenario);

[[nodiscard]] scenarios::Json to_json(const CaseReport& report);
[[nodiscard]] CaseReport case_report(const scenarios::Json& json);

}  // namespace dualdamp::crosscheck
