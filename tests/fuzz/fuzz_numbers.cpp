/// Numbers from any text, against the C library, and back.

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/numbers.hpp"
#include "tests/fuzz/harness.hpp"

using namespace dualdamp;
using fuzz::require;

void dualdamp::fuzz::consume(std::string_view input) {
  const core::NumberText read = core::read_number(input);
  require(read.length <= input.size(), "a number is no longer than its text");
  require(read.value.has_value() == read.fault.empty(), "a number has a value or a fault");
  if (!read.value) return;
  require(std::isfinite(*read.value), "a number is finite");
  const std::string own(input.substr(0, read.length));
  char* end = nullptr;
  require(std::strtod(own.c_str(), &end) == *read.value && *end == '\0', "a number is what the C library reads");
  const std::string printed = core::format_number(*read.value);
  const core::NumberText again = core::parse_number(printed);
  require(again.value && *again.value == *read.value, "a printed number reads back to the same bits");
}
