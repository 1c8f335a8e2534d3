#pragma once
/// The parameter `static` [N] of a law that also has `kinetic`: not below it, and equal to it by default.

#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

[[nodiscard]] inline Parameter static_parameter(std::string_view meaning) {
  return {.name = "static",
          .unit = "N",
          .same_as = "kinetic",
          .range = not_negative,
          .at_least = "kinetic",
          .meaning = meaning};
}

}  // namespace dualdamp::friction
