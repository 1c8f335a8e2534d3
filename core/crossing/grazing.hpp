#pragma once
/// The grazings that one search finds: times at which a guard touches zero within rounding and does not cross.
///
/// A guard that stays within rounding of zero for a while grazes once, however often the search meets it there.
/// Where that while ends with a crossing it belongs to the crossing and is no grazing.

#include <cstddef>
#include <vector>

#include "core/crossing/guard_jets.hpp"
#include "core/crossing/search_result.hpp"

namespace dualdamp::core {

/// A guard that has decayed to this part has no zeros any more.
inline constexpr double vanished = 1e-280;

/// Whether the guard does not clearly stand out of rounding at s.
[[nodiscard]] bool is_within_rounding(GuardJets& jets, double s);

class SearchGrazings {
 public:
  /// Those of this search are appended to `all`; those before stay as they are.
  explicit SearchGrazings(std::vector<Grazing>& all)
      : all_(all), earlier_(static_cast<std::ptrdiff_t>(all.size())) {}

  [[nodiscard]] bool empty() const { return std::ssize(all_) == earlier_; }
  /// Adds the grazing of guard `index` at s unless it is one with a grazing known already.
  void record(GuardJets& jets, int index, double s);
  /// The search ends with a crossing at `end`: removes the grazings of guard `index` that are not over there. They
  /// are part of that crossing, or of the next search.
  void drop_unfinished(GuardJets& jets, int index, double end);
  void drop_after(double s);
  /// Sorts those of this search by time and counts them.
  void finish(SearchCount& count);

 private:
  /// Of guard `index` in this search; the end of the list when there is none.
  [[nodiscard]] std::vector<Grazing>::iterator nearest(int index, double s) const;

  std::vector<Grazing>& all_;
  std::ptrdiff_t earlier_;
};

}  // namespace dualdamp::core
