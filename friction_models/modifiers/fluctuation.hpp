#pragma once
/// A stationary Ornstein-Uhlenbeck process of mean 0 and variance 1, held on cells of a tenth of its correlation
/// time or length. Neighbours correlate by rho = exp(-1/10).
///
/// Over time it is computed cell by cell: n_0 = g_0, n_(i+1) = rho n_i + sqrt(1 - rho^2) g_(i+1), g_i the normal
/// draw i.
///
/// Over position the mass may reach a cell from either side and more than once, so each level must follow from the
/// number of its cell alone. This is Levy's construction: every 512th cell has n_i = g_i, because the correlation
/// rho^512 = 6e-23 is negligible. Between two known cells, h cells away on either side, the middle one has (n_a +
/// n_b) r/(1 + r^2) + sqrt((1 - r^2)/(1 + r^2)) g_i with r = rho^h: the distribution of the process given both
/// ends. At most 11 draws a level.
///
/// Source: uhlenbeck1930, levy1948 in `docs/refs.bib`.

#include <cstdint>

#include "core/random.hpp"

namespace dualdamp::friction {

class Fluctuation {
 public:
  static constexpr double cells_per_correlation = 10.0;

  explicit Fluctuation(std::uint64_t seed);

  /// Over time: the level of the first cell, and of cell `next` after a cell of this level.
  [[nodiscard]] double first() const { return draw(0); }
  [[nodiscard]] double after(double level, int next) const;
  /// Over position: the level of any cell.
  [[nodiscard]] double at(int cell) const;

 private:
  [[nodiscard]] double draw(int cell) const {
    return draws_.normal(static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)));
  }

  core::RandomStream draws_;
};

}  // namespace dualdamp::friction
