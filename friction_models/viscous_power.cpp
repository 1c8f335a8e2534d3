#include "friction_models/viscous_power.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ViscousPower::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "coefficient", .unit = "N", .range = {.low = 0.0}, .meaning = "force at the reference velocity"},
      {.name = "reference_velocity",
       .unit = "m/s",
       .fallback = 1.0,
       .range = {.low = 0.0, .low_open = true},
       .meaning = "speed to which the power refers"},
      {.name = "exponent",
       .unit = "1",
       .range = {.low = 0.0, .low_open = true},
       .meaning = "of the speed: 1 a dashpot, 2 drag"},
  };
  return table;
}

}  // namespace dualdamp::friction
