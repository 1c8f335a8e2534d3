#pragma once
/// How long one comparison of a case may take.

#include <ctime>

namespace dualdamp::crosscheck {

/// Work (`sim::Engine::work`) of a transient, and of the periods of a difference quotient: about half a second.
inline constexpr long most_work = 600'000;

/// A limit of processor time from its construction on; a comparison that takes longer is given up.
class Patience {
 public:
  [[nodiscard]] bool is_over() const { return std::clock() > end_; }

 private:
  static constexpr std::clock_t length = 5 * CLOCKS_PER_SEC / 4;
  std::clock_t end_ = std::clock() + length;
};

}  // namespace dualdamp::crosscheck
