#include "identify/statistics/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

double stated_noise_p_value(double ratio, double freedom) {
  const double above = chi_square_p_value(ratio * freedom, freedom);
  return std::min(1.0, 2.0 * std::min(above, 1.0 - above));
}

ScatterBesideStated scatter_beside_stated(double ratio, double p_value) {
  constexpr double level = 1e-3;
  constexpr double factor = 1.3;
  if (!(p_value < level)) return ScatterBesideStated::as_stated;
  return ratio > factor         ? ScatterBesideStated::more
         : ratio < 1.0 / factor ? ScatterBesideStated::less
                                : ScatterBesideStated::as_stated;
}

void warn_of_scatter(double ratio, double freedom, Estimate& estimate) {
  constexpr double rare = 1e-4;  // of right statements
  if (!(ratio > 1.0) || chi_square_p_value(ratio * freedom, freedom) > rare) return;
  constexpr int digits = 3;
  estimate.warnings.push_back("the readings scatter " + core::format_number(std::sqrt(ratio), digits) +
                              " times as much as the stated deviations say: the intervals are too narrow, or "
                              "friction departs from Coulomb + viscous");
}

}  // namespace dualdamp::identify
