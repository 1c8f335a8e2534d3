#pragma once
/// The command line as values. Only arguments.cpp and command_table.cpp know the library that parses it.

#include <string>
#include <variant>
#include <vector>

#include "cli/command_table.hpp"

namespace dualdamp::cli {

struct RunCommand {
  std::vector<std::string> files;
  std::string out;
  std::vector<std::string> set;
  int jobs = 0;  ///< threads, shared by files that run at the same time; 0: one file at a time, on all cores
  bool json = false;
  bool quiet = false;
  bool dry_run = false;
  bool resume = false;
  bool overwrite = false;
  bool verify = false;      ///< compute every result again in another way
  std::string plot;         ///< SVG file for the main chart; empty: none
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

/// `stress export`: records for programs outside.
struct ExportCommand {
  std::string file;
  std::string out;
  std::string seed;  ///< of all draws; empty: one that nobody can guess
  std::vector<std::string> set;
  int jobs = 0;
};

/// `stress score`: their answers beside those of the methods.
struct ScoreCommand {
  std::string file;
  std::string key;
  std::vector<std::string> answers;  ///< NAME=FILE
  std::string out;
  std::vector<std::string> set;
  bool json = false;
  bool quiet = false;
  int jobs = 0;
};

struct CheckCommand {
  std::vector<std::string> files;
};

struct LawsCommand {
  std::string name;
  bool check = false;  ///< whether it keeps the law contract
  std::vector<std::string> set;
  std::string stroke = "0.1 m";
  std::string stroke_time = "0.5 s";
};

struct MethodsCommand {
  std::string name;
};

struct AnalysesCommand {
  std::string name;
};

struct SchemaCommand {
  bool markdown = false;
};

struct CompletionCommand {
  std::string shell;
};

struct ManualCommand {};

/// What data files do not say of themselves.
struct FileOptions {
  std::vector<std::string> units;    ///< x=mm
  std::vector<std::string> columns;  ///< x=LVDT 2
  std::vector<std::string> scales;   ///< x=2.5 mm/V
  std::string decimal;
  bool no_header = false;
};

struct IdentifyCommand : FileOptions {
  std::string data;
  std::string mass, stiffness, gravity_stiffness, coordinate, frequency;
  std::vector<std::string> methods;
  std::vector<std::string> gain_uncertainties;  ///< x=1 %
  std::string sigma_x, sigma_Y;
  bool robust = false;
  std::string out;
  bool json = false;
  bool quiet = false;
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

/// What to measure next, after data or a scenario.
struct NextCommand : FileOptions {
  std::string data;  ///< a data file, or a scenario
  std::string mass, stiffness, frequency;
  std::vector<std::string> gain_uncertainties;  ///< x=1 %
  std::string sigma_x, sigma_Y;
  std::string out;
  bool json = false;
  bool quiet = false;
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

struct FitCommand : FileOptions {
  std::string law;  ///< several with commas
  std::vector<std::string> data;
  std::vector<std::string> validate;
  std::string free;
  std::string mass, stiffness, damping, frequency, amplitude;
  std::vector<std::string> sigmas;  ///< x=0.02 mm
  std::vector<std::string> set;
  int starts = 0;
  bool loop = false;
  bool robust = false;
  bool no_profile = false;
  std::string out;
  bool json = false;
  bool quiet = false;
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

struct PredictCommand : FileOptions {
  std::string result;  ///< of a fit: result.json, or its directory
  std::vector<std::string> data;
  std::string frequency, amplitude;
  std::vector<std::string> sigmas;
  std::vector<std::string> set;
  bool loop = false;
  std::string out;
  bool json = false;
  bool quiet = false;
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

struct ReportCommand {
  std::vector<std::string> directories;
  std::string plot;         ///< SVG file for the main chart; empty: none
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

struct NewCommand {
  std::string analysis;
};

struct CompareCommand {
  std::vector<std::string> directories;  ///< two or more
  std::string out = "compare";
  std::string shown_units;  ///< of charts, pages and what is printed, with commas
};

/// Nothing to do but to print and leave: help, version, or a wrong command line.
struct Leave {
  std::string message;
  int status = 0;
  bool json = false;  ///< the caller wanted JSON
};

using Command =
    std::variant<RunCommand, ExportCommand, ScoreCommand, CheckCommand, LawsCommand, MethodsCommand,
                 AnalysesCommand, SchemaCommand, CompletionCommand, ManualCommand, IdentifyCommand, NextCommand,
                 FitCommand, PredictCommand, ReportCommand, CompareCommand, NewCommand, Leave>;

/// A command line.
struct Call {
  Command command;
  std::vector<std::string> plugins;  ///< libraries to load before the command is executed
  double isolation = 0.0;            ///< seconds that a child process has for the command; 0: no child
  bool json = false;                 ///< the caller wants JSON
};

/// Plugins are those that the environment variable DUALDAMP_PLUGINS names, colons between them, then those of
/// `--plugin`, wherever it stands.
[[nodiscard]] Call parse(int argc, const char* const* argv);

/// What `parse` accepts.
[[nodiscard]] CommandTable command_table();

}  // namespace dualdamp::cli
