#include "identify/statistics/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace dualdamp::identify {

double quantile95(double freedom) {
  constexpr double upper = 0.975;
  if (std::isinf(freedom)) return boost::math::quantile(boost::math::normal(), upper);
  return boost::math::quantile(boost::math::students_t(freedom), upper);
}

double normal_score(double p_value) {
  const double tail = std::max(0.5 * p_value, std::numeric_limits<double>::min());
  return boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
}

double chi_square_p_value(double statistic, double freedom) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), statistic));
}

double f_test_p_value(double statistic, double numerator, double denominator) {
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(numerator, denominator), statistic));
}

}  // namespace dualdamp::identify
