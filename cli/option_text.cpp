#include "cli/option_text.hpp"

#include <algorithm>
#include <cstddef>

namespace dualdamp::cli {

std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

std::pair<std::string, std::string> split_at_equals(const std::string& text) {
  const std::size_t sign = std::min(text.find('='), text.size());
  return {text.substr(0, sign), sign < text.size() ? text.substr(sign + 1) : std::string()};
}

}  // namespace dualdamp::cli
