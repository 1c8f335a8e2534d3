#pragma once
/// Reports of work that failed.

#include <functional>
#include <string>
#include <vector>

#include "cli/reports.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

[[nodiscard]] Report refused(core::ExitStatus status, const std::vector<core::Diagnostic>& problems);
[[nodiscard]] Report refused(core::ExitStatus status, const std::string& message);

/// The report of a bug of the program, with the commit of the program.
[[nodiscard]] Report bug(const std::string& what);

/// Calls `work` and returns its report, or the report of the exception that it throws.
[[nodiscard]] Report guarded(const std::function<Report()>& work);

}  // namespace dualdamp::cli
