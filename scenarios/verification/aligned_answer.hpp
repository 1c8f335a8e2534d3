#pragma once
/// Two computations of one motion may differ in two respects without an error: the order of events at one time, and
/// the forcing period with which a subharmonic motion begins.

#include "scenarios/results/answer.hpp"

namespace dualdamp::scenarios {

/// `other`, arranged as `answer`. Events change places if their times differ by less than `tolerance` times the
/// time of the last event. A subharmonic motion of equal `period_ratio` begins with the forcing period in which its
/// orbit is nearest to that of `answer`.
[[nodiscard]] Answer aligned(const Answer& answer, Answer other, double tolerance);

}  // namespace dualdamp::scenarios
