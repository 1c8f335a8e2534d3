#pragma once
/// Executes a command against plugins that end the program: by a call of exit, or, in a child process, by a
/// crash, a call of _exit or a call that does not return.

#include "cli/command_line/arguments.hpp"

namespace dualdamp::cli {

/// Executes the command and returns its status. If a plugin calls exit, the process ends with the status of a
/// numerical failure (4) and a message that names the plugins.
[[nodiscard]] int execute_to_its_end(const Call& call) noexcept;

/// Executes the command in a child process and returns its status. If a signal or a plugin ends the child, or if it
/// takes longer than `call.isolation` seconds and is killed, the status is that of a numerical failure (4), with a
/// message that names the plugins. SIGINT and SIGTERM are passed on. Must be called before any other thread starts.
[[nodiscard]] int execute_isolated(const Call& call) noexcept;

/// Tells the parent of a child process the status with which the process ends itself. Call it just before.
void announce_end(int status) noexcept;

}  // namespace dualdamp::cli
