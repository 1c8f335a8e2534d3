#include "identify/readers/formats/csv_numbers.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <system_error>

#include "identify/readers/formats/csv_text.hpp"

namespace dualdamp::identify {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// The number in a text that std::from_chars can read completely.
std::optional<double> plain_number(std::string_view text, std::errc& fault) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  fault = end == text.data() + text.size() ? code : std::errc::invalid_argument;
  if (fault == std::errc::invalid_argument) return std::nullopt;
  return value;
}

/// The text as std::from_chars needs it: with a decimal point, and an exponent with E.
std::string respelled(std::string_view text, char decimal) {
  std::string number(text);
  std::ranges::replace(number, decimal, '.');
  const std::size_t exponent = number.find_first_of("Dd");
  if (exponent != std::string::npos && exponent > 0) number[exponent] = 'e';
  return number;
}

/// Why a text is no number, as specific as possible.
FieldNumber no_number(std::string_view text, char decimal) {
  const char other = decimal == ',' ? '.' : ',';
  const bool digits = std::ranges::any_of(text, is_digit);
  const bool has_other = text.find(other) != std::string_view::npos;
  const bool has_both = has_other && text.find(decimal) != std::string_view::npos;
  const bool grouped = has_both || text.find_first_of("'_ ") != std::string_view::npos;
  FieldNumber result;
  result.fault = "is not a number";
  result.allowed = "a decimal number";
  result.has_comma = digits && has_other && !has_both && decimal == '.';
  if (result.has_comma)
    result.allowed = "a decimal number with a point, not with a comma";
  else if (digits && has_other && !has_both)
    result.allowed = "a decimal number with a comma, the decimal mark that is stated, not with a point";
  else if (digits && std::isalpha(static_cast<unsigned char>(text.back())) != 0)
    result.allowed = "a decimal number; its unit belongs into the heading";
  else if (digits && grouped)
    result.allowed = "a decimal number without thousands separators";
  else if (digits && text.back() == '%')
    result.allowed = "a decimal number without percent sign";
  return result;
}

/// The integer of `least` to `most` digits from `at` on.
std::optional<int> whole(std::string_view text, std::size_t& at, std::size_t least, std::size_t most) {
  const std::size_t begin = at;
  int value = 0;
  while (at < text.size() && at - begin < most && is_digit(text[at])) value = 10 * value + (text[at++] - '0');
  if (at - begin < least) return std::nullopt;
  return value;
}

bool skip(std::string_view text, std::size_t& at, std::string_view marks) {
  if (at >= text.size() || marks.find(text[at]) == std::string_view::npos) return false;
  ++at;
  return true;
}

/// hh:mm or hh:mm:ss, with an optional fraction of the seconds.
std::optional<double> time_of_day(std::string_view text, std::size_t& at, char decimal) {
  const auto hours = whole(text, at, 1, 2);
  if (!hours || *hours > 24 || !skip(text, at, ":")) return std::nullopt;
  const auto minutes = whole(text, at, 2, 2);
  if (!minutes || *minutes > 59) return std::nullopt;
  double seconds = 0.0;
  if (skip(text, at, ":")) {
    const auto whole_seconds = whole(text, at, 2, 2);
    if (!whole_seconds || *whole_seconds > 60) return std::nullopt;
    seconds = *whole_seconds;
    const std::array<char, 2> decimals = {decimal, '.'};
    if (skip(text, at, {decimals.data(), decimals.size()})) {
      double digit = 0.1;
      for (; at < text.size() && is_digit(text[at]); ++at, digit /= 10.0) seconds += digit * (text[at] - '0');
    }
  }
  constexpr double hour = 3600.0;
  constexpr double minute = 60.0;
  return hour * *hours + minute * *minutes + seconds;
}

/// Days since 1970 for yyyy-mm-dd or yyyy/mm/dd; 0 for other dates, whose order of day and month is not known. For
/// these, a record over midnight is recognised by its times.
std::optional<int> date(std::string_view text) {
  constexpr std::string_view marks = "-/.";
  std::size_t at = 0;
  const auto first = whole(text, at, 1, 4);
  if (!first || !skip(text, at, marks)) return std::nullopt;
  const auto second = whole(text, at, 1, 2);
  if (!second || !skip(text, at, marks)) return std::nullopt;
  const auto third = whole(text, at, 1, 4);
  if (!third || at != text.size()) return std::nullopt;
  constexpr int least_year = 1000;
  if (*first < least_year) return 0;
  const std::chrono::year_month_day calendar(std::chrono::year(*first),
                                             std::chrono::month(static_cast<unsigned>(*second)),
                                             std::chrono::day(static_cast<unsigned>(*third)));
  if (!calendar.ok()) return std::nullopt;
  return static_cast<int>(std::chrono::sys_days(calendar).time_since_epoch().count());
}

