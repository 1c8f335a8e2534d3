#pragma once
/// What a command says of work that cannot be done.

#include <functional>
#include <string>
#include <vector>

#include "cli/reports.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

[[nodiscard]] Report refused(core::ExitStatus status, const std::vector<core::Diagnostic>& problems);
[[nodiscard]] Report refused(core::ExitStatus status, const std::string& message);

/// What nobody should ever read, with the commit that did it.
[[nodiscard]] Report bug(const std::string& what);

/// The report of `work`, or of what it throws.
[[nodiscard]] Report guarded(const std::function<Report()>& work);

}  // namespace dualdamp::cli
