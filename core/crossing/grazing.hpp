#pragma once
/// The grazings that one search finds: times at which a guard touches zero within rounding and does not cross.
///
/// A guard that stays within rounding of zero for some time grazes once, however often the search finds it there.
/// If that time ends with a crossing, it belongs to the crossing and is no grazing.

#include <cstddef>
#include <vector>

#include "core/crossing/guard_jets.hpp"
#include "core/crossing/search_result.hpp"

namespace dualdamp::core {

/// A guard whose amplitude has decayed to this has no zeros any more.
inline constexpr double vanished = 1e-280;

/// Whether the guard at s is within rounding of zero, or nearly.
[[nodiscard]] bool is_within_rounding(GuardJets& jets, double s);

class SearchGrazings {
 public:
  /// Appends the grazings of this search to `all`; earlier ones stay as they are.
  explicit SearchGrazings(std::vector<Grazing>& all)
      : all_(all), earlier_(static_cast<std::ptrdiff_t>(all.size())) {}

  [[nodiscard]] bool empty() const { return std::ssize(all_) == earlier_; }
  /// Adds the grazing of guard `index` at s, unless it is the same as a known one.
  void record(GuardJets& jets, int index, double s);
  /// The search ends with a crossing at `end`: removes the grazings of guard `index` that still last there. They
  /// belong to the crossing, or to the next search.
  void drop_unfinished(GuardJets& jets, int index, double end);
  void drop_after(double s);
  /// Sorts the grazings of this search by time and counts them.
  void finish(SearchCount& count);

 private:
  /// The grazing of guard `index` in this search nearest to s; the end of the list if there is none.
  [[nodiscard]] std::vector<Grazing>::iterator nearest(int index, double s) const;

  std::vector<Grazing>& all_;
  std::ptrdiff_t earlier_;
};

}  // namespace dualdamp::core
