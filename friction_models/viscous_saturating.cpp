#include "friction_models/viscous_saturating.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ViscousSaturating::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "coefficient", .unit = "N.s/m", .range = {.low = 0.0}, .meaning = "viscous friction at low speed"},
      {.name = "saturation_velocity",
       .unit = "m/s",
       .range = {.low = 0.0, .low_open = true},
       .meaning = "speed at which the force is half of what it comes to"},
  };
  return table;
}

}  // namespace dualdamp::friction
