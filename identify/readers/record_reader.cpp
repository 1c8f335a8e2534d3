#include "identify/readers/record_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "core/input_file.hpp"
#include "core/numbers.hpp"
#include "core/provenance.hpp"
#include "identify/readers/data_table.hpp"
#include "identify/readers/formats/csv_reader.hpp"
#include "identify/readers/formats/mat_reader.hpp"
#include "identify/readers/formats/mat_structure.hpp"
#include "identify/readers/formats/universal_file_reader.hpp"
#include "identify/readers/record_assembly.hpp"
#include "identify/readers/text.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = std::size_t{1} << 30U;
/// Number of first bytes that suffice to recognise the type of a file.
constexpr std::size_t sample_size = std::size_t{1} << 16U;
/// Thousands of columns. Each field of a longer line would be copied and searched several times.
constexpr std::size_t longest_line = std::size_t{1} << 20U;

/// The first bytes of files of other types, and what the user should do.
struct Foreign {
  std::string_view magic;
  std::string_view message;
  std::string_view advice;
};

using namespace std::string_view_literals;
constexpr std::array<Foreign, 15> foreign_formats = {
    {{"PK\x03\x04"sv, "the file is a workbook or an archive (zip)", "the sheet saved as CSV"},
     {"\xD0\xCF\x11\xE0"sv, "the file is an old Excel workbook", "the sheet saved as CSV"},
     {"\x1F\x8B"sv, "the file is compressed (gzip)", "the file unpacked"},
     {"\x28\xB5\x2F\xFD"sv, "the file is compressed (zstd)", "the file unpacked"},
     {"\xFD\x37\x7A\x58\x5A"sv, "the file is compressed (xz)", "the file unpacked"},
     {"7z\xBC\xAF"sv, "the file is an archive (7z)", "the file unpacked"},
     {"RIFF"sv, "the file is a sound or a video (RIFF, WAV)", "the samples with their times as CSV or .mat"},
     {"PAR1"sv, "the file is a Parquet table", "the table as CSV"},
     {"\x93NUMPY"sv, "the file is a NumPy array", "the array saved by numpy.savetxt or scipy.io.savemat"},
     {"TDSm"sv, "the file is a LabVIEW TDMS file", "the channels saved as CSV, .mat or universal file"},
     {"\x89HDF"sv, "the file is HDF5, but no MATLAB file", "a file saved by MATLAB with -v7.3"},
     {"%PDF"sv, "the file is a PDF document", "the data as CSV"},
     {"\x7F\x45LF"sv, "the file is a program", "a data file"},
     {"<"sv, "the file is a page of the web, or XML", "the data as CSV"},
     {"{"sv, "the file is JSON", "the data as CSV"}}};

/// What follows blank lines and comments.
std::string_view content_of(std::string_view beginning) {
  while (beginning.starts_with('#') || beginning.starts_with('\n') || beginning.starts_with('\r'))
    beginning.remove_prefix(std::min(beginning.find('\n'), beginning.size() - 1) + 1);
  return beginning;
}

/// A file that cannot be a data file, such as an endless device, is not read to its end.
void refuse_at_sight(std::string_view beginning, const std::string& name) {
  for (const Foreign& format : foreign_formats)
    if (beginning.starts_with(format.magic))
      core::refuse({.file = name}, std::string(format.message), std::string(format.advice));
  if (content_of(beginning).starts_with("schema: dualdamp/"))
    core::refuse({.file = name}, "the file is a scenario", "a data file; 'dualdamp run' takes a scenario");
  const bool is_binary = beginning.find('\0') != std::string_view::npos;
  if (is_binary && !is_mat(beginning) && !is_universal_file(beginning) && !is_utf16(beginning))
    refuse_binary(beginning, name);
}

/// Finds long lines in the pieces of a text.
class LineLength {
 public:
  void add(std::string_view piece) {
    const std::size_t end = piece.find_last_of("\r\n");
    length_ = end == std::string_view::npos ? length_ + piece.size() : piece.size() - end - 1;
  }
  [[nodiscard]] bool is_too_long() const { return length_ > longest_line; }

 private:
  std::size_t length_ = 0;
};

/// All bytes of a file or a pipe.
std::string load(const std::string& path, const std::string& name) {
  std::error_code error;
  if (fs::is_directory(path, error)) core::refuse({.file = name}, "cannot be read: it is a directory, not a file");
  if (const auto size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
      !error && size > largest_file)
    core::refuse({.file = name}, "the file is larger than 1 GiB: " + std::to_string(size >> 20U) + " MiB",
                 "fewer rows or columns; a record of 20 million rows fits");
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) core::fail_to_read(name, "cannot be opened", errno);
  std::string bytes;
  std::array<char, sample_size> buffer{};
  LineLength line;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    bytes.append(buffer.data(), count);
    if (bytes.size() > largest_file) core::refuse({.file = name}, "the file is larger than 1 GiB");
    if (bytes.size() <= sample_size) refuse_at_sight(bytes, name);
    line.add({buffer.data(), count});
    if (line.is_too_long() && !is_mat(bytes) && !is_universal_file(bytes))
      core::refuse({.file = name}, "a line has more than a million characters",
                   "a row of numbers for each reading");
  }
  if (std::ferror(file.get()) != 0) core::fail_to_read(name, "cannot be read", errno);
  return bytes;
}

