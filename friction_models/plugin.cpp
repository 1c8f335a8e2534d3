#include "friction_models/plugin.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/units.hpp"
#include "friction_models/law_fault.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"
#include "friction_models/plugin_law.hpp"
#include "friction_models/registry.hpp"

namespace dualdamp::friction {

namespace {

namespace fs = std::filesystem;
using Table = dualdamp_law_table;

constexpr std::size_t max_parameters = 64;
constexpr std::size_t max_text = max_plugin_text;

/// The faults of one library.
class Refusal {
 public:
  explicit Refusal(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void operator()(const std::string& why, const std::string& allowed = {},
                               const std::string& found = {}) const {
    core::refuse({.file = file_}, "plugin refused: " + why, allowed, found);
  }
  void unless(bool holds, const std::string& why, const std::string& allowed = {},
              const std::string& found = {}) const {
    if (!holds) (*this)(why, allowed, found);
  }

 private:
  std::string file_;
};

/// Whether it can be a key of a scenario file.
bool is_word(const char* text) {
  if (text == nullptr || std::islower(static_cast<unsigned char>(*text)) == 0) return false;
  const std::string_view word(text, strnlen(text, max_text));
  return word.size() < max_text &&
         std::ranges::all_of(
             word, [](unsigned char c) { return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_'; });
}

bool is_text(const char* text) {
  const std::size_t size = strnlen(text, max_text + 1);
  return size <= max_text && printable(text, size) == std::string_view(text, size);
}

std::string_view text_or_nothing(const char* text) { return text == nullptr ? "" : text; }

void check_texts(const Refusal& refuse, const Table& table) {
  refuse.unless(is_word(table.name), "the law's name is no key of a scenario",
                "a small letter, then small letters, digits, '_'",
                table.name == nullptr ? "none" : printable(table.name, max_text));
  refuse.unless(find_law(table.name) == nullptr, "there is a law '" + std::string(table.name) + "' already");
  const std::array<std::pair<const char*, const char*>, 6> texts = {{{"version", table.version},
                                                                     {"summary", table.summary},
                                                                     {"equation", table.equation},
                                                                     {"remembers", table.remembers},
                                                                     {"caution", table.caution},
                                                                     {"sources", table.sources}}};
  constexpr std::size_t required = 3;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto& [name, text] = texts.at(i);
    const bool is_there = text != nullptr && *text != '\0';
    refuse.unless(is_there || i >= required, "the table has no " + std::string(name));
    refuse.unless(!is_there || is_text(text), "the table's " + std::string(name) + " is not printable ASCII",
                  "one line of at most " + std::to_string(max_text) + " characters");
  }
}

void check_counts(const Refusal& refuse, const Table& table) {
  const auto at_most = [&](const char* what, std::size_t found, std::size_t most) {
    refuse.unless(found <= most, std::string("the law has too many ") + what, "at most " + std::to_string(most),
                  std::to_string(found));
  };
  at_most("states", table.states, max_plugin_states);
  at_most("guards", table.guards, max_plugin_guards);
  at_most("parameters", table.parameter_count, max_parameters);
  at_most("modes", table.modes, std::numeric_limits<int>::max());
  refuse.unless(table.modes >= 1, "the law has no mode", "at least 1", "0");
}

void check_functions(const Refusal& refuse, const Table& table) {
  const auto need = [&](bool is_needed, bool is_there, const char* function) {
    refuse.unless(!is_needed || is_there, std::string("the table lacks the function ") + function + "()");
  };
  need(true, table.create != nullptr, "create");
  need(true, table.destroy != nullptr, "destroy");
  need(true, table.respond != nullptr, "respond");
  need(table.states > 0, table.scales != nullptr, "scales");
  need(table.guards > 0, table.guard != nullptr, "guard");
  need(table.guards > 0 || table.modes > 1, table.jump != nullptr, "jump");
}

Parameter parameter_of(const Refusal& refuse, const dualdamp_parameter& p, std::size_t number) {
  refuse.unless(is_word(p.name), "the name of parameter " + std::to_string(number) + " is no key of a scenario");
  const std::string name = "parameter '" + std::string(p.name) + "'";
  refuse.unless(p.meaning != nullptr && *p.meaning != '\0' && is_text(p.meaning), name + " has no meaning",
                "one line of printable ASCII");
  refuse.unless(p.unit != nullptr && *p.unit != '\0' && is_text(p.unit), name + " has no unit",
                "an SI unit; 1 for a number");
  refuse.unless(core::is_si(p.unit), name + " has a unit that is not known, or not SI",
                "an SI unit in udunits2 spelling, such as N.s/m", p.unit);
  Parameter result{.name = p.name, .unit = p.unit, .meaning = p.meaning};
  // No value is infinite: whether such an end is open has no meaning.
  result.range = {.low = p.low,
                  .high = p.high,
                  .low_open = p.low_is_open != 0 && std::isfinite(p.low),
                  .high_open = p.high_is_open != 0 && std::isfinite(p.high)};
  refuse.unless(p.low < p.high, name + " has an empty range", "low < high",
                core::format_number(p.low) + " to " + core::format_number(p.high));
  if (p.has_default != 0) {
    refuse.unless(std::isfinite(p.fallback) && result.range.contains(p.fallback),
                  name + " has a default out of range", result.range.describe(p.unit),
                  core::format_number(p.fallback));
    result.fallback = p.fallback;
  }
  return result;
}

std::vector<Parameter> parameters_of(const Refusal& refuse, const Table& table) {
  refuse.unless(table.parameter_count == 0 || table.parameters != nullptr, "the table of parameters is missing");
  std::vector<Parameter> result;
  for (const dualdamp_parameter& p : std::span(table.parameters, table.parameter_count)) {
    Parameter parameter = parameter_of(refuse, p, result.size() + 1);
    const auto is_taken = [&](const std::vector<Parameter>& by) {
      return std::ranges::find(by, parameter.name, &Parameter::name) != by.end();
    };
    refuse.unless(parameter.name != "law" && !is_taken(modifier_parameters()) && !is_taken(result),
                  "parameter '" + std::string(parameter.name) + "' has a name that is taken");
    result.push_back(std::move(parameter));
  }
  return result;
}

/// The parameters that modifiers act on.
std::vector<Parameter> limits_of(const Table& table, const std::vector<Parameter>& parameters) {
  std::vector<Parameter> limits;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (table.parameters[i].is_limit != 0) limits.push_back(parameters[i]);
  return limits;
}

LawEntry entry_of(const Refusal& refuse, const Table& table, core::Plugin plugin) {
  LawEntry entry{.name = table.name,
                 .summary = table.summary,
                 .equation = table.equation,
                 .engine = EngineKind::smooth,
                 .states = text_or_nothing(table.remembers),
                 .is_odd = (table.abilities & DUALDAMP_IS_ODD) != 0,
                 .is_passive = (table.abilities & DUALDAMP_IS_PASSIVE) != 0,
                 .caution = text_or_nothing(table.caution),
                 .sources = text_or_nothing(table.sources),
                 .parameters = parameters_of(refuse, table),
                 .plugin = std::move(plugin)};
  const std::vector<Parameter> limits = limits_of(table, entry.parameters);
  for (const Parameter& limit : limits) entry.limits.push_back(limit.name);
  if (!limits.empty()) entry.modifiers = {"drift", "fluctuation"};
  const bool are_forces = std::ranges::all_of(limits, [](const Parameter& p) { return p.unit == "N"; });
  if (!limits.empty() && are_forces) entry.modifiers.emplace_back("position_slope");

  entry.check = [&table](const ParameterValues& values) -> std::vector<ParameterFault> {
    const Created created = create_law(table, values);
    if (created.law) return {};
    return {{.name = "law", .message = "the plugin refuses these values: " + created.message}};
  };
  entry.warnings = [&table](const ParameterValues& values) -> std::vector<std::string> {
    const Created created = create_law(table, values);
    if (created.message.empty()) return {};
    return {created.message};
  };
  entry.make = [&table, names = entry.limits](const ParameterValues& values) -> std::vector<Law> {
    const Created created = create_law(table, values);
    if (!created.law) throw LawFault("law '" + std::string(table.name) + "' refuses values that it took before");
    std::vector<double> levels;
    for (const std::string_view name : names) levels.push_back(values.number(name));
    return {modified(*created.law, values, levels)};
  };
  return entry;
}

std::string sha256_of(const Refusal& refuse, const std::string& file) {
  std::error_code error;
  const bool is_there = fs::exists(file, error);
  refuse.unless(!error, "it cannot be read: " + error.message());
  refuse.unless(is_there, "there is no such file");
  refuse.unless(fs::is_regular_file(file, error), "it is not a file");
  std::ifstream in(file, std::ios::binary);
  refuse.unless(in.good(), std::string("it cannot be read: ") + std::strerror(errno));
  core::Sha256 sum;
  std::array<char, 1U << 16U> piece{};
  while (in.read(piece.data(), piece.size()), in.gcount() > 0)
    sum.add({piece.data(), static_cast<std::size_t>(in.gcount())});
  refuse.unless(!in.bad(), std::string("it cannot be read: ") + std::strerror(errno));
  return sum.text();
}

/// The library's table. `path` is absolute, since dlopen searches other folders for a name without a path.
const Table& table_of(const Refusal& refuse, const std::string& path) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* reason = dlerror();
    refuse("it is no shared library that can be loaded here", {}, reason == nullptr ? "" : reason);
  }
  using Query = const Table* (*)();
  const auto query = reinterpret_cast<Query>(dlsym(library, "dualdamp_law"));
  refuse.unless(query != nullptr, "it does not export the function dualdamp_law()");
  const Table* table = nullptr;
  try {
    table = query();
  } catch (...) {
    refuse("dualdamp_law() threw an exception, which no C function may");
  }
  refuse.unless(table != nullptr, "dualdamp_law() returned no table");
  return *table;
}

void check_version(const Refusal& refuse, const Table& table) {
  refuse.unless(table.abi == DUALDAMP_LAW_ABI, "it was built for another version of the interface",
                "version " + std::to_string(DUALDAMP_LAW_ABI), "version " + std::to_string(table.abi));
  refuse.unless(table.size == sizeof(Table),
                "its table has another size than version " + std::to_string(DUALDAMP_LAW_ABI) + " of the interface",
                std::to_string(sizeof(Table)) + " bytes", std::to_string(table.size) + " bytes");
}

/// Checks the table and adds its law.
void add(const Refusal& refuse, const Table& table, const std::string& origin, const std::string& sha256) {
  check_version(refuse, table);
  check_texts(refuse, table);
  check_counts(refuse, table);
  check_functions(refuse, table);
  add_law(entry_of(refuse, table, {table.name, table.version, origin, sha256}));
}

}  // namespace

void load_plugin(const std::string& file) {
  const Refusal refuse(file);
  const std::string sum = sha256_of(refuse, file);
  const std::string path = fs::canonical(file).string();
  const auto is_loaded = [&](const LawEntry& entry) { return entry.plugin && entry.plugin->file == path; };
  if (std::ranges::any_of(laws(), is_loaded)) return;
  add(refuse, table_of(refuse, path), path, sum);
}

void add_plugin(const dualdamp_law_table& table, const std::string& origin, const std::string& sha256) {
  add(Refusal(origin), table, origin, sha256);
}

}  // namespace dualdamp::friction
