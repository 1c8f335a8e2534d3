#include "identify/records/repeats.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::identify {

namespace {

constexpr double rounding = 1e-9;

/// Signals without any change are not compared.
bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || a.size() != b.size()) return false;
  const auto [low, high] = std::ranges::minmax(a);
  const double size = rounding * std::max(std::abs(low), std::abs(high));
  return low < high && std::ranges::equal(a, b, [size](double p, double q) { return std::abs(p - q) <= size; });
}

bool is_same(const History& a, const History& b, bool are_loops) {
  if (are_loops) return is_same(a.force, b.force);
  return is_same(a.x, b.x) || is_same(a.v, b.v) || is_same(a.a, b.a);
}

bool is_same(const Pair& a, const Pair& b) {
  const auto alike = [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); };
  return a.Y == b.Y && a.x == b.x && a.x > 0.0 && alike(a.omega, b.omega) && alike(a.phase, b.phase);
}

}  // namespace

bool share_readings(const Record& a, const Record& b, bool are_loops) {
  for (const History& one : a.histories)
    for (const History& other : b.histories)
      if (is_same(one, other, are_loops)) return true;
  if (a.decay && b.decay && is_same(a.decay->extremes, b.decay->extremes)) return true;
  return a.pairs && b.pairs && !a.pairs->pairs.empty() &&
         std::ranges::equal(a.pairs->pairs, b.pairs->pairs,
                            [](const Pair& one, const Pair& other) { return is_same(one, other); });
}

std::vector<std::string> repeated_readings(const Record& record) {
  std::vector<std::string> warnings;
  constexpr auto counts = "; repeated readings count twice, and the intervals are too narrow";
  for (std::size_t i = 0; i < record.histories.size(); ++i)
    for (std::size_t j = i + 1; j < record.histories.size(); ++j)
      if (is_same(record.histories[i], record.histories[j], false))
        warnings.push_back("tests '" + record.histories[i].sweep + "' and '" + record.histories[j].sweep +
                           "' hold the same samples" + counts);
  if (!record.pairs) return warnings;
  std::string numbers;
  const std::vector<Pair>& pairs = record.pairs->pairs;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(j);
    const auto first =
        std::find_if(pairs.begin(), end, [&](const Pair& other) { return is_same(other, pairs[j]); });
    if (first == end) continue;
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(pairs[j].number) + " that of " +
               std::to_string(first->number);
  }
  if (!numbers.empty()) warnings.push_back("pairs are repeated to the last digit: " + numbers + counts);
  return warnings;
}

}  // namespace dualdamp::identify
