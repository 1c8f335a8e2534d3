#pragma once
/// The conformance suite from the command line: `dualdamp laws NAME --check`.

#include <string>

#include "cli/command_line/arguments.hpp"

namespace dualdamp::cli {

struct Conformance {
  std::string text;
  bool holds = true;
};

/// Tests whether a law keeps its contract. Errors: core::InputError for values that the law refuses;
/// friction::LawFault.
[[nodiscard]] Conformance check_law(const LawsCommand& command);

}  // namespace dualdamp::cli
