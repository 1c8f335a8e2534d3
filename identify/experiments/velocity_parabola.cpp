#include "identify/experiments/velocity_parabola.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::identify {

namespace {

/// Half the second derivative of the velocity between samples i - 1 and i, from two samples to each side. None
/// where the velocity would cross zero and come back: the samples show no reversal there, nor motion beside a rest.
double bend_before(const std::vector<double>& v, double rate, std::size_t i) {
  if (i < 2 || i + 1 >= v.size()) return 0.0;
  const double from = v[i - 1];
  const double to = v[i];
  const double bend = 0.25 * rate * rate * (v[i - 2] - from - to + v[i + 1]);
  const double rise = std::abs(bend) / (rate * rate);
  const bool turns = from * to > 0.0    ? 0.25 * rise >= std::min(std::abs(from), std::abs(to))
                     : from * to == 0.0 ? rise > std::abs(from + to)
                                        : false;
  return turns ? 0.0 : bend;
}

}  // namespace

VelocityParabola velocity_before(const std::vector<double>& v, double rate, std::size_t i) {
  const double curve = bend_before(v, rate, i);
  return {v[i - 1], (v[i] - v[i - 1]) * rate - curve / rate, curve};
}

}  // namespace dualdamp::identify
