#include "identify/methods/any_law/severity_scale.hpp"

#include <cmath>

namespace dualdamp::identify {

double SeverityScale::of(double severity) const {
  return root_ ? std::copysign(std::sqrt(std::abs(severity)), severity) : severity;
}

double SeverityScale::severity(double coordinate) const {
  return root_ ? coordinate * std::abs(coordinate) : coordinate;
}

std::vector<double> SeverityScale::first_severities(double largest, int count) const {
  const double power = root_ ? 2.0 : 1.5;
  std::vector<double> severities;
  for (int i = 1; i <= count; ++i) severities.push_back(largest * std::pow(static_cast<double>(i) / count, power));
  return severities;
}

}  // namespace dualdamp::identify
