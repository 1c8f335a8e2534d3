#pragma once
/// The layout of a CSV file: the header and the first row below the lines that instruments write above them,
/// comments, a row of units, and the separator: blanks, commas, semicolons or tabs.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identify/readers/columns.hpp"
#include "identify/readers/formats/csv_text.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// The rows of data, one after the other. Blank lines, comments, rows of empty fields and repeated headers (several
/// files put together) are skipped.
class Rows {
 public:
  Rows(Lines lines, char separator, std::string_view header, std::vector<std::string_view> below_header)
      : lines_(lines), separator_(separator), header_(header), below_header_(std::move(below_header)) {}

  [[nodiscard]] std::optional<SourceLine> next();

  /// Whether the header was repeated between the last row and the one before it.
  [[nodiscard]] bool restarted() const { return restarted_; }
  [[nodiscard]] std::size_t empty_rows() const { return empty_rows_; }
  [[nodiscard]] std::size_t count() const { return lines_.count(); }

 private:
  Lines lines_;
  char separator_;
  std::string_view header_;
  std::vector<std::string_view> below_header_;
  bool restarted_ = false;
  std::size_t empty_rows_ = 0;
};

/// Number of lines that are searched for the header.
inline constexpr int most_header_lines = 10'000;

struct Layout {
  char separator = ',';
  SourceLine header = {};                ///< number 0: the file has none
  std::optional<SourceLine> units = {};  ///< a row of units below the header, or LabVIEW's labels above it
  std::string time_label = {};           ///< LabVIEW's label of the unit of X_Value; empty: seconds
  std::vector<std::string_view> below_header =
      {};                       ///< lines between the header and the first row, units among them
  Lines lines = Lines({});      ///< at the first row
  std::size_t lines_above = 0;  ///< skipped above the header; comments and blank lines do not count
  bool lines_left = false;      ///< the file has lines beyond those that were searched for a header
  bool is_headless = false;     ///< the first line is a row of numbers, stated by the caller or recognised

  [[nodiscard]] Rows rows() const { return {lines, separator, header.text, below_header}; }
};

[[nodiscard]] Layout layout_of(std::string_view text, const ReadOptions& options);

/// Whether `called` is the name of a heading without the unit behind it: `Weg` of `Weg in mm`, `Weg [mm]`,
/// `Weg_mm`.
[[nodiscard]] bool is_called_without_unit(Heading heading, std::string_view called, const KnownColumn& known);

/// Whether the caller states this heading for one of the columns, with or without its unit.
[[nodiscard]] bool is_asked_for(const Heading& heading, const ReadOptions& options);

/// The unit in a field of the row of units: "mm", "[mm]", "(mm)"; empty if the field has none.
[[nodiscard]] std::string unit_in(std::string_view field);

}  // namespace dualdamp::identify
