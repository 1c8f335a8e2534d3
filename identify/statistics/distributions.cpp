#include "identify/statistics/distributions.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace dualdamp::identify {

double quantile95(double freedom) {
  constexpr double upper = 0.975;
  if (std::isinf(freedom)) return boost::math::quantile(boost::math::normal(), upper);
  return boost::math::quantile(boost::math::students_t(freedom), upper);
}

double f_test_p_value(double statistic, double numerator, double denominator) {
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(numerator, denominator), statistic));
}

}  // namespace dualdamp::identify
