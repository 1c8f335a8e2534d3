#include "cli/command_line/shared_options.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <vector>

#include "core/numbers.hpp"
#include "scenarios/results/shown_units.hpp"

namespace dualdamp::cli {

void add_output_options(CLI::App& command, OutputOptions& options) {
  command.add_option("--out", options.out, "Directory for the results; created if missing")
      ->type_name("DIR")
      ->check([](const std::string& text) { return text.empty() ? "DIR is empty" : std::string(); });
  command.add_flag("--json", options.json, "Print one JSON document and nothing else");
  command.add_flag("--quiet", options.quiet, "Print only errors on stderr");
}

void add_shown_units(CLI::App& command, ShownUnitOptions& options) {
  const auto add = [&](const char* name, const char* text) {
    return command.add_option(name, options.shown_units, text)
        ->type_name("UNITS")
        ->check([](const std::string& list) {
          std::map<std::string, std::string> written;
          return scenarios::ask_for_units(list, written);
        });
  };
  CLI::Option* const show_in =
      add("--show-in",
          "Units of charts, pages and printed tables, separated by commas: --show-in mm,Hz; files stay in SI");
  // The name up to 0.1, one letter from --unit, the unit of a column: still read, but named nowhere.
  add("--units", "The same as --show-in")->group("")->excludes(show_in);
  // In place of the help's own text, which would name what the option excludes.
  show_in->option_text("UNITS");
}

void add_gains(CLI::App& command, std::vector<std::string>& gains) {
  command
      .add_option("--gain-uncertainty", gains,
                  "Standard uncertainty of a sensor's gain: --gain-uncertainty x='1 %'")
      ->allow_extra_args(false)
      ->type_name("SIGNAL=SHARE");
}

void add_result_files(CLI::App& command, ResultFiles& files) {
  const auto add = [&command](const char* name, std::string& file, const char* text, const std::string& ending) {
    command.add_option(name, file, text)->type_name("FILE" + ending)->check([ending](const std::string& value) {
      return value.ends_with(ending) ? std::string() : "'" + value + "' does not end in " + ending;
    });
  };
  add("--plot", files.plot, "Also draw the main chart into this SVG file", ".svg");
  add("--mat", files.mat, "Also write the tables into this MATLAB file", ".mat");
}

void add_file_options(CLI::App& command, FileOptions& options) {
  const auto add = [&command](const char* name, std::vector<std::string>& list, const char* text,
                              const char* type) {
    command.add_option(name, list, text)->allow_extra_args(false)->type_name(type);
  };
  add("--unit", options.column_units, "Unit of a column, if the file does not state it: --unit x=mm",
      "COLUMN=UNIT");
  add("--column", options.columns,
      "Name or number of a column in the file: --column x='LVDT 2'; in a .mat file also a field (run.x) or a part "
      "of a matrix ('data(:,2)')",
      "COLUMN=NAME");
  add("--scale", options.scales,
      "What the numbers of a column are multiplied by: --scale x='2.5 mm/V'; the sensitivity of a sensor, --scale "
      "a='100 mV/g'; or a plain factor, --scale force=35.15",
      "COLUMN=SCALE");
  command.add_option("--decimal", options.decimal, "Decimal mark of a CSV file, . or , (default: .)")
      ->type_name("MARK");
  command.add_flag("--no-header", options.no_header,
                   "The CSV file begins with numbers; --column t=1 --column x=2 say which column is which");
  command
      .add_option("--sample-rate", options.sample_rate, "Sample rate of a file that has no times, such as '1 kHz'")
      ->type_name("QUANTITY");
  command.footer(
      "Units are those of the file (x [mm], x (mm), x_mm, or a row of units below the names), else those of "
      "--unit, else\n"
      "SI with a warning. What files may look like, and what is refused: docs/data-files.md.");
}

void add_record_kind(CLI::App& command, bool& loop, std::string& drive) {
  CLI::Option* is_loop = command.add_flag(
      "--loop", loop, "The records are friction loops: the column force moves the mass along the measured motion");
  command
      .add_option("--drive", drive,
                  "What drove the histories: their column y, the motion of the base, or force; it says nothing of "
                  "files without this column")
      ->check(CLI::IsMember({"y", "force"}))
      ->excludes(is_loop)
      ->type_name("y|force");
}

std::function<std::string(const std::string&)> whole_number(int most) {
  return [most](const std::string& text) {
    const bool has_digits_only = text.find_first_not_of("0123456789") == std::string::npos;
    const double number = core::parse_number(text).value.value_or(0.0);
    if (has_digits_only && number >= 1.0 && number <= most) return std::string();
    return "'" + text + "' is no whole number from 1 to " + std::to_string(most);
  };
}

void refuse_empty_texts(CLI::App& command) {
  const auto is_blank = [](const std::string& text) { return text.find_first_not_of(" \t") == std::string::npos; };
  for (CLI::Option* option : command.get_options())
    option->check([is_blank](const std::string& text) { return is_blank(text) ? "it is empty" : std::string(); });
  for (CLI::App* inner : command.get_subcommands({})) refuse_empty_texts(*inner);
}

}  // namespace dualdamp::cli
