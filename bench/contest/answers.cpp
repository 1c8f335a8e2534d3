#include "bench/contest/answers.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/units.hpp"
#include "core/utf8.hpp"
#include "scenarios/format/json_text.hpp"

namespace dualdamp::bench {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 28U;

/// Without the quotation marks around it.
std::string unquoted(std::string_view text) {
  text = core::trimmed(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(unquoted(field));
  if (line.ends_with(',')) fields.emplace_back();
  return fields;
}

/// A number as programs write it in CSV: also +4, .5 and 000001.
std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = end == text.data() + text.size();
  return code == std::errc() && is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The columns of a file of answers.
constexpr std::array<std::string_view, 9> column_names = {"case",   "zeta",    "F0",      "zeta_low", "zeta_high",
                                                          "F0_low", "F0_high", "p_value", "usable"};
enum class Column : std::size_t { number, zeta, F0, zeta_low, zeta_high, F0_low, F0_high, p_value, usable };

/// Reads a file of answers line by line.
class EntryReader {
 public:
  EntryReader(std::string path, const Key& key, Entry& entry) : path_(std::move(path)), key_(key), entry_(entry) {}

  void read() {
    std::istringstream text(scenarios::read_file(path_, most_bytes));
    std::vector<bool> seen(key_.numbers.size(), false);
    bool has_header = false;
    for (std::string line; std::getline(text, line);) {
      ++line_;
      if (line.starts_with(core::byte_order_mark)) line.erase(0, core::byte_order_mark.size());
      if (core::trimmed(line).empty() || line.starts_with('#')) continue;
      if (!std::exchange(has_header, true)) {
        read_header(fields_of(line));
        continue;
      }
      const std::vector<std::string> fields = fields_of(line);
      if (fields.size() != columns_.size())
        core::refuse(here(), "the row has another number of fields than the header",
                     std::to_string(columns_.size()), std::to_string(fields.size()));
      read_row(fields, seen);
    }
    if (!has_header) core::refuse({.file = path_}, "the file holds no header", core::joined(column_names));
  }

 private:
  [[nodiscard]] core::SourcePlace here() const { return {.file = path_, .line = line_}; }

  void read_header(const std::vector<std::string>& fields) {
    for (const std::string& field : fields) {
      const auto known = std::ranges::find(column_names, field);
      if (known == column_names.end())
        core::refuse(here(), "there is no column of this name in a file of answers", core::joined(column_names),
                     field);
      const auto column = static_cast<Column>(known - column_names.begin());
      if (std::ranges::find(columns_, column) != columns_.end())
        core::refuse(here(), "a column is there twice", "distinct columns", field);
      columns_.push_back(column);
    }
    if (std::ranges::find(columns_, Column::number) == columns_.end())
      core::refuse(here(), "the column 'case' is missing", core::joined(column_names));
  }

  /// NaN for an empty field, `nan`, `NA` or `none`.
  [[nodiscard]] double value(const std::string& text, Column column) const {
    if (text.empty() || text == "nan" || text == "NaN" || text == "NA" || text == "none") return not_stated;
    const std::optional<double> number = number_of(text);
    if (!number)
      core::refuse(here(), "'" + std::string(column_names.at(static_cast<std::size_t>(column))) + "' is no number",
                   "a number; nothing, nan, NA or none for no value", text);
    // Larger numbers would overflow in products, and a motion with such damping cannot be computed.
    if (std::abs(*number) > core::most_magnitude)
      core::refuse(here(), "a number is too large to compute with", "-1e60 to 1e60", text);
    if (column == Column::p_value && !(*number >= 0.0 && *number <= 1.0))
      core::refuse(here(), "'p_value' is out of range", "0 to 1", text);
    return *number;
  }

  [[nodiscard]] CaseAnswer::Usable usable_of(const std::string& text) const {
    using enum CaseAnswer::Usable;
    if (text.empty()) return missing;
    std::string lower = text;
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const char* word : {"1", "true", "yes"})
      if (lower == word) return yes;
    for (const char* word : {"0", "false", "no"})
      if (lower == word) return no;
    core::refuse(here(), "'usable' says neither yes nor no",
                 "1, true, yes, 0, false, no in small or capital letters, or nothing", text);
  }

  void read_row(const std::vector<std::string>& fields, std::vector<bool>& seen) {
    CaseAnswer answer;
    double file = 0.0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::array<double*, 8> places = {
          &file,           &answer.zeta,   &answer.F0, answer.zeta95.data(), &answer.zeta95[1], answer.F095.data(),
          &answer.F095[1], &answer.p_value};
      if (columns_[i] == Column::usable)
        answer.usable = usable_of(fields[i]);
      else
        *places.at(static_cast<std::size_t>(columns_[i])) = value(fields[i], columns_[i]);
    }
    const auto most = static_cast<double>(key_.numbers.size());
    if (!(file >= 1.0 && file <= most && file == std::floor(file)))
      core::refuse(here(), "there is no such case", "1 to " + std::to_string(key_.numbers.size()),
                   core::format_number(file, 9));
    for (const auto& interval : {answer.zeta95, answer.F095}) {
      if (std::isnan(interval[0]) != std::isnan(interval[1]))
        core::refuse(here(), "an interval has one end", "both ends, or none");
      if (interval[0] > interval[1])
        core::refuse(here(), "an interval ends below its start", "low <= high",
                     core::format_number(interval[0]) + " > " + core::format_number(interval[1]));
    }
    const auto place = static_cast<std::size_t>(file) - 1;
    if (seen[place]) core::refuse(here(), "case " + std::to_string(place + 1) + " is answered twice");
    seen[place] = true;
    entry_.answers[key_.numbers[place]] = answer;
  }

  std::string path_;
  const Key& key_;
  Entry& entry_;
  std::vector<Column> columns_;
  int line_ = 0;
};

}  // namespace

Entry read_entry(const std::string& name, const std::string& path, const Key& key) {
  Entry entry{name, std::vector<CaseAnswer>(key.numbers.size())};
  EntryReader(path, key, entry).read();
  return entry;
}

}  // namespace dualdamp::bench
