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

/// The output about a bug of the program, with the commit of the program.
[[nodiscard]] CommandOutput bug(const std::string& what);

/// Calls `work` and returns its output, or that about the exception that it throws.
[[nodiscard]] CommandOutput guarded(const std::function<CommandOutput()>& work);

}  // namespace dualdamp::cli
