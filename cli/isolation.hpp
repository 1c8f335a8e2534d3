#pragma once
/// A command in a child process, so that a plugin that crashes, or does not return, ends that process alone.

#include "cli/arguments.hpp"

namespace dualdamp::cli {

/// Executes the command in a child process and returns its status. A child that a signal ends, or that takes longer
/// than `call.isolation` seconds and is then killed, is a numerical failure (status 4) with a message that names
/// the plugins. SIGINT and SIGTERM are passed on. Must be called before any other thread starts.
[[nodiscard]] int execute_isolated(const Call& call) noexcept;

}  // namespace dualdamp::cli
