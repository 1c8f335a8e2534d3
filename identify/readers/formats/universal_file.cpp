#include "identify/readers/formats/universal_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/diagnostics.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify::universal_file {

namespace {

constexpr std::size_t most_values = 20'000'000;

/// Characters [from, from + width) of a line, without blanks at the ends. Fewer if the line is shorter.
std::string_view cut(std::string_view line, std::size_t from, std::size_t width) {
  return from < line.size() ? trimmed(line.substr(from, width)) : std::string_view{};
}

/// A text of the file. The format writes NONE for no text.
std::string text_of(std::string_view field) { return field == "NONE" ? std::string() : to_utf8(field); }

template <typename Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Fortran writes 1.0D+00 for double precision.
std::optional<double> parse_real(std::string_view text) {
  if (text.find_first_of("Dd") == std::string_view::npos) return parse<double>(text);
  std::string exponent(text);
  std::replace_if(exponent.begin(), exponent.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  return parse<double>(exponent);
}

/// Factors of data set 164; none if the file has no such data set.
struct FileUnits {
  std::optional<double> length;
  std::optional<double> force;

  [[nodiscard]] std::optional<double> divisor(int quantity) const {
    constexpr int displacement = 8;
    constexpr int reaction = 9;
    constexpr int velocity = 11;
    constexpr int acceleration = 12;
    constexpr int excitation = 13;
    switch (quantity) {
      case displacement:
      case velocity:
      case acceleration:
        return length;
      case reaction:
      case excitation:
        return force;
      default:
        return std::nullopt;
    }
  }
};

/// Reads the text, one data set after the other.
class Scanner {
 public:
  Scanner(std::string_view text, std::string file, std::vector<std::string>& warnings)
      : text_(text), file_(std::move(file)), warnings_(warnings) {}

  std::vector<Function> run() {
    std::vector<Function> functions;
    while (!at_end()) {
      if (trimmed(next_line()) != "-1" || at_end()) continue;
      const std::string_view head = next_line();
      const std::string_view number = cut(head, 0, 6);
      if (number == "58") {
        if (auto function = function_58(head)) functions.push_back(std::move(*function));
      } else if (number == "164") {
        read_units();
      }
      // The mark at the end of a data set that was read or skipped.
      while (!at_end() && trimmed(peek_line()) != "-1") next_line();
      if (!at_end()) next_line();
    }
    return functions;
  }

 private:
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }

  [[nodiscard]] std::string_view peek_line() const {
    std::string_view line = text_.substr(at_, text_.find('\n', at_) - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  std::string_view next_line() {
    const std::string_view line = at_end() ? std::string_view{} : peek_line();
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    ++line_;
    return line;
  }

  [[noreturn]] void refuse(std::string message, std::string allowed = {}, std::string found = {}) const {
    core::refuse({.file = file_, .line = line_}, std::move(message), std::move(allowed), std::move(found));
  }

  template <typename Number>
  Number field(std::string_view line, std::size_t from, std::size_t width) const {
    const std::string_view text = cut(line, from, width);
    if constexpr (std::is_integral_v<Number>) {
      if (const auto value = parse<Number>(text)) return *value;
    } else {
      if (const auto value = parse_real(text); value && std::isfinite(*value)) return *value;
    }
    refuse("the record of the data set cannot be read: no number in columns " + std::to_string(from + 1) + " to " +
               std::to_string(from + width),
           "fixed columns as in the format's description", "'" + to_utf8(text) + "'");
  }

  Axis axis(std::string_view line) const {
    return {field<int>(line, 0, 10), text_of(cut(line, 26, 20)), text_of(cut(line, 47, 20))};
  }

  void read_units() {
    next_line();  // the record with system and description
    const std::string_view line = next_line();
    units_.length = field<double>(line, 0, 25);
    units_.force = field<double>(line, 25, 25);
    if (*units_.length <= 0.0 || *units_.force <= 0.0) refuse("the factors of data set 164 are not positive");
  }

  /// Nothing for a function that is not over time.
  std::optional<Function> function_58(std::string_view head) {
    Function f;
    f.line = line_;
    f.title = text_of(trimmed(next_line()));
    for (int i = 0; i < 4; ++i) next_line();
    const std::string_view dof = next_line();
    f.type = field<int>(dof, 0, 5);
    f.entity = text_of(cut(dof, 31, 10));
    f.place = text_of(cut(dof, 41, 14));
    read_form(f, next_line());
    f.abscissa = axis(next_line());
    f.ordinate = axis(next_line());
    for (int i = 0; i < 2; ++i) next_line();
    f.divisor = units_.divisor(f.ordinate.quantity);
    constexpr int time_response = 1;
    constexpr int time_axis = 17;
    const bool is_time =
        (f.type == time_response || f.type == 0) && (f.abscissa.quantity == time_axis || f.abscissa.quantity == 0);
    const bool is_binary = head.size() > 6 && head[6] == 'b';
    if (!is_time) {
      if (is_binary) at_ = std::min(text_.size(), at_ + field<std::size_t>(head, 31, 12));
      warnings_.push_back("the data set at line " + std::to_string(f.line) +
                          " is not a time response (function type " + std::to_string(f.type) + ") and is ignored");
      return std::nullopt;
    }
    if (f.is_complex) refuse("the time response holds complex numbers", "real numbers");
    if (is_binary)
      read_binary(f, head);
    else
      read_text(f);
    return f;
  }

  void read_form(Function& f, std::string_view line) {
    constexpr int real_single = 2;
    constexpr int real_double = 4;
    constexpr int complex_double = 6;
    const int kind = field<int>(line, 0, 10);
    if (kind < real_single || kind > complex_double || kind == 3)
      refuse("there is no ordinate data type " + std::to_string(kind), "2, 4, 5, 6");
    f.is_complex = kind > real_double;
    f.is_double = kind % 2 == 0 && kind != real_single;
    const int count = field<int>(line, 10, 10);
    if (count < 1) refuse("the data set holds no values");
    f.count = static_cast<std::size_t>(count);
    if (f.count > most_values) refuse("the data set holds more than 20 million values");
    f.is_even = field<int>(line, 20, 10) == 1;
    f.start = field<double>(line, 30, 13);
    f.step = field<double>(line, 43, 13);
    if (f.is_even && f.step <= 0.0) refuse("the step of the abscissa is not positive", "a step above zero");
  }

  /// Reserves memory for the stated number of values, but not for more than the file can hold.
  void reserve(Function& f) const {
    const std::size_t values = std::min(f.count, text_.size() - std::min(at_, text_.size()));
    f.values.reserve(values);
    if (!f.is_even) f.times.reserve(values);
  }

  void read_text(Function& f) {
    constexpr std::size_t single_width = 13;  // E13.5
    constexpr std::size_t double_width = 20;  // E20.12
    reserve(f);
    const std::size_t width = f.is_double ? double_width : single_width;
    std::string_view line;
    std::size_t at = 0;
    const auto next = [&](std::size_t columns) {
      while (cut(line, at, columns).empty()) {
        if (at_end() || trimmed(peek_line()) == "-1")
          refuse("the data set ends after " + std::to_string(f.values.size()) + " of " + std::to_string(f.count) +
                 " values");
        line = next_line();
        at = 0;
      }
      const double value = field<double>(line, at, columns);
      at += columns;
      return value;
    };
    while (f.values.size() < f.count) {
      if (!f.is_even) f.times.push_back(next(single_width));  // with values of any precision
      f.values.push_back(next(width));
    }
    const std::string_view ahead = at_end() ? "-1" : trimmed(peek_line());
    if (!cut(line, at, width).empty() || !(ahead.empty() || ahead == "-1"))
      refuse("the data set continues after its " + std::to_string(f.count) + " values");
  }

  void read_binary(Function& f, std::string_view head) {
    constexpr int little = 1;
    constexpr int big = 2;
    constexpr int ieee = 2;
    const int order = field<int>(head, 7, 6);
    if (order != little && order != big) refuse("there is no byte order " + std::to_string(order), "1, 2");
    if (field<int>(head, 13, 6) != ieee) refuse("the numbers are not in IEEE floating point", "format 2");
    const auto bytes = field<std::size_t>(head, 31, 12);
    const std::size_t width = f.is_double ? sizeof(double) : sizeof(float);
    const std::size_t wanted = f.count * (width + (f.is_even ? 0 : sizeof(float)));
    if (bytes < wanted || text_.size() - at_ < wanted)
      refuse("the data set ends before its " + std::to_string(f.count) + " values",
             std::to_string(wanted) + " bytes", std::to_string(std::min(bytes, text_.size() - at_)) + " bytes");
    reserve(f);
    const bool swap = (order == little) != (std::endian::native == std::endian::little);
    const char* from = text_.data() + at_;
    const auto next = [&](std::size_t size) {
      std::array<char, sizeof(double)> raw{};
      std::copy_n(from, size, raw.begin());
      from += size;
      if (swap) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
      if (size == sizeof(float)) {
        float value = 0.0F;
        std::memcpy(&value, raw.data(), size);
        return static_cast<double>(value);
      }
      return std::bit_cast<double>(raw);
    };
    for (std::size_t i = 0; i < f.count; ++i) {
      if (!f.is_even) f.times.push_back(next(sizeof(float)));
      f.values.push_back(next(width));
      if (!std::isfinite(f.values.back()))
        refuse("value " + std::to_string(i + 1) + " of the data set is not a finite number");
    }
    at_ += bytes;
  }

  std::string_view text_;
  std::string file_;
  std::vector<std::string>& warnings_;
  std::size_t at_ = 0;
  int line_ = 0;
  FileUnits units_;
};

}  // namespace

std::optional<std::size_t> lines_above_data_set(std::string_view text) {
  constexpr std::size_t most_lines = 200;
  constexpr std::string_view mark = "    -1";
  std::optional<std::size_t> first;
  bool follows_mark = false;
  for (std::size_t line = 0; line < most_lines && !text.empty(); ++line) {
    const std::string_view now = text.substr(0, text.find('\n'));
    const std::string_view number = now.substr(0, 7);  // in six columns; `b` behind it for binary numbers
    if (follows_mark && (number == "    58" || number == "    58b" || number == "    58 " || number == "    58\r"))
      return first;
    follows_mark = now.starts_with(mark) && now.find_first_not_of(" \t\r", mark.size()) == std::string_view::npos;
    if (follows_mark && !first) first = line;
    text.remove_prefix(std::min(now.size() + 1, text.size()));
  }
  return std::nullopt;
}

bool begins_data_set(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  text.remove_prefix(first);
  if (!text.starts_with("-1")) return false;
  text.remove_prefix(2);
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || text.find_first_not_of(" \t\r") != end) return false;
  const std::string_view number = cut(text.substr(end + 1), 0, 6);
  return !number.empty() && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<Function> time_responses(std::string_view text, const std::string& file,
                                     std::vector<std::string>& warnings) {
  return Scanner(text, file, warnings).run();
}

}  // namespace dualdamp::identify::universal_file
