#pragma once
/// Power series in the time within a sample interval: values, derivatives and roots.

#include <array>
#include <cstddef>

namespace dualdamp::identify {

template <std::size_t N>
double value_at(const std::array<double, N>& series, int terms, double u) {
  double sum = 0.0;
  for (int j = terms - 1; j >= 0; --j) sum = sum * u + series[static_cast<std::size_t>(j)];
  return sum;
}

template <std::size_t N>
double slope_at(const std::array<double, N>& series, int terms, double u) {
  double sum = 0.0;
  for (int j = terms - 1; j >= 1; --j) sum = sum * u + j * series[static_cast<std::size_t>(j)];
  return sum;
}

template <std::size_t N>
double curvature_at(const std::array<double, N>& series, int terms, double u) {
  double sum = 0.0;
  for (int j = terms - 1; j >= 2; --j) sum = sum * u + j * (j - 1) * series[static_cast<std::size_t>(j)];
  return sum;
}

/// Parts of an interval that are searched for a change of sign, by the values at their ends.
inline constexpr int parts_of_interval = 4;

/// A sign change of f between low and high, to rounding.
template <class Function>
double root(const Function& f, double low, double high) {
  const bool rising = f(high) > 0.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace dualdamp::identify
