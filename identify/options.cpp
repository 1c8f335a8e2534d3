#include "identify/options.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

constexpr int digits = 15;

bool is_list(OptionKind kind) { return kind == OptionKind::numbers || kind == OptionKind::counts; }

/// The numbers of a value; a flag has none.
std::vector<double> numbers_in(const OptionValue& value) {
  if (const auto* count = std::get_if<int>(&value)) return {static_cast<double>(*count)};
  if (const auto* number = std::get_if<double>(&value)) return {*number};
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return *numbers;
  if (const auto* counts = std::get_if<std::vector<int>>(&value)) return {counts->begin(), counts->end()};
  return {};
}

/// For a list of words.
core::Diagnostic complaint_about_words(const Option& option, const std::vector<std::string>& given) {
  const std::string name = "option '" + std::string(option.name) + "' ";
  if (given.size() < option.least_items || given.size() > option.most_items)
    return {{}, name + "has the wrong number of items", option.describe(), std::to_string(given.size()), {}};
  const std::vector<std::string> allowed = option.words();
  for (const std::string& word : given)
    if (std::ranges::find(allowed, word) == allowed.end())
      return {{}, name + "cannot hold '" + word + "'", option.describe(), word, {}};
  return {};
}

/// One complaint about a value of this option; the message is empty when there is none.
core::Diagnostic complaint_about(const Option& option, const OptionValue& value) {
  const std::string name = "option '" + std::string(option.name) + "' ";
  if (value.index() != static_cast<std::size_t>(option.kind))
    return {{}, name + "is of the wrong kind", option.describe(), {}, {}};
  if (const auto* words = std::get_if<std::vector<std::string>>(&value))
    return complaint_about_words(option, *words);
  const std::vector<double> numbers = numbers_in(value);
  if (is_list(option.kind) && (numbers.size() < option.least_items || numbers.size() > option.most_items))
    return {{}, name + "has the wrong number of items", option.describe(), std::to_string(numbers.size()), {}};
  const auto outside = std::ranges::find_if(
      numbers, [&](double number) { return !std::isfinite(number) || !option.range.contains(number); });
  if (outside == numbers.end()) return {};
  return {{}, name + "is out of range", option.describe(), core::format_number(*outside, digits), {}};
}

}  // namespace

std::string Option::describe() const {
  if (kind == OptionKind::flag) return "true, false";
  if (kind == OptionKind::names) return "a list of " + core::joined(words());
  const std::string one = range.describe(kind == OptionKind::count || kind == OptionKind::counts ? "" : unit);
  const std::string what = kind == OptionKind::count || kind == OptionKind::counts ? "whole number" : "number";
  if (!is_list(kind)) return "a " + what + " " + one;
  const std::string count = least_items == most_items
                                ? std::to_string(most_items)
                                : std::to_string(least_items) + " to " + std::to_string(most_items);
  return count + " " + what + "s " + one;
}

std::vector<core::Diagnostic> faults_of(const OptionValues& values, std::span<const Option* const> options) {
  std::vector<core::Diagnostic> faults;
  for (const auto& [name, value] : values) {
    const auto declared = std::ranges::find(options, name, &Option::name);
    if (declared == options.end()) {
      std::vector<std::string> names;
      for (const Option* option : options) names.emplace_back(option->name);
      faults.push_back({{},
                        "the method has no option '" + name + "'",
                        names.empty() ? "no option" : core::joined(names),
                        {},
                        {}});
    } else if (core::Diagnostic fault = complaint_about(**declared, value); !fault.message.empty()) {
      faults.push_back(std::move(fault));
    }
  }
  return faults;
}

}  // namespace dualdamp::identify
