#include "cli/shell/completion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/analyses.hpp"
#include "friction_models/registry.hpp"
#include "identify/methods.hpp"

namespace dualdamp::cli {

namespace {

/// The words that are possible at one place of the command line.
struct Choices {
  enum class Kind { anything, words, files, directories } kind = Kind::anything;
  std::vector<std::string> list = {};  ///< the words; or the extensions of files, empty for any file
};

/// The choices for a placeholder, which has the same meaning in all commands.
Choices choices_of(const std::string& placeholder) {
  using enum Choices::Kind;
  Choices named{words};
  if (placeholder == "LAW") {
    for (const friction::LawEntry& law : friction::laws()) named.list.emplace_back(law.name);
  } else if (placeholder == "METHOD") {
    for (const identify::MethodEntry& method : identify::methods()) named.list.emplace_back(method.name);
  } else if (placeholder == "ANALYSIS") {
    for (const scenarios::Analysis* analysis : bench::analyses()) named.list.emplace_back(analysis->name);
  } else if (placeholder.find('|') != std::string::npos) {
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
      end = placeholder.find('|', begin);
      named.list.push_back(placeholder.substr(begin, end - begin));
    }
  }
  if (!named.list.empty()) return named;
  if (placeholder == "SCENARIO") return {files, {"yaml", "yml"}};
  if (placeholder == "LIB") return {files, {"so"}};
  if (placeholder == "DIR") return {directories};
  if (placeholder == "FILE" || placeholder == "DATA" || placeholder == "RESULT") return {files};
  return {anything};
}

std::string separated_by(const std::vector<std::string>& words, const std::string& separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

/// The first clause of a help text, for the list that the shell shows.
std::string brief(const std::string& text) {
  return text.substr(0, std::min({text.find("; "), text.find(": "), text.find(", such as"), text.find(" (")}));
}

/// The text in single quotes of a shell.
std::string quoted(const std::string& text, const std::string& quote_inside) {
  std::string inside;
  for (const char c : text) inside += c == '\'' ? quote_inside : std::string(1, c);
  return "'" + inside + "'";
}

/// "command:word" for each command of a command: "stress:export".
std::vector<std::string> steps(const CommandTable& table) {
  std::vector<std::string> all;
  for (const CommandEntry& command : table)
    for (const std::string& name : command.commands) all.push_back(command.name + ":" + name);
  return all;
}

/// Options whose value is the next word.
std::vector<std::string> options_with_value(const CommandTable& table) {
  std::vector<std::string> all;
  for (const CommandEntry& command : table)
    for (const OptionEntry& option : command.options)
      if (!option.is_positional && !option.placeholder.empty() && std::ranges::find(all, option.name) == all.end())
        all.push_back(option.name);
  return all;
}

/// Calls `visit(place, option)` for each positional argument. The place of the first one is "fit:0"; that of a
/// repeatable one is "fit:*".
template <typename Visit>
void for_positionals(const CommandEntry& command, Visit visit) {
  int position = 0;
  for (const OptionEntry& option : command.options)
    if (option.is_positional)
      visit(command.name + ":" + (option.is_repeatable ? "*" : std::to_string(position++)), option);
}

// ----------------------------------------------------------------------------------------------------------------
// bash

constexpr std::string_view bash_begin = R"(# Completion of dualdamp for bash; written by: dualdamp completion bash

# Proposes words, directories, or files with an ending.
_dualdamp_propose() {
  local ending
  case $1 in
    words) # of a list with commas, the last one
      mapfile -t COMPREPLY < <(compgen -P "${word%"${word##*,}"}" -W "$2" -- "${word##*,}")
      ;;
    directories)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      ;;
    files)
      compopt -o filenames 2>/dev/null
      if [[ -z $2 ]]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
      else
        mapfile -t COMPREPLY < <(compgen -d -- "$word"; for ending in $2; do compgen -f -X "!*.$ending" -- "$word"; done)
      fi
      ;;
  esac
}

_dualdamp() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command='' position=0 i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case $command:${COMP_WORDS[i]} in
)";

