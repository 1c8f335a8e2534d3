#pragma once
/// Executes the commands of the program. Results go to stdout or to files, messages to stderr.

#include "cli/command_line/arguments.hpp"

namespace dualdamp::cli {

/// Executes a command line and returns the exit status of the program. Never throws.
[[nodiscard]] int execute(const Call& call) noexcept;

}  // namespace dualdamp::cli
