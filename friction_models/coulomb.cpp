#include "friction_models/coulomb.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& Coulomb::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic", .unit = "N", .range = {.low = 0.0}, .meaning = "friction force while slipping"},
      {.name = "static",
       .unit = "N",
       .same_as = "kinetic",
       .range = {.low = 0.0},
       .at_least = "kinetic",
       .meaning = "largest force that holds the mass at rest"},
  };
  return table;
}

}  // namespace dualdamp::friction
