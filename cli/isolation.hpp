#pragma once
/// Executes a command in a child process. A plugin that crashes or does not return then ends only this process.

#include "cli/arguments.hpp"

namespace dualdamp::cli {

/// Executes the command in a child process and returns its status. If a signal ends the child, or if the child
/// takes longer than `call.isolation` seconds and is killed, the status is that of a numerical failure (4), with a
/// message that names the plugins. SIGINT and SIGTERM are passed on. Must be called before any other thread starts.
[[nodiscard]] int execute_isolated(const Call& call) noexcept;

}  // namespace dualdamp::cli
