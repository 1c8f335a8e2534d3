#include "core/numbers.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace dualdamp::core {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t skip_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

NumberText refused_number(std::string fault, std::size_t length) {
  return {std::nullopt, length, std::move(fault)};
}

/// The run of characters a person would take for the number, for messages.
std::size_t word_length(std::string_view text) {
  const std::size_t end = text.find_first_of(" \t]}");
  return end == std::string_view::npos ? text.size() : end;
}

/// The fault of a text that does not begin with a digit.
NumberText without_digit(std::string_view text, std::size_t sign) {
  const std::string_view rest = text.substr(sign);
  if (rest.size() > 1 && rest[0] == '.' && is_digit(rest[1]))
    return refused_number("has no digit before its point", word_length(text));
  if (text.size() > 1 && text[0] == '+' && (is_digit(text[1]) || text[1] == '.'))
    return refused_number("has a leading plus sign", word_length(text));
  for (const std::string_view name : {"nan", "NaN", ".nan", ".NaN", "NAN", ".NAN", "inf", "Inf", ".inf", ".Inf",
                                      "INF", ".INF", "infinity", "Infinity"})
    if (rest.substr(0, word_length(rest)) == name) return refused_number("is not finite", word_length(text));
  return refused_number(rest.empty() ? "is missing" : "does not begin with a digit", 0);
}

NumberText converted(std::string_view digits) {
  double value = 0.0;
  const std::from_chars_result result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool nonzero =
      digits.substr(0, digits.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos;
  if (nonzero && (result.ec == std::errc::result_out_of_range || value == 0.0 || !std::isfinite(value)))
    return refused_number("is outside the range of double precision", digits.size());
  return {value, digits.size(), {}};
}

/// `std::to_chars` needs 24 characters at most for a double; with a precision of 17 a few more.
constexpr std::size_t buffer_size = 64;

}  // namespace

NumberText read_number(std::string_view text) {
  const std::size_t sign = !text.empty() && text[0] == '-' ? 1 : 0;
  if (sign >= text.size() || !is_digit(text[sign])) return without_digit(text, sign);

  std::size_t end = skip_digits(text, sign);
  if (text[sign] == '0') {
    if (end < text.size() && (text[end] == 'x' || text[end] == 'X'))
      return refused_number("is hexadecimal", word_length(text));
    if (end > sign + 1) return refused_number("has a leading zero", word_length(text));
  }
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction = skip_digits(text, end + 1);
    if (fraction == end + 1) return refused_number("has no digit after its point", word_length(text));
    end = fraction;
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const std::size_t exponent_sign =
        end + 1 < text.size() && (text[end + 1] == '+' || text[end + 1] == '-') ? 1 : 0;
    const std::size_t exponent = skip_digits(text, end + 1 + exponent_sign);
    // Without digits the letter belongs to what follows: a unit may begin with e.
    if (exponent > end + 1 + exponent_sign) end = exponent;
  }
  if (end + 1 < text.size() && text[end] == ',' && is_digit(text[end + 1]))
    return refused_number("has a comma: the decimal sign is a point, and digits are not grouped",
                          word_length(text));
  return converted(text.substr(0, end));
}

NumberText parse_number(std::string_view text) {
  NumberText number = read_number(text);
  if (number.value && number.length != text.size())
    return refused_number("is followed by something else", text.size());
  return number;
}

std::string format_number(double value) {
  std::array<char, buffer_size> buffer{};
  const std::to_chars_result result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), result.ptr);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string format_number(double value, int digits) {
  std::array<char, buffer_size> buffer{};
  const std::to_chars_result result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return {buffer.data(), result.ptr};
}

std::string percent(double share, int digits) {
  constexpr double most_in_full = 1e6;
  const double value = 100.0 * share;
  const double size = std::abs(value);
  const bool is_whole = size >= std::pow(10.0, digits) - 0.5 && size < most_in_full;
  return (is_whole ? std::to_string(std::llround(value)) : format_number(value, digits)) + " %";
}

std::string signed_percent(double share, int digits) { return (share < 0.0 ? "" : "+") + percent(share, digits); }

}  // namespace dualdamp::core
