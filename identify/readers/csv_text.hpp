#pragma once
/// The text of a CSV file taken apart: lines, fields, headings and the digits of its numbers. What they mean is
/// said by the reader.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace dualdamp::identify {

/// Without blanks and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

struct SourceLine {
  std::string_view text;  ///< without its line end
  int number = 0;
};

/// Lines of a text one after the other, whose ends are LF, CRLF or (where there is no LF at all) CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    if (text.find('\n') == std::string_view::npos) end_mark_ = '\r';
    // Blank lines at the end are no rows.
    text_ = text_.substr(0, text_.find_last_not_of(" \t\r\n") + 1);
  }

  [[nodiscard]] bool at_end() const { return start_ >= text_.size(); }

  /// Cuts off the rows at the end that hold separators only: so spreadsheets write rows that were emptied.
  void drop_empty_rows(char separator) {
    const std::string blanks{' ', '\t', '\r', '\n', separator};
    const std::size_t last = std::min(text_.find_last_not_of(blanks), text_.size());
    text_ = text_.substr(0, text_.find(end_mark_, last));
  }

  SourceLine next() {
    const std::size_t end = std::min(text_.find(end_mark_, start_), text_.size());
    std::string_view line = text_.substr(start_, end - start_);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    start_ = end + 1;
    return {line, ++number_};
  }

  /// Lines still to come.
  [[nodiscard]] std::size_t count() const {
    if (at_end()) return 0;
    return static_cast<std::size_t>(
               std::count(text_.begin() + static_cast<std::ptrdiff_t>(start_), text_.end(), end_mark_)) +
           1;
  }

 private:
  std::string_view text_;
  std::size_t start_ = 0;
  int number_ = 0;
  char end_mark_ = '\n';
};

/// The separator that stands in the header: a tab, else a semicolon, else a comma.
[[nodiscard]] char separator_of(std::string_view header);

/// The fields of a line from left to right; one in double quotes may hold the separator, and a quote as two quotes.
class Fields {
 public:
  Fields(std::string_view line, char separator) : line_(line), separator_(separator) {}

  /// False when there is no further field.
  bool next() {
    if (done_) return false;
    const bool tabs = separator_ == '\t';
    while (at_ < line_.size() && (line_[at_] == ' ' || (line_[at_] == '\t' && !tabs))) ++at_;
    column = static_cast<int>(at_) + 1;
    if (at_ < line_.size() && line_[at_] == '"') {
      read_quoted();
    } else {
      const std::size_t end = std::min(line_.find(separator_, at_), line_.size());
      text = trimmed(line_.substr(at_, end - at_));
      at_ = end;
    }
    done_ = at_ >= line_.size();
    ++at_;
    return true;
  }

  std::string_view text;     ///< valid until the next call
  int column = 1;            ///< where the content begins, from 1
  bool is_unclosed = false;  ///< a quoted field did not end with its quote

 private:
  void read_quoted();

  std::string_view line_;
  char separator_;
  std::size_t at_ = 0;
  bool done_ = false;
  std::string unquoted_;
};

/// "x [mm]" or "x (mm)" taken apart.
struct Heading {
  std::string text;  ///< the whole of it
  std::string name;
  std::string unit;
  int column = 1;
  bool well_formed = true;
};
[[nodiscard]] Heading parse_heading(std::string_view text, int column);

/// Significant digits and the place of the last one of a decimal number, written with or without exponent.
struct Digits {
  int significant = 0;
  int decimals = 0;  ///< of the last digit: 3 means thousandths
};
[[nodiscard]] Digits digits_of(std::string_view text);

}  // namespace dualdamp::identify
