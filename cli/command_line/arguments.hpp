#pragma once
/// The command line as values. Only arguments.cpp, command_table.cpp and shared_options.cpp use the library that
/// parses it.

#include <string>
#include <variant>
#include <vector>

#include "cli/shell/command_table.hpp"

namespace dualdamp::cli {

/// Where results go, and how they are printed.
struct OutputOptions {
  std::string out;
  bool json = false;
  bool quiet = false;
};

struct ShownUnitOptions {
  std::string shown_units;  ///< of charts, pages and printed tables, separated by commas
};

/// Files that are written beside a result; empty: none.
struct ResultFiles {
  std::string plot;  ///< SVG: the main chart
  std::string mat;   ///< MATLAB: the tables
};

struct RunCommand : OutputOptions, ShownUnitOptions, ResultFiles {
  std::vector<std::string> files;
  std::vector<std::string> set;
  int jobs = 0;  ///< number of threads; with several files, how many run at the same time; 0: one file, all cores
  bool dry_run = false;
  bool resume = false;
  bool overwrite = false;
  bool verify = false;  ///< compute each result again in another way and compare
};

/// The stress test that `stress export` and `stress score` have in common.
struct StressOptions {
  std::string file;
  std::vector<std::string> set;
  int jobs = 0;
};

/// `stress export`: writes records for other programs.
struct ExportCommand : StressOptions {
  std::string out;
  std::string seed;        ///< of all random numbers; empty: a hidden random one
  bool overwrite = false;  ///< the files of an earlier export
};

/// `stress score`: scores answers of other programs beside the methods.
struct ScoreCommand : StressOptions, OutputOptions {
  std::string key;
  std::vector<std::string> answers;  ///< NAME=FILE
};

struct CheckCommand {
  std::vector<std::string> files;
};

struct LawsCommand {
  std::string name;
  bool check = false;  ///< test whether the law keeps its contract
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

/// Statements about a data file that the file does not make itself.
struct FileOptions {
  std::vector<std::string> column_units;  ///< x=mm
  std::vector<std::string> columns;       ///< x=LVDT 2
  std::vector<std::string> scales;        ///< x=2.5 mm/V
  std::string decimal;
  bool no_header = false;
  std::string sample_rate;  ///< of a file without times
};

/// What `identify` and `next` take of a data file and its rig.
struct MeasuredOptions : FileOptions, OutputOptions, ShownUnitOptions {
  std::string data;
  std::string mass, stiffness, frequency;
  std::vector<std::string> gain_uncertainties;  ///< x=1 %
  std::string sigma_x, sigma_Y;
};

struct IdentifyCommand : MeasuredOptions {
  std::string gravity_stiffness, coordinate;
  std::vector<std::string> methods;
  bool robust = false;
};

/// `next`: what to measure next, for a data file or, as `data`, a scenario.
struct NextCommand : MeasuredOptions {
  std::string most_level, most_frequency;  ///< of the drive
};

/// What `fit` and `predict` take of their records.
struct RecordOptions : FileOptions, OutputOptions, ShownUnitOptions {
  std::vector<std::string> data;
  std::string frequency, amplitude;
  std::vector<std::string> sigmas;  ///< x=0.02 mm
  std::vector<std::string> set;
  bool loop = false;
  std::string drive;  ///< y or force
};

struct FitCommand : RecordOptions {
  std::string law;  ///< one law, or several separated by commas
  std::vector<std::string> validate;
  std::string free;
  std::string mass, stiffness, damping;
  int starts = 0;
  bool robust = false;
  bool no_profile = false;
};

struct PredictCommand : RecordOptions {
  std::string result;  ///< of a fit: result.json, or its directory
};

struct ReportCommand : ShownUnitOptions, ResultFiles {
  std::vector<std::string> directories;
};

struct NewCommand {
  std::string analysis;
};

struct CompareCommand : ShownUnitOptions {
  std::vector<std::string> directories;  ///< two or more
  std::string out = "compare";
};

/// Print a message and end: help, version, or a wrong command line.
struct Leave {
  std::string message;
  int status = 0;
  bool json = false;  ///< whether the caller asked for JSON
  std::string help;   ///< the command line that prints what is allowed
};

using Command =
    std::variant<RunCommand, ExportCommand, ScoreCommand, CheckCommand, LawsCommand, MethodsCommand,
                 AnalysesCommand, SchemaCommand, CompletionCommand, ManualCommand, IdentifyCommand, NextCommand,
                 FitCommand, PredictCommand, ReportCommand, CompareCommand, NewCommand, Leave>;

/// A command line.
struct Call {
  Command command;
  std::vector<std::string> plugins;  ///< libraries to load before the command is executed
  double isolation = 0.0;            ///< time limit of the child process for the command [s]; 0: no child process
  bool json = false;                 ///< whether the caller asked for JSON
};

/// Parses a command line. `plugins` holds those of the environment variable DUALDAMP_PLUGINS, separated by colons,
/// then those of each `--plugin`, which may be before or after the command.
[[nodiscard]] Call parse(int argc, const char* const* argv);

/// The commands and options that `parse` accepts.
[[nodiscard]] CommandTable command_table();

}  // namespace dualdamp::cli
