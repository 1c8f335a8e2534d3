#pragma once
/// Documents that are generated from the tables of the format, so that they agree with the reader.

#include <string>

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

/// JSON Schema (draft 7) of a scenario file, for editors and other programs. It refuses all faults that a schema
/// can express; others (duplicate keys, static friction below kinetic, ...) only the reader refuses. Units are
/// those in common use; the reader accepts more.
[[nodiscard]] std::string json_schema(const AnalysisList& list);

/// Reference page of keys, units, ranges, defaults and results, in Markdown.
[[nodiscard]] std::string reference_page(const AnalysisList& list);

}  // namespace dualdamp::scenarios
