#include "cli/command_line/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/nearest.hpp"

namespace dualdamp::cli {

namespace {

using Words = std::vector<std::string>;

/// The command that the line names: `stress export` rather than `stress`.
const CLI::App& named_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().back();
  return *command;
}

Words commands_of(const CLI::App& app) {
  Words names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

Words options_of(const CLI::App& command) {
  Words names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

bool is_option(std::string_view word) { return word.size() > 1 && word.front() == '-'; }

/// The name that the word probably means, or else all of them, after `all`.
std::string allowed(std::string_view word, const Words& names, const std::string& all) {
  const std::string meant = core::nearest(word, names);
  return meant.empty() ? all + core::joined(names) : "; did you mean '" + meant + "'?";
}

/// Of the first option among the words that were not read; empty without one.
std::string wrong_option(const CLI::App& command, const Words& unread) {
  const auto option = std::ranges::find_if(unread, is_option);
  if (option == unread.end()) return {};
  const std::string name = option->substr(0, option->find('='));
  const Words options = options_of(command);
  if (command.get_parent() == nullptr)
    return "there is no option '" + name + "'" + allowed(name, options, "; there are: ");
  return "the command '" + command.get_name() + "' has no option '" + name + "'" +
         allowed(name, options, "; it has: ");
}

std::string wrong_command(const CLI::App& app, const Words& unread) {
  const Words commands = commands_of(app);
  const auto word = std::ranges::find_if_not(unread, is_option);
  if (word == unread.end()) {
    const std::string option = wrong_option(app, unread);
    return option.empty() ? "a command is missing; there are: " + core::joined(commands) : option;
  }
  std::string text = "there is no command '" + *word + "'" + allowed(*word, commands, "; there are: ");
  if (word->ends_with(".yaml") || word->ends_with(".yml") || word->ends_with(".json"))
    text += "; 'dualdamp run " + *word + "' runs a scenario file, also a stress test";
  return text;
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = named_command(app);
  const Words unread = app.remaining(true);
  if (!commands_of(command).empty()) return wrong_command(command, unread);
  const std::string option = wrong_option(command, unread);
  return option.empty() ? error.what() : option;
}

std::string help_of(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command = &named_command(app); command != nullptr; command = command->get_parent())
    words = command->get_name() + " " + words;
  return words + "--help";
}

}  // namespace dualdamp::cli