std::string bash_proposal(const Choices& choices) {
  switch (choices.kind) {
    case Choices::Kind::words:
      return "_dualdamp_propose words '" + separated_by(choices.list, " ") + "'";
    case Choices::Kind::directories:
      return "_dualdamp_propose directories";
    case Choices::Kind::files:
      return "_dualdamp_propose files '" + separated_by(choices.list, " ") + "'";
    case Choices::Kind::anything:
      break;
  }
  return ":";
}

std::string bash_script(const CommandTable& table) {
  std::string script(bash_begin);
  script += "      " + separated_by(steps(table), " | ") +
            ") command=${command:+$command }${COMP_WORDS[i]} position=0 ;;\n";
  script += "      *:" + separated_by(options_with_value(table), " | *:") + ") ((++i)) ;;\n";
  script += "      *:-*) ;;\n      *) ((++position)) ;;\n    esac\n  done\n  case $command:$before in\n";
  std::string names;
  std::string positionals;
  for (const CommandEntry& command : table) {
    std::vector<std::string> own;
    for (const OptionEntry& option : command.options) {
      if (option.is_positional) continue;
      own.push_back(option.name);
      if (!option.placeholder.empty())
        script += "    " + quoted(command.name + ":" + option.name, "") + ") " +
                  bash_proposal(choices_of(option.placeholder)) + "; return ;;\n";
    }
    names += "      '" + command.name + "') _dualdamp_propose words '" + separated_by(own, " ") + "' ;;\n";
    if (!command.commands.empty())
      positionals += "    '" + command.name + "':0) _dualdamp_propose words '" +
                     separated_by(command.commands, " ") + "' ;;\n";
    for_positionals(command, [&](const std::string& place, const OptionEntry& option) {
      const std::size_t colon = place.find(':');
      positionals += "    '" + place.substr(0, colon) + "'" + place.substr(colon) + ") " +
                     bash_proposal(choices_of(option.placeholder)) + " ;;\n";
    });
  }
  script += "  esac\n  if [[ $word == -* ]]; then\n    case $command in\n" + names + "    esac\n    return\n  fi\n";
  return script + "  case $command:$position in\n" + positionals + "  esac\n}\ncomplete -F _dualdamp dualdamp\n";
}

// -----------------------------------------------------------------------------------------------------------------
// zsh

/// Escapes the characters that have a meaning in a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view(R"(\[]:)").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string zsh_action(const Choices& choices) {
  switch (choices.kind) {
    case Choices::Kind::words:
      return "(" + separated_by(choices.list, " ") + ")";
    case Choices::Kind::directories:
      return "_files -/";
    case Choices::Kind::files:
      return choices.list.empty() ? "_files" : "_files -g \"*." + separated_by(choices.list, " *.") + "\"";
    case Choices::Kind::anything:
      break;
  }
  return " ";
}

std::string zsh_option(const OptionEntry& option) {
  std::string spec;
  if (option.is_positional)
    spec = (option.is_repeatable ? "*:" : ":") + zsh_text(option.name) + ":" +
           zsh_action(choices_of(option.placeholder));
  else {
    spec = (option.is_repeatable ? "*" : "") + option.name + "[" + zsh_text(brief(option.text)) + "]";
    if (!option.placeholder.empty())
      spec += ":" + zsh_text(option.placeholder) + ":" + zsh_action(choices_of(option.placeholder));
  }
  return " \\\n    " + quoted(spec, "'\\''");
}

