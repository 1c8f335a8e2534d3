#include "identify/readers/lost_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "identify/readers/polynomial.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t beside = 3;  ///< samples on each side of a lost one
constexpr std::size_t support = 2 * beside;

/// The signal at a place, by the rows from `first` on.
double value_at(std::size_t place, const RowPlaces& places, std::span<const double> signal, std::size_t first) {
  std::array<double, support> at{};
  std::array<double, support> values{};
  for (std::size_t i = 0; i < support; ++i) {
    at[i] = static_cast<double>(places.of_row[first + i]);
    values[i] = signal[first + i];
  }
  return polynomial(at, values, static_cast<double>(place));
}

/// How far samples that are there lie from those that would be filled in their places.
std::vector<double> errors_of_filling(const RowPlaces& places, std::span<const double> signal) {
  const std::size_t width = support + places.lost_in_a_row;
  std::vector<double> errors;
  for (std::size_t first = 0; first + width <= signal.size(); ++first) {
    if (places.of_row[first + width - 1] - places.of_row[first] != width - 1) continue;  // not across a loss
    std::array<double, support> at{};
    std::array<double, support> values{};
    for (std::size_t i = 0; i < support; ++i) {
      const std::size_t row = i < beside ? i : i + places.lost_in_a_row;
      at[i] = static_cast<double>(row);
      values[i] = signal[first + row];
    }
    const std::size_t middle = beside + places.lost_in_a_row / 2;
    errors.push_back(std::abs(signal[first + middle] - polynomial(at, values, static_cast<double>(middle))));
  }
  return errors;
}

double root_mean_square(std::span<const double> signal) {
  double mean = 0.0;
  for (const double value : signal) mean += value / static_cast<double>(signal.size());
  double sum = 0.0;
  for (const double value : signal) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(signal.size()));
}

}  // namespace

std::optional<RowPlaces> row_places(std::span<const double> t, double step) {
  constexpr std::size_t most_in_a_row = 3;
  constexpr double most_of_all = 0.05;
  constexpr double near = 0.125;
  RowPlaces places{.of_row = {0}};
  for (std::size_t row = 1; row < t.size(); ++row) {
    const double steps = (t[row] - t[row - 1]) / step;
    const double whole = std::round(steps);
    if (!(whole >= 1.0 && whole <= 1.0 + most_in_a_row) || std::abs(steps - whole) > near) return std::nullopt;
    const std::size_t lost = static_cast<std::size_t>(whole) - 1;
    places.of_row.push_back(places.of_row.back() + lost + 1);
    places.lost += lost;
    places.lost_in_a_row = std::max(places.lost_in_a_row, lost);
  }
  if (static_cast<double>(places.lost) > most_of_all * static_cast<double>(t.size())) return std::nullopt;
  return places;
}

bool can_be_filled(const RowPlaces& places, std::span<const double> signal) {
  constexpr double deviations = 4.0;
  constexpr double half_of_normal = 0.6745;  // half of normal errors are smaller, in deviations
  constexpr double fine = 1e-3;
  constexpr double coarsest = 0.1;
  std::vector<double> errors = errors_of_filling(places, signal);
  if (errors.empty()) return false;
  const double error = upper_median(std::move(errors)) / half_of_normal;
  const double size = root_mean_square(signal);
  return error <= fine * size || (error <= coarsest * size && error <= deviations * robust_noise_level(signal));
}

std::vector<double> filled(const RowPlaces& places, std::span<const double> signal) {
  std::vector<double> result;
  for (std::size_t row = 0; row < signal.size(); ++row) {
    const std::size_t first = std::min(row < beside ? 0 : row - beside, signal.size() - support);
    while (result.size() < places.of_row[row]) result.push_back(value_at(result.size(), places, signal, first));
    result.push_back(signal[row]);
  }
  return result;
}

}  // namespace dualdamp::identify
