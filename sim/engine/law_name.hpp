#pragma once
/// Words for a law in messages.

#include <cstddef>
#include <string>
#include <string_view>

#include "sim/model.hpp"

namespace dualdamp::sim {

/// Its place in system.friction, and its name if it is from a plugin.
[[nodiscard]] inline std::string name_in_list(const Model& model, std::size_t law) {
  const std::string place =
      model.friction.size() == 1 ? "friction" : "item " + std::to_string(law + 1) + " of system.friction";
  const std::string_view name = model.friction[law].name();
  return name.empty() ? place : place + " (law '" + std::string(name) + "' of a plugin)";
}

}  // namespace dualdamp::sim
