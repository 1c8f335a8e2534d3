#include "friction_models/modifiers/fluctuation.hpp"

#include <cmath>

namespace dualdamp::friction {

namespace {

/// Another stream than that of a law with the same seed.
constexpr std::uint32_t stream = 1;

/// Cells this far apart do not correlate.
constexpr int block = 512;

/// Correlation of two cells `distance` apart.
double correlation(int distance) { return std::exp(-distance / Fluctuation::cells_per_correlation); }

}  // namespace

Fluctuation::Fluctuation(std::uint64_t seed) : draws_{seed, stream} {}

double Fluctuation::after(double level, int next) const {
  const double rho = correlation(1);
  return rho * level + std::sqrt(1.0 - rho * rho) * draw(next);
}

double Fluctuation::at(int cell) const {
  const int place = (cell % block + block) % block;
  int begin = cell - place;
  double left = draw(begin);
  double right = draw(begin + block);
  for (int half = block / 2; begin != cell; half /= 2) {
    const double r = correlation(half);
    const int middle = begin + half;
    const double level =
        (left + right) * r / (1.0 + r * r) + std::sqrt((1.0 - r * r) / (1.0 + r * r)) * draw(middle);
    if (cell < middle) {
      right = level;
    } else {
      begin = middle;
      left = level;
    }
  }
  return left;
}

}  // namespace dualdamp::friction
