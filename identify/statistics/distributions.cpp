#include "identify/statistics/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

constexpr double upper95 = 0.975;

}  // namespace

double quantile95(double freedom) {
  if (std::isinf(freedom)) return normal95();
  return boost::math::quantile(boost::math::students_t(freedom), upper95);
}

double normal95() { return boost::math::quantile(boost::math::normal(), upper95); }

double normal_score(double p_value) {
  const double tail = std::max(0.5 * p_value, std::numeric_limits<double>::min());
  return boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
}

double chi_square_p_value(double statistic, double freedom) {
  if (!(freedom > 0.0) || std::isinf(freedom) || std::isnan(statistic))
    return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(statistic)) return statistic > 0.0 ? 0.0 : 1.0;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), std::max(statistic, 0.0)));
}

double f_test_p_value(double statistic, double numerator, double denominator) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const bool free = numerator > 0.0 && denominator > 0.0 && std::isfinite(numerator) && std::isfinite(denominator);
  if (!free || std::isnan(statistic)) return none;
  if (std::isinf(statistic)) return statistic > 0.0 ? 0.0 : 1.0;
  const boost::math::fisher_f law(numerator, denominator);
  return boost::math::cdf(boost::math::complement(law, std::max(statistic, 0.0)));
}

std::string p_text(double p_value) {
  constexpr int digits = 2;
  return p_value == 0.0 ? "p < 1e-300" : "p = " + core::format_number(p_value, digits);
}

}  // namespace dualdamp::identify
