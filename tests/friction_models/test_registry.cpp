#include "friction_models/registry.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <string_view>

#include "core/units.hpp"

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

TEST_CASE("every parameter has a unit that is read, a meaning and references to earlier ones",
          "[friction][registry]") {
  for (const friction::LawEntry& entry : friction::laws()) {
    for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
      const friction::Parameter& parameter = entry.parameters[i];
      INFO(entry.name << ": " << parameter.name);
      CHECK_FALSE(parameter.meaning.empty());
      CHECK(core::unit_factor("", parameter.unit).value == 1.0);
      const auto earlier = [&](std::string_view name) {
        return std::any_of(entry.parameters.begin(), entry.parameters.begin() + static_cast<std::ptrdiff_t>(i),
                           [&](const friction::Parameter& other) { return other.name == name; });
      };
      if (!parameter.same_as.empty()) CHECK(earlier(parameter.same_as));
      if (!parameter.at_least.empty()) CHECK(earlier(parameter.at_least));
      if (parameter.fallback) CHECK(parameter.range.contains(*parameter.fallback));
    }
  }
}

TEST_CASE("an exact law is affine", "[friction][registry]") {
  for (const friction::LawEntry& entry : friction::laws()) {
    if (entry.engine != friction::EngineKind::exact) continue;
    INFO(entry.name);
    // One within every range: the fallback, or the lower end and a little more.
    friction::ParameterValues values;
    for (const friction::Parameter& parameter : entry.parameters) {
      if (parameter.required()) values.emplace(parameter.name, std::max(parameter.range.low, -1.0) + 0.5);
    }
    if (!friction::complete(entry.parameters, values).empty()) continue;
    CHECK(entry.make(values).is_affine());
  }
}
