#include "identify/readers/record_reader.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "core/provenance.hpp"
#include "identify/readers/data_table.hpp"
#include "identify/readers/formats/csv_reader.hpp"
#include "identify/readers/formats/mat_reader.hpp"
#include "identify/readers/formats/mat_structure.hpp"
#include "identify/readers/formats/universal_file_reader.hpp"
#include "identify/readers/record_assembly.hpp"
#include "identify/readers/text.hpp"

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
constexpr std::array<Foreign, 9> foreign_formats = {
    {{"PK\x03\x04"sv, "the file is a workbook or an archive (zip)", "the sheet saved as CSV"},
     {"\xD0\xCF\x11\xE0"sv, "the file is an old Excel workbook", "the sheet saved as CSV"},
     {"\x1F\x8B"sv, "the file is compressed (gzip)", "the file unpacked"},
     {"TDSm"sv, "the file is a LabVIEW TDMS file", "the channels saved as CSV, .mat or universal file"},
     {"\x89HDF"sv, "the file is HDF5, but no MATLAB file", "a file saved by MATLAB with -v7.3"},
     {"%PDF"sv, "the file is a PDF document", "the data as CSV"},
     {"\x7F\x45LF"sv, "the file is a program", "a data file"},
     {"<"sv, "the file is a page of the web, or XML", "the data as CSV"},
     {"{"sv, "the file is JSON", "the data as CSV"}}};

/// A file that cannot be a data file, such as an endless device, is not read to its end.
void refuse_at_sight(std::string_view beginning, const std::string& name) {
  for (const Foreign& format : foreign_formats)
    if (beginning.starts_with(format.magic))
      refuse_file(name, std::string(format.message), std::string(format.advice));
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
  if (fs::is_directory(path, error)) refuse_file(name, "cannot be read: it is a directory, not a file");
  if (const auto size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
      !error && size > largest_file)
    refuse_file(name, "the file is larger than 1 GiB: " + std::to_string(size >> 20U) + " MiB",
                "fewer rows or columns; a record of 20 million rows fits");
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) refuse_file(name, "cannot be opened: " + std::generic_category().message(errno));
  std::string bytes;
  std::array<char, sample_size> buffer{};
  LineLength line;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    bytes.append(buffer.data(), count);
    if (bytes.size() > largest_file) refuse_file(name, "the file is larger than 1 GiB");
    if (bytes.size() <= sample_size) refuse_at_sight(bytes, name);
    line.add({buffer.data(), count});
    if (line.is_too_long() && !is_mat(bytes) && !is_universal_file(bytes))
      refuse_file(name, "a line has more than a million characters", "a row of numbers for each reading");
  }
  if (std::ferror(file.get()) != 0) refuse_file(name, "cannot be read: " + std::generic_category().message(errno));
  return bytes;
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
    refuse_file(options.name, "a MATLAB file cannot be read from a pipe", "the name of a file");
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
           "the columns that were read: " + core::joined(there, ", "),
           column + "=" + text,
           {}});
    }
}

/// Range of the numbers: their squares, and their products with the constants of a rig, must be finite.
void check_magnitudes(const DataTable& table, Problems& problems) {
  constexpr double least = 1e-60;
  constexpr double most = 1e60;
  for (const DataColumn& column : table.columns) {
    std::size_t at = 0;
    double largest = 0.0;
    for (std::size_t row = 0; row < column.values.size(); ++row)
      if (const double size = std::abs(column.values[row]); size > largest) {
        largest = size;
        at = row;
      }
    if (largest == 0.0 || (largest >= least && largest <= most)) continue;
    core::Diagnostic problem = table.show(at, *column.known);
    problem.message = "the largest number of column " + std::string(column.known->name) + " is too " +
                      (largest > most ? "large" : "small") + " to compute with";
    problem.allowed = "1e-60 to 1e60 in SI, or only zeros";
    problems.add(std::move(problem));
  }
}

MeasuredRecord assemble(TableFile file, const ReadOptions& options, Problems& problems,
                        std::vector<std::string> warnings) {
  refuse_unused(file, options, problems);
  check_magnitudes(file.table, problems);
  MeasuredRecord result;
  result.warnings = std::move(warnings);
  result.units = file.table.units;
  result.ignored = file.table.ignored;
  result.record = record_of(std::move(file.table), options.is_imposed, problems, result.warnings);
  problems.throw_if_any();
  result.sha256 = std::move(file.sha256);
  return result;
}

void check_times(const DataTable& table, Problems& problems) {
  const std::vector<double>& t = table.find("t")->values;
  std::vector<std::size_t> faults;
  for (std::size_t row = 1; row < t.size(); ++row)
    if (!(t[row] > t[row - 1])) faults.push_back(row);
  if (faults.empty()) return;
  const std::size_t row = faults.front();
  core::Diagnostic problem = table.show(row, *known_column("t"));
  problem.message =
      t[row] == t[row - 1] ? "the time does not increase: it appears twice" : "the time does not increase";
  problem.allowed = "a time after the row above";
  problems.add(std::move(problem), faults.size() - 1, {});
}

/// The signal from a table that was read with the option `only`.
MeasuredSignal signal_of(TableFile file, std::string_view column, const std::string& name, Problems& problems) {
  problems.throw_if_any();
  for (const std::string_view wanted : {std::string_view("t"), column})
    if (file.table.find(wanted) == nullptr)
      refuse_file(name, "there is no column " + std::string(wanted),
                  "a column of that name, or a statement of its name in the file");
  if (file.table.sweeps.size() > 1 || !file.table.restarts.empty())
    refuse_file(name, "the file holds several tests", "one signal over its times");
  if (file.table.rows() < 2)
    refuse_file(name, "the signal has too few samples", "two or more", std::to_string(file.table.rows()));
  check_times(file.table, problems);
  check_magnitudes(file.table, problems);
  problems.throw_if_any();
  MeasuredSignal result;
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
  MeasuredSignal signal = signal_of(std::move(file), column, chosen.name, problems);
  signal.warnings = std::move(warnings);
  return signal;
}

MeasuredSignal parse_signal(std::string_view text, std::string_view column, const ReadOptions& options) {
  const ReadOptions chosen = with_only(column, options);
  Problems problems;
  std::vector<std::string> warnings;
  TableFile file = parse_table(text, chosen, problems, warnings);
  MeasuredSignal signal = signal_of(std::move(file), column, chosen.name, problems);
  signal.warnings = std::move(warnings);
  return signal;
}

}  // namespace dualdamp::identify
