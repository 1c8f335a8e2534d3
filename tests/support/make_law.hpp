#pragma once
/// A law of the registry by its name, with the parameters checked as the reader of scenarios does.

#include <catch2/catch.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "friction_models/registry.hpp"

namespace dualdamp::test {

/// Some entries stand for several laws in parallel.
inline std::vector<friction::Law> laws_of(std::string_view name, friction::ParameterValues values) {
  const friction::LawEntry* entry = friction::find_law(name);
  REQUIRE(entry != nullptr);
  REQUIRE(friction::complete(*entry, values).empty());
  return entry->make(values);
}

/// Of an entry that stands for one law.
inline friction::Law law(std::string_view name, friction::ParameterValues values) {
  const std::vector<friction::Law> laws = laws_of(name, std::move(values));
  REQUIRE(laws.size() == 1);
  return laws.front();
}

}  // namespace dualdamp::test
