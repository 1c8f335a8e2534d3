#include "scenarios/analyses/shared/identify_options.hpp"

#include "core/diagnostics.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::OptionKind;

Field field_of(const identify::Option& option) {
  const std::string name(option.name);
  const std::string meaning(option.meaning);
  const std::vector<std::string> units = {std::string(option.unit)};
  Field field = option.kind == OptionKind::flag      ? boolean(name, meaning).with_fallback(false)
                : option.kind == OptionKind::count   ? integer(name, meaning)
                : option.kind == OptionKind::number  ? quantity(name, units, meaning)
                : option.kind == OptionKind::numbers ? quantities(name, units, meaning)
                : option.kind == OptionKind::counts  ? integers(name, meaning)
                                                     : word_list(name, option.words(), meaning);
  field.range = option.range;
  field.min_items = option.least_items;
  field.max_items = option.most_items;
  if (option.kind != OptionKind::flag) field.fallback_words = option.otherwise;
  return field;
}

identify::OptionValue value_of(OptionKind kind, const Json& value) {
  switch (kind) {
    case OptionKind::flag:
      return value.get<bool>();
    case OptionKind::count:
      return value.get<int>();
    case OptionKind::number:
      return value.get<double>();
    case OptionKind::numbers:
      return value.get<std::vector<double>>();
    case OptionKind::counts:
      return value.get<std::vector<int>>();
    case OptionKind::names:
      return value.get<std::vector<std::string>>();
  }
  return false;
}

/// A flag that is false has no effect.
bool asks_for_something(const identify::OptionValue& value) {
  const bool* flag = std::get_if<bool>(&value);
  return flag == nullptr || *flag;
}

/// Names of the methods that use an option, or of those that do not.
template <typename Methods>
std::vector<std::string> names_of(const Methods& methods, const identify::Option& option, bool users) {
  std::vector<std::string> names;
  for (const identify::MethodEntry* method : methods)
    if (method->has(option) == users) names.emplace_back(method->name);
  return names;
}

void check_pairs(CheckedFile& file, std::size_t count) {
  if (!file.has("analysis", "pairs")) return;
  const Json& chosen = file.values().at("analysis").at("pairs");
  if (chosen[0] == chosen[1]) file.complain("analysis.pairs", "'analysis.pairs' names one pair twice", "two pairs");
  for (std::size_t i = 0; i < 2 && count > 0; ++i)
    if (chosen[i].get<std::size_t>() > count)
      file.complain("analysis.pairs[" + std::to_string(i) + "]", "there is no such pair",
                    "1 to " + std::to_string(count), chosen[i].dump());
}

}  // namespace

std::vector<Field> method_option_fields() {
  std::vector<Field> fields;
  for (const identify::Option* option : identify::options()) fields.push_back(field_of(*option));
  return fields;
}

void check_method_options(CheckedFile& file, std::size_t pairs) {
  check_pairs(file, pairs);
  if (!file.has("analysis", "methods")) return;
  const Json& analysis = file.values().at("analysis");
  std::vector<const identify::MethodEntry*> all;
  for (const identify::MethodEntry& method : identify::methods()) all.push_back(&method);
  std::vector<const identify::MethodEntry*> chosen;
  for (const Json& name : analysis.at("methods")) chosen.push_back(identify::find_method(name.get<std::string>()));
  for (const identify::Option* option : identify::options()) {
    const std::string path = "analysis." + std::string(option->name);
    if (!file.is_given(path) || !analysis.contains(option->name)) continue;  // given, and faulty
    if (!asks_for_something(value_of(option->kind, analysis.at(option->name)))) continue;
    if (names_of(chosen, *option, true).empty())
      file.complain(path, "none of the chosen methods uses '" + path + "'",
                    "with one of the methods " + core::joined(names_of(all, *option, true)),
                    "methods: " + core::joined(names_of(chosen, *option, false)));
  }
}

identify::OptionValues method_options(const Json& section) {
  identify::OptionValues values;
  for (const identify::Option* option : identify::options())
    if (section.contains(option->name))
      values.emplace(option->name, value_of(option->kind, section.at(option->name)));
  return values;
}

std::vector<std::string> unused_options(const identify::OptionValues& values,
                                        const std::vector<const identify::MethodEntry*>& methods) {
  std::vector<std::string> warnings;
  for (const identify::Option* option : identify::options()) {
    const auto value = values.find(option->name);
    if (value == values.end() || !asks_for_something(value->second)) continue;
    const std::vector<std::string> names = names_of(methods, *option, false);
    if (!names.empty() && names.size() < methods.size())
      warnings.push_back("the option '" + std::string(option->name) + "' is not used by " + core::joined(names));
  }
  return warnings;
}

}  // namespace dualdamp::scenarios
