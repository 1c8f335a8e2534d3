#pragma once
/// Completion of the command line in shells.

#include <string>
#include <string_view>

#include "cli/command_table.hpp"

namespace dualdamp::cli {

/// The script for "bash", "zsh" or "fish": commands, options, names of laws, methods and analyses, files by their
/// ending. Laws of plugins that are loaded are among the laws.
[[nodiscard]] std::string completion_script(std::string_view shell, const CommandTable& table);

}  // namespace dualdamp::cli
