#include "cli/shell/manual.hpp"

#include <algorithm>
#include <string_view>

#include "core/build_info.hpp"

namespace dualdamp::cli {

namespace {

/// The text escaped for troff: no character is a command, and a hyphen can be copied.
std::string plain(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (plain.empty() || plain.back() == '\n')) plain += "\\&";
    if (c == '\\')
      plain += "\\e";
    else if (c == '-')
      plain += "\\-";
    else
      plain += c;
  }
  return plain;
}

std::string bold(std::string_view text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + plain(text) + "\\fR"; }

/// "--out DIR", "[LAW]", "DATA...".
std::string usage_of(const OptionEntry& option) {
  if (option.is_positional) {
    const std::string name = italic(option.name) + (option.is_repeatable ? "..." : "");
    return option.is_required ? name : "[" + name + "]";
  }
  const std::string names = (option.short_name.empty() ? "" : bold(option.short_name) + ", ") + bold(option.name);
  return option.placeholder.empty() ? names : names + " " + italic(option.placeholder);
}

std::string synopsis_of(const CommandEntry& command) {
  std::string line = ".B dualdamp " + plain(command.name) + "\n[OPTIONS]";
  for (const OptionEntry& option : command.options)
    if (option.is_positional || option.is_required) line += " " + usage_of(option);
  return line;
}

std::string options_of(const CommandEntry& command) {
  std::string text;
  for (const OptionEntry& option : command.options) {
    if (option.name == "--help" && !command.name.empty()) continue;  // described once, for the program
    text += ".TP\n" + usage_of(option) + "\n" + plain(option.text);
    text += option.is_required && !option.is_positional ? "; required" : "";
    text += option.is_repeatable && !option.is_positional ? "; may be repeated.\n" : ".\n";
  }
  return text;
}

std::string command_section(const CommandEntry& command) {
  std::string text =
      ".SS " + plain(command.name) + "\n" + synopsis_of(command) + "\n.PP\n" + plain(command.text) + ".\n";
  text += options_of(command);
  if (!command.footer.empty()) text += ".PP\n" + plain(command.footer) + "\n";
  return text;
}

/// "Exit status: 0 done, ..." as a section.
std::string footer_section(const std::string& footer) {
  const std::size_t colon = footer.find(": ");
  std::string heading = footer.substr(0, colon);
  std::ranges::transform(heading, heading.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return ".SH " + heading + "\n" + plain(footer.substr(colon + 2)) + "\n";
}

}  // namespace

std::string manual_page(const CommandTable& table) {
  const CommandEntry& program = table.front();
  const std::string version(core::build_info().version);
  std::string page = ".TH DUALDAMP 1 \"\" \"dualdamp " + plain(version) + "\" \"User Commands\"\n";
  page += ".SH NAME\ndualdamp \\- simulate vibrations with friction and identify friction from them\n";
  page += ".SH SYNOPSIS\n.B dualdamp\n" + italic("COMMAND") + " [OPTIONS] " + italic("ARGUMENT") + "...\n";
  page += ".SH DESCRIPTION\n" + plain(program.text) + "\n.PP\n";
  page += "Results go to standard output and to files, messages to standard error. ";
  page += plain("A quantity is a number and its unit: '6.17 Hz', '0.2 N/mm'.\n");
  page += ".SH OPTIONS\n" + options_of(program) + ".SH COMMANDS\n";
  for (const CommandEntry& command : table)
    if (!command.name.empty() && command.commands.empty()) page += command_section(command);
  if (!program.footer.empty()) page += footer_section(program.footer);
  page += ".SH ENVIRONMENT\n.TP\n.B DUALDAMP_PLUGINS\nLibraries with friction laws to load, colons between them.\n";
  page += ".SH FILES\nScenario files are described by the page that\n.B dualdamp schema \\-\\-markdown\nprints.\n";
  return page;
}

}  // namespace dualdamp::cli