std::string zsh_function_name(const std::string& command) {
  std::string name = "_dualdamp" + (command.empty() ? "" : "_" + command);
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::string zsh_function(const CommandTable& table, const CommandEntry& command) {
  const bool has_commands = !command.commands.empty();
  std::string text = zsh_function_name(command.name) + "() {\n";
  if (has_commands)
    text += "  local context state state_descr line curcontext=$curcontext\n  typeset -A opt_args\n";
  text += has_commands ? "  _arguments -C" : "  _arguments";
  for (const OptionEntry& option : command.options) text += zsh_option(option);
  if (!has_commands) return text + "\n}\n\n";
  text +=
      " \\\n    '1: :->command' '*:: :->arguments'\n  case $state in\n    command)\n      local -a commands=(\n";
  std::string cases;
  for (const std::string& name : command.commands) {
    const std::string full = command.name.empty() ? name : command.name + " " + name;
    const auto entry = std::ranges::find(table, full, &CommandEntry::name);
    text += "        " + quoted(name + ":" + brief(entry->text), "'\\''") + "\n";
    cases += "        " + name + ") " + zsh_function_name(full) + " ;;\n";
  }
  text += "      )\n      _describe command commands\n      ;;\n    arguments)\n      case $line[1] in\n";
  return text + cases + "      esac\n      ;;\n  esac\n}\n\n";
}

std::string zsh_script(const CommandTable& table) {
  std::string script =
      "#compdef dualdamp\n# Completion of dualdamp for zsh; written by: dualdamp completion zsh\n\n";
  for (const CommandEntry& command : table) script += zsh_function(table, command);
  // The script may be a file of $fpath, which is the function itself, or be sourced.
  return script +
         "if [[ $funcstack[1] == _dualdamp ]]; then\n  _dualdamp \"$@\"\nelse\n  compdef _dualdamp dualdamp\nfi\n";
}

// ----------------------------------------------------------------------------------------------------------------
// fish

std::string fish_choices(const Choices& choices) {
  switch (choices.kind) {
    case Choices::Kind::words:
      return " -x -a '" + separated_by(choices.list, " ") + "'";
    case Choices::Kind::directories:
      return " -x -a '(__fish_complete_directories)'";
    case Choices::Kind::files:
      if (choices.list.empty()) return " -r -F";
      return " -x -a '(__dualdamp_files " + separated_by(choices.list, " ") + ")'";
    case Choices::Kind::anything:
      break;
  }
  return " -x";
}

constexpr std::string_view fish_begin = R"(# Completion of dualdamp for fish; written by: dualdamp completion fish

# Directories, and files with one of these endings.
function __dualdamp_files
    __fish_complete_directories (commandline -ct)
    set -l files (commandline -ct)*.$argv
    printf '%s\n' $files
end

# Whether the words so far lead to this place: a command and the number of its arguments.
function __dualdamp_at
    set -l command ''
    set -l position 0
    set -l is_value no
    set -l words (commandline -opc)
    for word in $words[2..-1]
        if test $is_value = yes
            set is_value no
            continue
        end
        switch "$command:$word"
)";

std::string fish_script(const CommandTable& table) {
  std::string script(fish_begin);
  script += "            case '" + separated_by(steps(table), "' '") + "'\n";
  script += "                set command (string trim -- \"$command $word\")\n                set position 0\n";
  script += "            case '*:" + separated_by(options_with_value(table), "' '*:") +
            "'\n                set is_value yes\n";
  script += "            case '*:-*'\n            case '*'\n                set position (math $position + 1)\n";
  script +=
      "        end\n    end\n    string match -q -- $argv[1] \"$command:$position\"\nend\n\ncomplete -c dualdamp "
      "-f\n";
  const auto at = [](const std::string& place) {
    return "complete -c dualdamp -n '__dualdamp_at \"" + place + "\"'";
  };
  for (const CommandEntry& command : table) {
    for (const std::string& name : command.commands) {
      const auto entry =
          std::ranges::find(table, command.name.empty() ? name : command.name + " " + name, &CommandEntry::name);
      script += at(command.name + ":0") + " -a " + name + " -d " + quoted(brief(entry->text), "\\'") + "\n";
    }
    for_positionals(command, [&](const std::string& place, const OptionEntry& option) {
      const Choices choices = choices_of(option.placeholder);
      if (choices.kind != Choices::Kind::anything) script += at(place) + fish_choices(choices) + "\n";
    });
    for (const OptionEntry& option : command.options) {
      if (option.is_positional) continue;
      script += at(command.name + ":*") + " -l " + option.name.substr(2) +
                (option.placeholder.empty() ? "" : fish_choices(choices_of(option.placeholder))) + " -d " +
                quoted(brief(option.text), "\\'") + "\n";
    }
  }
  return script;
}

}  // namespace

std::string completion_script(std::string_view shell, const CommandTable& table) {
  if (shell == "bash") return bash_script(table);
  return shell == "zsh" ? zsh_script(table) : fish_script(table);
}

}  // namespace dualdamp::cli
