#pragma once
/// What the program does for each command. Results go to stdout or to files, messages to stderr.

#include "cli/arguments.hpp"

namespace dualdamp::cli {

/// Exit status of the program. Never throws.
[[nodiscard]] int execute(const Call& call) noexcept;

}  // namespace dualdamp::cli
