#include "identify/readers/record_reader.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "core/provenance.hpp"
#include "identify/readers/csv_reader.hpp"
#include "identify/readers/data_table.hpp"
#include "identify/readers/mat_reader.hpp"
#include "identify/readers/mat_structure.hpp"
#include "identify/readers/record_assembly.hpp"
#include "identify/readers/text.hpp"
#include "identify/readers/universal_file_reader.hpp"

namespace dualdamp::identify {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_file = std::size_t{1} << 30U;
/// Enough of a file to tell what it is.
constexpr std::size_t sample_size = std::size_t{1} << 16U;

/// The first bytes of files that are no data files, and what to do about them.
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

/// What is no data file at all, such as an endless device, is not read to its end.
void refuse_at_sight(std::string_view beginning, const std::string& name) {
  for (const Foreign& format : foreign_formats)
    if (beginning.starts_with(format.magic))
      refuse_file(name, std::string(format.message), std::string(format.advice));
  const bool is_binary = beginning.find('\0') != std::string_view::npos;
  if (is_binary && !is_mat(beginning) && !is_universal_file(beginning) && !is_utf16(beginning))
    refuse_binary(beginning, name);
}

/// The bytes of a file, or of a pipe until its end.
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
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    bytes.append(buffer.data(), count);
    if (bytes.size() > largest_file) refuse_file(name, "the file is larger than 1 GiB");
    if (bytes.size() <= sample_size) refuse_at_sight(bytes, name);
  }
  if (std::ferror(file.get()) != 0) refuse_file(name, "cannot be read: " + std::generic_category().message(errno));
  return bytes;
}

MeasuredRecord assemble(DataTable table, Problems& problems, std::vector<std::string> warnings,
                        std::string_view bytes) {
  MeasuredRecord result;
  result.warnings = std::move(warnings);
  result.assumed = table.assumed;
  result.record = record_of(std::move(table), problems, result.warnings);
  problems.throw_if_any();
  result.sha256 = core::sha256(bytes);
  return result;
}

}  // namespace

MeasuredRecord parse_record(std::string_view text, const ReadOptions& options) {
  Problems problems;
  std::vector<std::string> warnings;
  refuse_at_sight(text.substr(0, sample_size), options.name);
  if (is_universal_file(text)) {
    DataTable table = parse_universal_file(text, options, problems, warnings);
    return assemble(std::move(table), problems, std::move(warnings), text);
  }
  const std::string utf8 = decoded(text, options.name, warnings);
  DataTable table = parse_csv(utf8, options, problems, warnings);
  return assemble(std::move(table), problems, std::move(warnings), text);
}

MeasuredRecord parse_record(std::string_view text, const std::string& name) {
  return parse_record(text, ReadOptions{.name = name});
}

MeasuredRecord read_record(const std::string& path, const ReadOptions& options) {
  ReadOptions named = options;
  if (named.name.empty()) named.name = path;
  const std::string bytes = load(path, named.name);
  if (!is_mat(bytes)) return parse_record(bytes, named);
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    refuse_file(named.name, "a MATLAB file cannot be read from a pipe", "the name of a file");
  Problems problems;
  std::vector<std::string> warnings;
  check_mat(bytes, named.name);
  DataTable table = read_mat(path, named, problems, warnings);
  return assemble(std::move(table), problems, std::move(warnings), bytes);
}

}  // namespace dualdamp::identify
