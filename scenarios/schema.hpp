#pragma once
/// Documents made from the tables of the format, so that they cannot say anything else than the reader does.

#include <string>

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

/// JSON Schema (draft 7) of a scenario file, for editors and other programs. It refuses whatever a schema can see;
/// what it cannot (duplicate keys, static friction below kinetic, ...) only the reader refuses. Units are those in
/// common use: the reader knows more.
[[nodiscard]] std::string json_schema(const AnalysisList& list);

/// Reference page of keys, units, ranges, defaults and results, in Markdown.
[[nodiscard]] std::string reference_page(const AnalysisList& list);

}  // namespace dualdamp::scenarios
