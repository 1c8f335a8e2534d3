#include "core/crossing/grazing.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::core {

bool is_within_rounding(GuardJets& jets, double s) { return std::abs(jets.at(s).value) <= 1.5 * jets.rounding(s); }

namespace {

/// Whether the guard, which is within rounding of zero at s, stays so until t > s.
bool stays_within_rounding(GuardJets& jets, double s, double t) {
  return is_within_rounding(jets, 0.5 * (s + t)) && is_within_rounding(jets, s + 0.25 * (t - s)) &&
         is_within_rounding(jets, s + 0.75 * (t - s));
}

}  // namespace

std::vector<Grazing>::iterator SearchGrazings::nearest(int index, double s) const {
  auto nearest = all_.end();
  for (auto it = all_.begin() + earlier_; it != all_.end(); ++it) {
    if (it->guard != index) continue;
    if (nearest == all_.end() || std::abs(it->s - s) < std::abs(nearest->s - s)) nearest = it;
  }
  return nearest;
}

void SearchGrazings::record(GuardJets& jets, int index, double s) {
  if (jets.rounding(s) <= guard_rounding * vanished) return;
  const auto known = nearest(index, s);
  if (known != all_.end() && stays_within_rounding(jets, std::min(known->s, s), std::max(known->s, s))) return;
  all_.push_back({index, s});
}

void SearchGrazings::drop_unfinished(GuardJets& jets, int index, double end) {
  for (auto last = nearest(index, end); last != all_.end() && stays_within_rounding(jets, last->s, end);
       last = nearest(index, end)) {
    all_.erase(last);
  }
}

void SearchGrazings::drop_after(double s) {
  const auto late = [&](const Grazing& grazing) { return grazing.s > s; };
  all_.erase(std::remove_if(all_.begin() + earlier_, all_.end(), late), all_.end());
}

void SearchGrazings::finish(SearchCount& count) {
  count.grazings += static_cast<long>(all_.size()) - earlier_;
  std::sort(all_.begin() + earlier_, all_.end(), [](const Grazing& a, const Grazing& b) { return a.s < b.s; });
}

}  // namespace dualdamp::core
