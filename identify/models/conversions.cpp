#include "identify/models/conversions.hpp"

#include <cassert>
#include <cmath>

namespace dualdamp::identify {

Friction transfer_stiffness(const Friction& friction, double k1, double k2) {
  assert(k1 > 0.0 && k2 > 0.0);
  const double ratio = k1 / k2;
  return {friction.zeta * std::sqrt(ratio), friction.x_f * ratio};
}

Friction mean(const std::vector<Friction>& estimates) {
  assert(!estimates.empty());
  Friction sum;
  for (const Friction& estimate : estimates) {
    sum.zeta += estimate.zeta;
    sum.x_f += estimate.x_f;
  }
  const auto count = static_cast<double>(estimates.size());
  return {sum.zeta / count, sum.x_f / count};
}

}  // namespace dualdamp::identify
