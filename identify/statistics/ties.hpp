#pragma once
/// Order of statistics that are equal but for rounding.
///
/// Some statistics of one record are the same by structure: only k/m counts at steady states, so that another mass
/// explains as much as another stiffness. Which of the two computed values is the larger is a matter of rounding,
/// hence of the order of rows or the unit of lengths, and must decide nothing.

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace dualdamp::identify {

/// Relative difference below which two statistics are the same but for rounding. Statistics that differ for another
/// reason differ by far more.
inline constexpr double tie_share = 1e-6;

/// `unit`: sizes below it count as this one.
[[nodiscard]] inline bool is_tie(double a, double b, double unit = 0.0) {
  const double apart = std::abs(a - b);
  return a == b || (std::isfinite(apart) && apart <= tie_share * std::max({std::abs(a), std::abs(b), unit}));
}

/// Sorts by key, the largest first, and those of equal key by `before`, a strict order.
template <typename List, typename Key, typename Before>
void sort_with_ties(List& list, Key key, Before before, double unit = 0.0) {
  const auto key_of = [&](const auto& one) { return std::invoke(key, one); };
  std::ranges::sort(list, [&](const auto& a, const auto& b) { return key_of(a) > key_of(b); });
  for (auto first = list.begin(); first != list.end();) {
    auto last = std::next(first);
    while (last != list.end() && is_tie(key_of(*std::prev(last)), key_of(*last), unit)) ++last;
    std::ranges::sort(first, last, before);
    first = last;
  }
}

}  // namespace dualdamp::identify
