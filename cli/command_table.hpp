#pragma once
/// The commands of the program as a table: the manual page and the completions of shells are written from it.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dualdamp::cli {

struct OptionEntry {
  std::string name;         ///< "--out"; of a positional argument "DATA"
  std::string short_name;   ///< "-h", or empty
  std::string placeholder;  ///< what its value is: "DIR", "LAW", "bash|fish|zsh"; empty: a flag
  std::string text;
  bool is_positional = false;
  bool is_required = false;
  bool is_repeatable = false;
};

struct CommandEntry {
  std::string name;  ///< "run", "stress export"; empty: the program itself
  std::string text;
  std::string footer;
  std::vector<OptionEntry> options;   ///< positional arguments too, in their order
  std::vector<std::string> commands;  ///< one word each: "export" of "stress"
};

/// First the program itself, then every command, those of a command right behind it.
using CommandTable = std::vector<CommandEntry>;

[[nodiscard]] CommandTable command_table(const CLI::App& app);

}  // namespace dualdamp::cli