/// Refuses what is stated about the text of a CSV file and would be ignored here. `format`: of the file.
void refuse_statements_on_text(const ReadOptions& options, const std::string& format) {
  const auto refuse = [&](core::Setting setting, const std::string& value) {
    core::refuse({.file = options.name},
                 options.words(setting, {}, value) + " is stated, and the file is " + format,
                 "no such statement: it is about the text of a CSV file");
  };
  if (options.decimal != '.') refuse(core::Setting::decimal, std::string(1, options.decimal));
  if (options.no_header) refuse(core::Setting::no_header, {});
}

/// The columns of a data file of any format.
struct TableFile {
  DataTable table;
  std::shared_ptr<const std::string> text;  ///< quoted in messages; null for a binary file
  std::string sha256;                       ///< of the bytes
};

TableFile parse_table(std::string_view text, const ReadOptions& options, Problems& problems,
                      std::vector<std::string>& warnings) {
  refuse_at_sight(text.substr(0, sample_size), options.name);
  TableFile file{.table = {}, .text = nullptr, .sha256 = core::sha256(text)};
  if (is_universal_file(text)) {
    refuse_statements_on_text(options, "a universal file");
    file.table = parse_universal_file(text, options, problems, warnings);
    return file;
  }
  file.text = std::make_shared<const std::string>(decoded(text, options.name, warnings));
  file.table = parse_csv(*file.text, options, problems, warnings);
  return file;
}

TableFile read_table(const std::string& path, const ReadOptions& options, Problems& problems,
                     std::vector<std::string>& warnings) {
  const std::string bytes = load(path, options.name);
  if (!is_mat(bytes)) return parse_table(bytes, options, problems, warnings);
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    core::refuse({.file = options.name}, "a MATLAB file cannot be read from a pipe", "the name of a file");
  refuse_statements_on_text(options, "a MATLAB file");
  check_mat(bytes, options.name);
  return {read_mat(path, options, problems, warnings), nullptr, core::sha256(bytes)};
}

/// Refuses units and scales of columns that the file does not have: they would be ignored.
void refuse_unused(const TableFile& file, const ReadOptions& options, Problems& problems) {
  for (const auto& [option, map] : {std::pair{"unit", &options.units}, {"scale", &options.scales}})
    for (const auto& [column, text] : *map) {
      const KnownColumn* known = known_column(column);
      if (known == nullptr || file.table.columns.empty() || file.table.find(known->name) != nullptr) continue;
      std::vector<std::string> there;
      for (const DataColumn& found : file.table.columns) there.emplace_back(found.known->name);
      problems.add(
          {{options.name, 0, 0, {}},
           std::string("a ") + option + " is stated for column " + column + ", and the file has no such column",
           "the columns that were read: " + core::joined(there) + "; or one of another name, as " +
               options.words(core::Setting::column, column, "NAME"),
           column + "=" + text,
           {}});
    }
}

void check_magnitudes(const DataTable& table, Problems& problems) {
  for (const DataColumn& column : table.columns) {
    std::size_t at = 0;
    double largest = 0.0;
    for (std::size_t row = 0; row < column.values.size(); ++row)
      if (const double size = std::abs(column.values[row]); size > largest) {
        largest = size;
        at = row;
      }
    if (largest == 0.0 || (largest >= core::least_magnitude && largest <= core::most_magnitude)) continue;
    core::Diagnostic problem = table.show(at, *column.known);
    problem.message = "the largest number of column " + std::string(column.known->name) + " is too " +
                      (largest > core::most_magnitude ? "large" : "small") + " to compute with";
    problem.allowed = std::string(core::magnitude_range) + " in SI, or only zeros";
    problems.add(std::move(problem));
  }
}

/// Samples of a file without times get those of the stated rate.
void add_stated_times(DataTable& table, const ReadOptions& options) {
  if (options.sample_rate == 0.0 || table.columns.empty()) return;
  for (const auto& [name, what] : {std::pair{"t", "times t"}, {"Y", "amplitudes Y, which are no samples"}})
    if (table.find(name) != nullptr)
      core::refuse(
          {.file = options.name},
          options.words(core::Setting::sample_rate, {}, core::format_number(options.sample_rate, 6) + " Hz") +
              " is stated, and the file has " + what,
          "no such statement, or a file of samples without times");
  add_times(table, options.sample_rate);
}

MeasuredRecord assemble(TableFile file, const ReadOptions& options, Problems& problems,
                        std::vector<std::string> warnings) {
  refuse_unused(file, options, problems);
  check_magnitudes(file.table, problems);
  add_stated_times(file.table, options);
  MeasuredRecord result;
  result.warnings = std::move(warnings);
  result.units = file.table.units;
  result.ignored = file.table.ignored;
  result.record = record_of(std::move(file.table), options, problems, result.warnings);
  problems.throw_if_any();
  result.sha256 = std::move(file.sha256);
  return result;
}

