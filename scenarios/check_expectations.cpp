#include "scenarios/check_expectations.hpp"

#include <algorithm>
#include <cctype>

#include "core/diagnostics.hpp"
#include "core/nearest.hpp"

namespace dualdamp::scenarios {

namespace {

/// In a sweep the numbers of a point begin so.
constexpr const char* of_point = "sweep[].result.";

/// Checks indices whose bound is known before the run.
void check_index(CheckedFile& file, const Expectable& result, Place place, const ResultPath& path) {
  const std::size_t bracket = path.pattern.find("[]");
  if (bracket == std::string::npos) return;
  const auto count = result.length_of(path.pattern.substr(0, bracket));
  if (count && path.indices.front() >= *count)
    file.complain(place, "there is no such item in the result", "an index below " + std::to_string(*count),
                  std::to_string(path.indices.front()));
}

/// Whether the text stands for a value that is not finite. Nothing equals such a value.
bool is_not_finite(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::erase_if(text, [](char c) { return c == '+' || c == '-' || c == '.'; });
  return text == "nan" || text == "inf" || text == "infinity";
}

/// Checks that the value can be met and that the bounds belong to it.
void check_equals(CheckedFile& file, const std::string& path, const Json& expectation) {
  if (!expectation.contains("equals")) return;
  const Json& equals = expectation.at("equals");
  const std::string found = equals.is_string() ? equals.get<std::string>() : equals.dump();
  if (is_not_finite(found))
    file.complain(file.place_of(path + ".equals"), "'" + path + ".equals' must be a finite number",
                  "a number, true, false or a text", found);
  for (const std::string bound : {"within", "within_relative"}) {
    if (!expectation.contains(bound)) continue;
    const std::string key = path + "." + bound;
    if (!equals.is_number())
      file.complain(file.place_of(key), "'" + key + "' is a bound beside a value that is no number",
                    "'" + bound + "' beside a number, none beside true, false or a text", "equals: " + found);
    else if (bound == "within_relative" && equals.get<double>() == 0.0)
      file.complain(file.place_of(key), "'" + key + "' is relative to 0: no difference but 0 is within it",
                    "within", "equals: 0");
  }
}

}  // namespace

void check_expectations(CheckedFile& file, const Expectable& result) {
  std::vector<std::string> patterns;
  for (const ResultField& field : result.fields) patterns.push_back(field.path);
  const auto expectations = file.values().find("expect");
  if (expectations == file.values().end()) return;  // none, or reported
  for (std::size_t i = 0; i < expectations->size(); ++i) {
    const Json& expectation = expectations->at(i);
    const std::string item = "expect[" + std::to_string(i) + "]";
    check_equals(file, item, expectation);
    if (!expectation.contains("value") || patterns.empty()) continue;
    const Place place = file.place_of(item + ".value");
    const auto text = expectation.at("value").get<std::string>();
    const auto path = parse_result_path(text);
    if (!path || std::ranges::find(patterns, path->pattern) == patterns.end()) {
      const bool is_of_point = path && std::ranges::find(patterns, of_point + path->pattern) != patterns.end();
      file.complain(place, "the result of " + result.subject + " has no number '" + text + "'",
                    core::joined(patterns), {},
                    is_of_point ? "sweep[0].result." + text : core::nearest(path ? path->pattern : text, patterns));
    } else {
      check_index(file, result, place, *path);
    }
  }
}

std::optional<ResultPath> parse_result_path(const std::string& text) {
  ResultPath path;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '[') {
      path.pattern += text[at];
      continue;
    }
    const std::size_t end = text.find(']', at);
    const std::string digits = text.substr(at + 1, end == std::string::npos ? 0 : end - at - 1);
    constexpr std::size_t longest = 9;
    const bool is_index = !digits.empty() && digits.size() <= longest &&
                          std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!is_index) return std::nullopt;
    path.indices.push_back(std::stoul(digits));
    path.pattern += "[]";
    at = end;
  }
  return path;
}

}  // namespace dualdamp::scenarios
