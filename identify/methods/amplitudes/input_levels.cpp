#include "identify/methods/amplitudes/input_levels.hpp"

#include <algorithm>

#include "identify/methods/amplitudes/line_estimate.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

namespace {

template <typename Value>
bool within(const std::vector<Datum>& pairs, Value value, double share) {
  const auto [least, greatest] = std::ranges::minmax(pairs, {}, value);
  return value(greatest) - value(least) <= share * value(greatest);
}

/// Does x grow with Y by more than its noise?
bool follows(const std::vector<Datum>& pairs) {
  const Moments moments = moments_of(pairs);
  const double explained = moments.S_xY * moments.S_xY / moments.S_YY;
  const double freedom = moments.count - 2.0;
  const double F = freedom * explained / std::max(moments.S_xx - explained, 0.0);
  constexpr double both_sides = 0.02;
  return moments.S_xY > 0.0 && f_test_p_value(F, 1.0, freedom) < both_sides;
}

}  // namespace

std::string lacks_levels(const std::vector<Datum>& pairs) {
  constexpr double rounding = 1e-9;
  constexpr double near_level = 0.05;
  const auto same_frequency = [&](const Datum& datum) { return is_same_frequency(datum.r, pairs.front().r); };
  if (pairs.empty() || !std::ranges::all_of(pairs, same_frequency)) return {};
  const auto level = [](const Datum& datum) { return datum.Y; };
  std::string what = "the input amplitudes are all equal";
  if (!within(pairs, level, rounding)) {
    if (pairs.size() < 3 || !within(pairs, level, near_level) || follows(pairs)) return {};
    what = "the input amplitudes differ by no more than their noise, since x does not grow with them";
  }
  return what + ": one level does not distinguish damping from friction; measure at two levels or more";
}

std::string lacks_levels(const std::vector<Pair>& states) {
  std::vector<Datum> pairs;
  pairs.reserve(states.size());
  for (const Pair& state : states) pairs.push_back({.Y = state.Y, .x = state.x, .r = state.omega});
  return lacks_levels(pairs);
}

}  // namespace dualdamp::identify
