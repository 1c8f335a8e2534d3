#include "identify/methods/amplitudes/error_propagation.hpp"

#include <cassert>

#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

namespace analytic = sim::analytic;

double ResonanceG::value(double zeta) const {
  return approximate ? analytic::approximate_G(zeta) : analytic::den_hartog(zeta, r).G;
}

double ResonanceG::derivative(double zeta) const {
  return approximate ? analytic::approximate_G_derivative(zeta) : analytic::den_hartog(zeta, r).dG_dzeta;
}

TwoPointSensitivity two_point_sensitivity(const AmplitudePair& first, const AmplitudePair& second,
                                          const ResonanceG& G) {
  const double dx = second.x - first.x;
  const double dY = first.Y - second.Y;  // the order of Eq (13)
  assert(dx != 0.0 && dY != 0.0 && dx * dY < 0.0);
  TwoPointSensitivity s;
  s.zeta = -dY / (2.0 * dx);
  s.G = G.value(s.zeta);
  const double area = first.x * second.Y - second.x * first.Y;
  s.x_f = area / (s.G * dY);

  s.A = second.Y / (s.G * dY);
  s.B = -first.Y / (s.G * dY);
  s.C = second.Y * dx / (s.G * dY * dY);
  s.D = -first.Y * dx / (s.G * dY * dY);
  s.E = -s.x_f / s.G * G.derivative(s.zeta);

  s.of_zeta = {s.zeta / dx, -s.zeta / dx, -0.5 / dx, 0.5 / dx};
  s.of_x_f = {s.A + s.E * s.of_zeta.x1, s.B + s.E * s.of_zeta.x2, s.C + s.E * s.of_zeta.Y1,
              s.D + s.E * s.of_zeta.Y2};
  return s;
}

}  // namespace dualdamp::identify
