#include "identify/statistics/median.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dualdamp::identify {

double upper_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double median_deviation(std::vector<double> magnitudes) {
  constexpr double normal = 1.4826;  // deviations in the median magnitude
  return normal * upper_median(std::move(magnitudes));
}

}  // namespace dualdamp::identify
