#include "scenarios/verification/time_shift.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::scenarios {

TimeShift::TimeShift(const Table& events, const std::vector<std::size_t>& rows, const Table& other,
                     const std::vector<std::size_t>& other_rows) {
  const Column* const t = events.find("t");
  const Column* const other_t = other.find("t");
  if (t == nullptr || other_t == nullptr || rows.size() != other_rows.size()) return;
  double before = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double shift = other_t->numbers[other_rows[i]] - t->numbers[rows[i]];
    largest = std::max(largest, std::abs(shift - before));
    before = shift;
    times_.push_back(t->numbers[rows[i]]);
    shifts_.push_back(shift);
    largest_.push_back(largest);
  }
}

double TimeShift::at(double t, double rate, double allowed) const {
  const auto next = std::ranges::upper_bound(times_, t);
  if (next == times_.begin() || !std::isfinite(rate)) return 0.0;
  const auto last = static_cast<std::size_t>(next - times_.begin()) - 1;
  return largest_[last] * std::abs(rate) <= allowed ? shifts_[last] : 0.0;
}

}  // namespace dualdamp::scenarios
