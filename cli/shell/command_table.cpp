#include "cli/shell/command_table.hpp"

#include <CLI/CLI.hpp>

namespace dualdamp::cli {

namespace {

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  entry.is_positional = option.get_positional();
  const bool is_flag = option.get_items_expected_max() == 0;
  if (entry.is_positional) {
    entry.name = option.get_name(true);
    entry.placeholder = entry.name;
  } else {
    entry.name = "--" + option.get_lnames().front();
    if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames().front();
    const std::string type = option.get_type_name();  // "N:INT in [1 - 10]" with a range
    if (!is_flag) entry.placeholder = type.substr(0, type.find(':'));
  }
  entry.text = option.get_description();
  if (!option.get_default_str().empty()) entry.text += " (default: " + option.get_default_str() + ")";
  entry.is_required = option.get_required();
  entry.is_repeatable = !is_flag && option.get_expected_max() > 1;
  return entry;
}

void add(CommandTable& table, const CLI::App& app, const std::string& name) {
  CommandEntry entry{.name = name, .text = app.get_description()};
  // A command without its own footer inherits that of the program.
  if (table.empty() || app.get_footer() != table.front().footer) entry.footer = app.get_footer();
  const auto is_shown = [](const CLI::Option* option) {
    return option->get_positional() || !option->get_group().empty();
  };
  for (const CLI::Option* option : app.get_options(is_shown)) entry.options.push_back(entry_of(*option));
  const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) entry.commands.push_back(command->get_name());
  table.push_back(std::move(entry));
  for (const CLI::App* command : commands)
    add(table, *command, name.empty() ? command->get_name() : name + " " + command->get_name());
}

}  // namespace

CommandTable command_table(const CLI::App& app) {
  CommandTable table;
  add(table, app, {});
  return table;
}

}  // namespace dualdamp::cli
