#pragma once
/// What the tests of several readers share: what is said of a refused file, and plain columns.

#include <catch2/catch.hpp>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"

namespace dualdamp::identify::testing {

/// What is said of a file that must be refused.
template <typename Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const core::InputError& error) {
    std::string text;
    for (const core::Diagnostic& problem : error.diagnostics()) text += core::format(problem) + "\n";
    return text;
  }
  return "accepted";
}

inline bool mentions(const std::string& text, const std::string& words) {
  const bool found = text.find(words) != std::string::npos;
  if (!found) UNSCOPED_INFO(text);
  return found;
}

inline std::vector<double> ramp(std::size_t count) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

}  // namespace dualdamp::identify::testing
