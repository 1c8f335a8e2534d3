#pragma once
/// Splits the text of a CSV file into lines and fields. The reader interprets them.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "identify/readers/text.hpp"

namespace dualdamp::identify {

struct SourceLine {
  std::string_view text;  ///< without its line end
  int number = 0;
};

/// The lines of a text, one after the other. Line ends are LF, CRLF or, in a text without LF, CR.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    if (text.find('\n') == std::string_view::npos) end_mark_ = '\r';
    // Blank lines at the end are no rows.
    text_ = text_.substr(0, text_.find_last_not_of(" \t\r\n") + 1);
  }

  [[nodiscard]] bool at_end() const { return start_ >= text_.size(); }

  SourceLine next() {
    const std::size_t end = std::min(text_.find(end_mark_, start_), text_.size());
    std::string_view line = text_.substr(start_, end - start_);
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    start_ = end + 1;
    return {line, ++number_};
  }

  /// Number of lines that are left.
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

/// The separator of a header: the first of tab, semicolon, comma and blank that it has; a comma if it has none.
[[nodiscard]] char separator_of(std::string_view header);

/// The fields of a line from left to right. A field in double quotes may hold the separator, and two quotes for
/// one. A blank as separator means any number of blanks and tabs.
class Fields {
 public:
  Fields(std::string_view line, char separator)
      : line_(separator == ' ' ? trimmed(line) : line), separator_(separator), ends_(1, separator) {
    if (separator == ' ') ends_ += '\t';
    if (!line_.empty()) offset_ = static_cast<int>(line_.data() - line.data());
  }

  /// False when there is no further field.
  bool next() {
    if (done_) return false;
    const bool tabs = separator_ == '\t';
    while (at_ < line_.size() && (line_[at_] == ' ' || (line_[at_] == '\t' && !tabs))) ++at_;
    column = static_cast<int>(at_) + 1 + offset_;
    if (at_ < line_.size() && line_[at_] == '"') {
      read_quoted();
    } else {
      const std::size_t end = end_of_field();
      text = trimmed(line_.substr(at_, end - at_));
      at_ = end;
    }
    done_ = at_ >= line_.size();
    ++at_;
    return true;
  }

  std::string_view text;     ///< valid until the next call
  int column = 1;            ///< where the content begins, from 1
  bool is_unclosed = false;  ///< a quoted field had no closing quote

 private:
  void read_quoted();
  [[nodiscard]] std::size_t end_of_field() const;

  std::string_view line_;
  char separator_;
  std::string ends_;
  int offset_ = 0;
  std::size_t at_ = 0;
  bool done_ = false;
  std::string unquoted_;
};

/// Largest number of columns of a file.
inline constexpr std::size_t most_columns = 1000;

/// The fields of a line, at most `most_columns` + 1. A field with an unclosed quote is taken as it is.
[[nodiscard]] std::vector<std::string> fields_of(std::string_view line, char separator);

}  // namespace dualdamp::identify
