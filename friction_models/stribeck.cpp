#include "friction_models/stribeck.hpp"

#include <algorithm>
#include <iterator>

namespace dualdamp::friction {

const std::vector<Parameter>& Stribeck::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = StribeckCurve::parameters({.low = 0.0});
    std::ranges::copy(StribeckCurve::shape_parameters(), std::back_inserter(list));
    return list;
  }();
  return table;
}

}  // namespace dualdamp::friction
