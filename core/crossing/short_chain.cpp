#include "core/crossing/short_chain.hpp"

#include <cmath>
#include <limits>

namespace dualdamp::core {

namespace {

constexpr double smallest_share = std::numeric_limits<double>::epsilon();

/// After this many terms of G_m, m >= 2, the factor (k + 1) (m!/(m + k)!) is below rounding.
constexpr std::size_t longest = 24;

/// 1/n
constexpr auto reciprocals = [] {
  std::array<double, longest + ShortChain::most + 1> list{};
  for (std::size_t n = 1; n < list.size(); ++n) list[n] = 1.0 / static_cast<double>(n);
  return list;
}();

}  // namespace

std::array<double, ShortChain::most> ShortChain::at(double s) const {
  std::array<double, most> g{};
  const std::size_t top = count_ - 1;
  // s^m/m! of G_1 to G_count.
  std::array<double, most> power{};
  power[0] = s;
  for (std::size_t m = 1; m < count_; ++m) power[m] = power[m - 1] * s * reciprocals[m + 1];
  const double ps = p_ * s;
  const double qss = q_ * s * s;
  double before = 0.0;
  double here = 1.0;   // h_k s^k
  double share = 1.0;  // M!/(M + k)!, M = count
  double high = 0.0;
  double low = 0.0;
  double last = 1.0;
  auto order = static_cast<double>(count_);  // M + k
  for (std::size_t k = 0; k < longest; ++k) {
    const double term = here * share;
    high += term;
    low += term * order;
    // Every second h_k may vanish, so two terms in a row must be small.
    const double left = std::abs(term) * order;
    if (left < smallest_share && last < smallest_share) break;
    last = left;
    order += 1.0;
    share *= reciprocals[count_ + k + 1];
    const double next = ps * here - qss * before;
    before = here;
    here = next;
  }
  g[top] = power[top] * high;
  g[top - 1] = power[top - 1] * (low * reciprocals[count_]);
  for (std::size_t m = top - 1; m-- > 0;) g[m] = power[m] + p_ * g[m + 1] - q_ * g[m + 2];
  return g;
}

}  // namespace dualdamp::core
