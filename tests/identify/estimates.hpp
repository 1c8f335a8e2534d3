#pragma once
/// What an estimate says, by name.

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "identify/estimate.hpp"

namespace dualdamp::identify::testing {

inline const FurtherParameter& further(const std::vector<FurtherParameter>& list, const std::string& name) {
  for (const FurtherParameter& parameter : list)
    if (parameter.name == name) return parameter;
  FAIL("there is no " << name);
  return list.front();
}

inline const FurtherParameter& further(const Estimate& estimate, const std::string& name) {
  return further(estimate.others, name);
}

}  // namespace dualdamp::identify::testing
