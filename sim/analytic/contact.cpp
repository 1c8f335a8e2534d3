#include "sim/analytic/contact.hpp"

#include <cassert>
#include <cmath>

namespace dualdamp::sim::analytic {

std::optional<double> transition_velocity(double omega, double X, double F, double K) {
  assert(omega > 0.0 && X > 0.0 && F > 0.0 && K > 0.0);
  const double d = F / K;
  if (d > X) return std::nullopt;
  return 2.0 * omega * std::sqrt(d * (X - d));
}

std::optional<double> contact_stiffness(double omega, double X, double F, double V_s) {
  assert(omega > 0.0 && X > 0.0 && F > 0.0 && V_s > 0.0);
  const double u = V_s / omega;
  if (u > X) return std::nullopt;
  // X - sqrt(X^2 - u^2) = u^2/(X + sqrt(X^2 - u^2)), which does not cancel for a stiff contact.
  return 2.0 * F * (X + std::sqrt((X - u) * (X + u))) / (u * u);
}

}  // namespace dualdamp::sim::analytic
