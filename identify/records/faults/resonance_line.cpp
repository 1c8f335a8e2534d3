#include "identify/records/faults/resonance_line.hpp"

#include <cmath>

namespace dualdamp::identify {

std::optional<ResonanceLine> resonance_line(const std::vector<Pair>& pairs, const KnownConstants& constants) {
  const double natural = constants.natural_frequency();
  const double n = static_cast<double>(pairs.size());
  double x = 0.0;
  double Y = 0.0;
  for (const Pair& pair : pairs) {
    const double r = frequency_of(pair, constants) / natural;
    constexpr double near = 0.1;
    if (!(std::abs(r - 1.0) < near) ||
        !is_same_frequency(frequency_of(pair, constants), frequency_of(pairs[0], constants)))
      return std::nullopt;
    x += pair.x / n;
    Y += pair.Y / n;
  }
  double xx = 0.0;
  double xY = 0.0;
  double YY = 0.0;
  for (const Pair& pair : pairs) {
    xx += (pair.x - x) * (pair.x - x);
    xY += (pair.x - x) * (pair.Y - Y);
    YY += (pair.Y - Y) * (pair.Y - Y);
  }
  constexpr double straight = 0.9;
  if (pairs.size() < 3 || !(xY > 0.0) || xY * xY < straight * xx * YY) return std::nullopt;
  const double zeta = 0.5 * YY / xY;
  const double other = 0.5 * xx / xY;
  return ResonanceLine{zeta, Y - 2.0 * zeta * x, other, x - 2.0 * other * Y};
}

bool is_odd(double zeta) {
  constexpr double least = 2e-4;
  constexpr double most = 20.0;
  return zeta < least || zeta > most;
}

}  // namespace dualdamp::identify
