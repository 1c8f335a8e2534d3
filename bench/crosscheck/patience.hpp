#pragma once
/// How long one comparison of a case may take.

#include <ctime>

namespace dualdamp::crosscheck {

/// Work (`sim::Engine::work`) of a transient and of the search for its orbit: about a quarter of a second each. Few
/// cases take more, and those took most of the time of a campaign.
inline constexpr long most_work = 300'000;
/// Most work of the difference quotients of one state.
inline constexpr long most_work_of_quotients = 150'000;

/// A limit of processor time from its construction on; a comparison that takes longer is given up.
class Patience {
 public:
  [[nodiscard]] bool is_over() const { return std::clock() > end_; }

 private:
  static constexpr std::clock_t length = 5 * CLOCKS_PER_SEC / 4;
  std::clock_t end_ = std::clock() + length;
};

}  // namespace dualdamp::crosscheck
