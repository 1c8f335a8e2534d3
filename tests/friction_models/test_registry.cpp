#include "friction_models/registry.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <string_view>

#include "core/units.hpp"
#include "friction_models/modifiers/modifiers.hpp"

using namespace dualdamp;

TEST_CASE("the registry is sorted by name, without repetition", "[friction][registry]") {
  const auto& laws = friction::laws();
  REQUIRE_FALSE(laws.empty());
  const auto before = [](const friction::LawEntry& a, const friction::LawEntry& b) { return a.name < b.name; };
  CHECK(std::is_sorted(laws.begin(), laws.end(), before));
  for (std::size_t i = 1; i < laws.size(); ++i) CHECK(laws[i - 1].name != laws[i].name);
}

TEST_CASE("every law of the registry is found by its name and says what it is", "[friction][registry]") {
  for (const friction::LawEntry& entry : friction::laws()) {
    INFO(entry.name);
    CHECK(friction::find_law(entry.name) == &entry);
    CHECK_FALSE(entry.summary.empty());
    CHECK_FALSE(entry.equation.empty());
    CHECK(entry.make != nullptr);
  }
  CHECK(friction::find_law("") == nullptr);
  CHECK(friction::find_law("Coulomb") == nullptr);
  CHECK(friction::find_law("coulom") == nullptr);
}

namespace {

/// What a table must keep so that `complete` can go through it from first to last.
void check_table(const std::vector<friction::Parameter>& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    const friction::Parameter& parameter = table[i];
    INFO(parameter.name);
    CHECK_FALSE(parameter.meaning.empty());
    if (parameter.kind == friction::ParameterKind::number) CHECK(core::is_si(parameter.unit));
    const auto earlier = [&](std::string_view name) {
      return std::any_of(table.begin(), table.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const friction::Parameter& other) { return other.name == name; });
    };
    CHECK_FALSE(earlier(parameter.name));
    for (const std::string_view other : {parameter.same_as, parameter.at_least, parameter.instead_of})
      if (!other.empty()) CHECK(earlier(other));
    if (parameter.kind == friction::ParameterKind::choice) CHECK_FALSE(parameter.words.empty());
    const bool is_record =
        parameter.kind == friction::ParameterKind::record || parameter.kind == friction::ParameterKind::list;
    CHECK(is_record != parameter.fields.empty());
    check_table(parameter.fields);
  }
}

/// The smallest values that the table asks for: the lower ends of the ranges and a little more, first words, one
/// item a list.
friction::ParameterValues least_values(const std::vector<friction::Parameter>& table) {
  friction::ParameterValues values;
  for (const friction::Parameter& parameter : table) {
    if (!parameter.required() || !parameter.instead_of.empty()) continue;
    using Kind = friction::ParameterKind;
    if (parameter.kind == Kind::choice)
      values.set(parameter.name, std::string(parameter.words.front()));
    else if (parameter.kind == Kind::flag)
      values.set(parameter.name, false);
    else if (!parameter.fields.empty())
      values.set(parameter.name, std::vector<friction::ParameterValues>{least_values(parameter.fields)});
    else
      values.set(parameter.name,
                 std::max(parameter.allowed_range().low, -1.0) + (parameter.kind == Kind::number ? 0.5 : 1.0));
  }
  return values;
}

}  // namespace

TEST_CASE("every parameter has a unit that is read, a meaning and references to earlier ones",
          "[friction][registry]") {
  for (const friction::LawEntry& entry : friction::laws()) {
    INFO(entry.name);
    check_table(entry.parameters);
  }
  check_table(friction::modifier_parameters());
}

TEST_CASE("an exact law is affine", "[friction][registry]") {
  for (const friction::LawEntry& entry : friction::laws()) {
    if (entry.engine != friction::EngineKind::exact) continue;
    INFO(entry.name);
    friction::ParameterValues values = least_values(entry.parameters);
    REQUIRE(friction::complete(entry.parameters, values).empty());
    const std::vector<friction::Law> laws = entry.make(values);
    CHECK_FALSE(laws.empty());
    for (const friction::Law& law : laws) CHECK(law.is_affine());
  }
}

TEST_CASE("a law has the modifiers it names, after its own parameters", "[friction][registry]") {
  const std::vector<friction::Parameter> own = {{.name = "level", .unit = "N", .meaning = "level"}};
  const auto table = friction::with_modifiers(own, {"fluctuation", "drift"});
  REQUIRE(table.size() == 3);
  CHECK(table[0].name == "level");
  CHECK(table[1].name == "drift");
  CHECK(table[2].name == "fluctuation");

  friction::ParameterValues plain = {{"level", 1.0}};
  CHECK(friction::complete(table, plain).empty());
  CHECK_FALSE(plain.has("drift"));
  using Records = std::vector<friction::ParameterValues>;
  friction::ParameterValues modified = {
      {"level", 1.0},
      {"drift", -0.5},
      {"fluctuation", Records{{{"ratio", 0.1}, {"correlation_time", 2.0}, {"seed", 7.0}}}}};
  CHECK(friction::complete(table, modified).empty());
  friction::ParameterValues other = {{"level", 1.0}, {"position_slope", 1.0}};
  CHECK(friction::complete(table, other).size() == 1);
}
