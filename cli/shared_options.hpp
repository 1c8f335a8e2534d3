#pragma once
/// Options that several commands have.

#include <string>
#include <vector>

#include "cli/arguments.hpp"

namespace CLI {
class App;
}

namespace dualdamp::cli {

/// Where results go and what is printed.
void add_output_options(CLI::App& command, std::string& out, bool& json, bool& quiet);
/// Units of what is shown to people.
void add_units(CLI::App& command, std::string& units);
void add_plot(CLI::App& command, std::string& plot);
/// How well the gains of the sensors are known.
void add_gains(CLI::App& command, std::vector<std::string>& gains);
/// What a data file does not say of itself.
void add_file_options(CLI::App& command, FileOptions& options);

/// Of this command and all below it: an empty name of a file, a law, ... names nothing, as a variable of a shell
/// that is not set does.
void refuse_empty_names(CLI::App& command);

}  // namespace dualdamp::cli
