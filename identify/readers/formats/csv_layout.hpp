#pragma once
/// Where the header and the rows of a CSV file begin: behind blocks of other lines that instruments write above,
/// with comments, units in a row of their own, and blanks, commas, semicolons or tabs between the fields.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identify/readers/formats/csv_text.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// The rows of data one after the other. Left out: blank lines, comments, rows of empty fields, and the header
/// where it stands there again, as in files put together from several.
class Rows {
 public:
  Rows(Lines lines, char separator, std::string_view header, std::vector<std::string_view> below_header)
      : lines_(lines), separator_(separator), header_(header), below_header_(std::move(below_header)) {}

  [[nodiscard]] std::optional<SourceLine> next();

  /// The header stood between the last row and the one before it.
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

struct Layout {
  char separator = ',';
  SourceLine header = {};                ///< number 0: the file has none
  std::optional<SourceLine> units = {};  ///< a row of units below the header
  std::vector<std::string_view> below_header =
      {};                       ///< lines between the header and the first row, units among them
  Lines lines = Lines({});      ///< at the first row
  std::size_t lines_above = 0;  ///< left out above the header, without comments and blank lines
  bool is_headless = false;     ///< the first line is a row of numbers, as the caller says or as it looks

  [[nodiscard]] Rows rows() const { return {lines, separator, header.text, below_header}; }
};

[[nodiscard]] Layout layout_of(std::string_view text, const ReadOptions& options);

/// The unit in a field of the row of units: "mm", "[mm]", "(mm)"; empty for none.
[[nodiscard]] std::string unit_in(std::string_view field);

}  // namespace dualdamp::identify
