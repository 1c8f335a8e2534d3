#include "identify/records/turning_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dualdamp::identify {

std::vector<std::size_t> zigzag(std::span<const double> x, double band) {
  std::vector<std::size_t> turns;
  std::size_t low = 0;
  std::size_t high = 0;
  int direction = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[high]) high = i;
    if (x[i] < x[low]) low = i;
    if (direction >= 0 && x[i] < x[high] - band) {
      turns.push_back(high);
      direction = -1;
      low = i;
    } else if (direction <= 0 && x[i] > x[low] + band) {
      turns.push_back(low);
      direction = 1;
      high = i;
    }
  }
  turns.push_back(direction > 0 ? high : low);
  return turns;
}

double range_of(std::span<const double> x) {
  if (x.empty()) return 0.0;
  const auto [low, high] = std::ranges::minmax(x);
  return high - low;
}

std::size_t rows_that_turn(std::span<const double> x) {
  std::size_t count = 0;
  for (std::size_t i = 2; i < x.size(); ++i) count += (x[i] - x[i - 1]) * (x[i - 1] - x[i - 2]) < 0.0 ? 1 : 0;
  return count;
}

std::vector<std::size_t> without_ripple(std::span<const double> x, std::vector<std::size_t> turns,
                                        double half_period) {
  const auto swing = [&](std::size_t i) { return std::abs(x[turns[i]] - x[turns[i - 1]]); };
  const auto is_ripple = [&](std::size_t i) {
    return swing(i) <= swing(i - 1) && swing(i) <= swing(i + 1) &&
           2.0 * static_cast<double>(turns[i] - turns[i - 1]) < half_period;
  };
  std::size_t before = 0;
  while (before != turns.size()) {
    before = turns.size();
    std::vector<std::size_t> left = {turns.front()};
    for (std::size_t i = 1; i < turns.size(); ++i) {
      const bool has_neighbours = i >= 2 && i + 1 < turns.size() && left.back() == turns[i - 1];
      if (has_neighbours && is_ripple(i))
        left.pop_back();
      else
        left.push_back(turns[i]);
    }
    turns = std::move(left);
  }
  return turns;
}

std::size_t begin_of_rest(std::span<const double> x, double range) {
  std::size_t rest = x.size();
  for (double low = x.back(), high = low; rest > 0; --rest) {
    low = std::min(low, x[rest - 1]);
    high = std::max(high, x[rest - 1]);
    if (high - low >= range) break;
  }
  return rest;
}

void leave_out_overshoot(std::span<const double> x, std::vector<std::size_t>& turns, std::size_t rest,
                         double half_period) {
  constexpr double small = 1e-3;  // of the range: of 20 samples a period or more
  constexpr double part_of_swing = 0.25;
  if (static_cast<double>(x.size() - rest) < half_period) return;
  const auto is_overshoot = [&](std::size_t turn) {
    return turn < rest && static_cast<double>(rest - turn) < part_of_swing * half_period &&
           std::abs(x[turn] - x.back()) < small * range_of(x);
  };
  while (turns.size() > 3 && is_overshoot(turns[turns.size() - 2])) turns.erase(turns.end() - 2);
}

bool leave_out_irregular(std::span<const double> x, std::vector<std::size_t>& turns, std::size_t from, double least,
                         double most) {
  const auto first = static_cast<std::size_t>(std::ranges::upper_bound(turns, from) - turns.begin());
  if (first < 2) return false;
  const auto has_length = [&](std::size_t end) {
    const auto lasts = static_cast<double>(turns[end] - turns[end - 1]);
    return lasts > least && lasts < most;
  };
  std::size_t i = first;
  while (i + 1 < turns.size() && has_length(i)) ++i;
  if (i + 1 >= turns.size()) return false;
  turns.resize(first);
  turns.push_back(x.size() - 1);
  return true;
}

}  // namespace dualdamp::identify