/// The half of the day for a clock of twelve hours.
enum class Half { none, first, second };

/// Reads and removes the half of the day in "12:30:01 PM".
Half half_of_day(std::string_view& text) {
  if (text.size() < 3 || std::toupper(static_cast<unsigned char>(text.back())) != 'M') return Half::none;
  const auto letter = std::toupper(static_cast<unsigned char>(text[text.size() - 2]));
  if (letter != 'A' && letter != 'P') return Half::none;
  text = trimmed(text.substr(0, text.size() - 2));
  return letter == 'A' ? Half::first : Half::second;
}

/// Whether the rest after a time is Z, +hh:mm or empty. The offset is ignored, because it is the same in all rows.
bool is_zone(std::string_view text) {
  return text.empty() || text == "Z" ||
         (text.size() > 2 && (text[0] == '+' || text[0] == '-') &&
          std::ranges::all_of(text.substr(1), [](char c) { return is_digit(c) || c == ':'; }));
}

}  // namespace

FieldNumber read_field(std::string_view text, char decimal) {
  std::string_view number = text;
  if (number.size() > 1 && number[0] == '+' && number[1] != '-' && number[1] != '+') number.remove_prefix(1);
  std::errc fault{};
  std::optional<double> value;
  const bool respell = decimal != '.' || number.find_first_of("Dd") != std::string_view::npos;
  if (!respell)
    value = plain_number(number, fault);
  else if (decimal == '.' || number.find('.') == std::string_view::npos)
    value = plain_number(respelled(number, decimal), fault);
  if (!value) return no_number(text, decimal);
  if (std::isnan(*value))
    return {std::nullopt, "is not a finite number",
            "a number; leave out rows without a reading: gaps of times are found"};
  if (fault == std::errc::result_out_of_range || !std::isfinite(*value))
    return {std::nullopt, "is not a finite number", "a number of double precision"};
  return {value, {}, {}};
}

std::optional<Clock> read_clock(std::string_view text, char decimal) {
  Clock clock;
  const Half half = half_of_day(text);
  if (const std::size_t blank = text.find_first_of("T "); blank != std::string_view::npos) {
    const auto days = date(text.substr(0, blank));
    if (!days) return std::nullopt;
    clock.days = *days;
    text = trimmed(text.substr(blank + 1));
  }
  std::size_t at = 0;
  const auto seconds = time_of_day(text, at, decimal);
  if (!seconds || !is_zone(text.substr(at))) return std::nullopt;
  clock.seconds = *seconds;
  constexpr double noon = 43200.0;
  if (half != Half::none && clock.seconds >= noon + 3600.0) return std::nullopt;
  if (half != Half::none) clock.seconds = std::fmod(clock.seconds, noon) + (half == Half::second ? noon : 0.0);
  return clock;
}

bool is_unmeasured(std::string_view text) {
  constexpr std::array<std::string_view, 8> none = {"",          "nan", "-nan", "nan(ind)",
                                                    "-nan(ind)", "na",  "<na>", "none"};
  return std::ranges::find(none, lower_case(text)) != none.end();
}

bool is_like_number(std::string_view text) {
  if (text.empty()) return false;
  const std::string lower = lower_case(text);
  if (lower == "nan" || lower == "inf" || lower == "-inf") return true;
  if (!is_digit(lower[0]) && lower.find_first_of("+-.,") != 0) return false;
  static constexpr std::string_view others = "+-.,:eEdDtTzZ'/% ";
  return std::ranges::any_of(text, is_digit) &&
         std::ranges::all_of(text, [](char c) { return is_digit(c) || others.find(c) != std::string_view::npos; });
}

Digits digits_of(std::string_view text, char decimal) {
  Digits digits;
  bool point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == decimal) point = true;
    if (is_digit(c)) {
      if (c != '0' || digits.significant > 0) ++digits.significant;
      if (point) ++digits.decimals;
    }
    if (c == 'e' || c == 'E' || c == 'd' || c == 'D') {
      int exponent = 0;
      const std::size_t sign = i + 1 < text.size() && text[i + 1] == '+' ? 1 : 0;
      std::from_chars(text.data() + i + 1 + sign, text.data() + text.size(), exponent);
      digits.decimals -= exponent;
      return digits;
    }
  }
  return digits;
}

}  // namespace dualdamp::identify