/// A few steps of time that are much longer than the others. Times of a signal need not be even.
void warn_of_gaps(const std::vector<double>& t, std::vector<std::string>& warnings) {
  constexpr std::size_t fewest = 16;
  constexpr double most_gaps = 0.05;
  if (t.size() < fewest) return;
  std::vector<double> steps;
  for (std::size_t row = 1; row < t.size(); ++row) steps.push_back(t[row] - t[row - 1]);
  const double usual = upper_median(steps);
  constexpr double even = 0.1;
  constexpr double long_of_even = 1.5;
  constexpr double long_of_others = 4.0;
  const auto others =
      std::ranges::count_if(steps, [&](double step) { return !(std::abs(step - usual) <= even * usual); });
  const auto many = static_cast<std::ptrdiff_t>(most_gaps * static_cast<double>(steps.size()));
  const double longest = (others <= many ? long_of_even : long_of_others) * usual;
  const auto gaps = std::ranges::count_if(steps, [longest](double step) { return step > longest; });
  if (gaps == 0 || gaps > many) return;
  const auto widest = static_cast<std::size_t>(std::ranges::max_element(steps) - steps.begin());
  constexpr int digits = 6;
  const auto time = [&](std::size_t row) { return core::format_number(t[row], digits); };
  warnings.push_back("the samples have " + std::to_string(gaps) + (gaps == 1 ? " gap" : " gaps, the longest") +
                     " from t = " + time(widest) + " s to " + time(widest + 1) + " s, " +
                     core::format_number(steps[widest] / usual, 3) +
                     " usual steps: a drive is interpolated across it");
}

/// The signal from a table that was read with the option `only`.
MeasuredSignal signal_of(TableFile file, std::string_view column, const ReadOptions& options, Problems& problems,
                         std::vector<std::string> warnings) {
  problems.throw_if_any();
  add_stated_times(file.table, options);
  for (const std::string_view wanted : {std::string_view("t"), column})
    if (file.table.find(wanted) == nullptr)
      core::refuse({.file = options.name}, "there is no column " + std::string(wanted),
                   "a column of that name, or a statement of its name in the file" +
                       (wanted == "t" ? "; or " + options.words(core::Setting::sample_rate, {}, "...") : ""));
  if (file.table.sweeps.size() > 1 || !file.table.restarts.empty())
    core::refuse({.file = options.name}, "the file holds several tests", "one signal over its times");
  if (file.table.rows() < 2)
    core::refuse({.file = options.name}, "the signal has too few samples", "two or more",
                 std::to_string(file.table.rows()));
  check_increasing(file.table, 0, file.table.rows(), problems);
  check_magnitudes(file.table, problems);
  problems.throw_if_any();
  warn_of_gaps(file.table.find("t")->values, warnings);
  MeasuredSignal result;
  result.warnings = std::move(warnings);
  result.sha256 = std::move(file.sha256);
  for (DataColumn& found : file.table.columns) {
    if (found.known->name == "t") result.times = std::move(found.values);
    if (found.known->name == column) result.values = std::move(found.values);
  }
  return result;
}

ReadOptions with_only(std::string_view column, const ReadOptions& options) {
  ReadOptions chosen = options;
  chosen.only = {"t", std::string(column)};
  return chosen;
}

}  // namespace

MeasuredRecord parse_record(std::string_view text, const ReadOptions& options) {
  Problems problems;
  std::vector<std::string> warnings;
  TableFile file = parse_table(text, options, problems, warnings);
  return assemble(std::move(file), options, problems, std::move(warnings));
}

MeasuredRecord parse_record(std::string_view text, const std::string& name) {
  return parse_record(text, ReadOptions{.name = name});
}

MeasuredRecord read_record(const std::string& path, const ReadOptions& options) {
  ReadOptions named = options;
  if (named.name.empty()) named.name = path;
  Problems problems;
  std::vector<std::string> warnings;
  TableFile file = read_table(path, named, problems, warnings);
  return assemble(std::move(file), named, problems, std::move(warnings));
}

MeasuredSignal read_signal(const std::string& path, std::string_view column, const ReadOptions& options) {
  ReadOptions chosen = with_only(column, options);
  if (chosen.name.empty()) chosen.name = path;
  Problems problems;
  std::vector<std::string> warnings;
  TableFile file = read_table(path, chosen, problems, warnings);
  return signal_of(std::move(file), column, chosen, problems, std::move(warnings));
}

MeasuredSignal parse_signal(std::string_view text, std::string_view column, const ReadOptions& options) {
  const ReadOptions chosen = with_only(column, options);
  Problems problems;
  std::vector<std::string> warnings;
  TableFile file = parse_table(text, chosen, problems, warnings);
  return signal_of(std::move(file), column, chosen, problems, std::move(warnings));
}

}  // namespace dualdamp::identify
