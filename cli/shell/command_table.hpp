#pragma once
/// The commands of the program as a table. The manual page and the completions of shells are made from it.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dualdamp::cli {

struct OptionEntry {
  std::string name;         ///< "--out"; "DATA" for a positional argument
  std::string short_name;   ///< "-h", or empty
  std::string placeholder;  ///< kind of its value: "DIR", "LAW", "bash|fish|zsh"; empty: a flag
  std::string text;
  bool is_positional = false;
  bool is_required = false;
  bool is_repeatable = false;
};

struct CommandEntry {
  std::string name;  ///< "run", "stress export"; empty: the program itself
  std::string text;
  std::string footer;
  std::vector<OptionEntry> options;   ///< with the positional arguments, in their order
  std::vector<std::string> commands;  ///< names of its commands, one word each: "export" of "stress"
};

/// The program itself, then every command; a command is followed by its own commands.
using CommandTable = std::vector<CommandEntry>;

[[nodiscard]] CommandTable command_table(const CLI::App& app);

}  // namespace dualdamp::cli
