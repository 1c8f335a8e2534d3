#pragma once
/// Reports of work that failed.

#include <functional>
#include <string>
#include <vector>

#include "cli/command_output.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

[[nodiscard]] CommandOutput refused(core::ExitStatus status, const std::vector<core::Diagnostic>& problems);
[[nodiscard]] CommandOutput refused(core::ExitStatus status, const std::string& message);

inline constexpr const char* message_of_no_memory =
    "there is not enough memory for this: ask for less, or raise the limit (ulimit -v)";

/// Calls `work` and returns its output, or that about the exception that it throws.
[[nodiscard]] CommandOutput guarded(const std::function<CommandOutput()>& work);

}  // namespace dualdamp::cli
