#pragma once
/// Completion of the command line in shells.

#include <string>
#include <string_view>

#include "cli/shell/command_table.hpp"

namespace dualdamp::cli {

/// The script for the shell "bash", "zsh" or "fish". It completes commands, options, names of laws (with those of
/// loaded plugins), methods and analyses, and files with the right extension.
[[nodiscard]] std::string completion_script(std::string_view shell, const CommandTable& table);

}  // namespace dualdamp::cli
