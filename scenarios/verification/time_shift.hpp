#pragma once
/// By how much the events of a second computation of one motion are later. The errors of many events add up, as
/// along the stairs of a mass that sticks and slips on a ramp: there the place of a stair is lasting, and so is the
/// time at which it is left. After 58,000 events within 63,000 s the exact engine is 2e-7 s late, the smooth one
/// 8e-6 s, and in a slip of 0.3 s the velocity at a given time is known no better than that.
///
/// The times of events are compared by themselves. A number at a given time is compared where the other motion is
/// as long after its last event, if this shift is a sum of errors none of which would count alone.

#include <cstddef>
#include <vector>

#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

class TimeShift {
 public:
  /// No events: no shift.
  TimeShift() = default;
  /// `rows` of two tables of events that are the same events.
  TimeShift(const Table& events, const std::vector<std::size_t>& rows, const Table& other,
            const std::vector<std::size_t>& other_rows);

  /// The shift by the last event at or before t [s], of a number that has this rate [unit/s] in the other motion; 0
  /// where a single event has moved the number by more than `allowed` [unit].
  [[nodiscard]] double at(double t, double rate, double allowed) const;

 private:
  std::vector<double> times_;    ///< of the events [s]
  std::vector<double> shifts_;   ///< the other's time less this one's [s]
  std::vector<double> largest_;  ///< largest change of the shift from one event to the next, so far [s]
};

}  // namespace dualdamp::scenarios
