#pragma once
/// Options that several commands have.

#include <functional>
#include <string>
#include <vector>

#include "cli/command_line/arguments.hpp"

namespace CLI {
class App;
}

namespace dualdamp::cli {

/// Adds `--out`, `--json` and `--quiet`.
void add_output_options(CLI::App& command, OutputOptions& options);
/// Adds `--show-in`: units of charts, pages and printed tables. `--unit` is that of a column of a data file.
void add_shown_units(CLI::App& command, ShownUnitOptions& options);
void add_result_files(CLI::App& command, ResultFiles& files);
/// Adds `--gain-uncertainty`.
void add_gains(CLI::App& command, std::vector<std::string>& gains);
/// Adds the options that state names, units and scales of the columns of a data file.
void add_file_options(CLI::App& command, FileOptions& options);
/// Adds `--loop` and `--drive`: what kind of motions the records of a fit are.
void add_record_kind(CLI::App& command, bool& loop, std::string& drive);

/// The check of a whole number from 1 to `most`. CLI11 would also take 0x2, +2 and " 2".
[[nodiscard]] std::function<std::string(const std::string&)> whole_number(int most);

/// Refuses empty arguments (files, laws, values of options) of this command and of its commands. An unset variable
/// of a shell gives an empty argument, which would be taken as no statement.
void refuse_empty_texts(CLI::App& command);

}  // namespace dualdamp::cli
