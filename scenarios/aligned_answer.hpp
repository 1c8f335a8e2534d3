#pragma once
/// What two computations of one motion may tell in two ways: the order of events at one time, and with which of its
/// forcing periods a subharmonic motion begins.

#include "scenarios/results/answer.hpp"

namespace dualdamp::scenarios {

/// `other` as `answer` tells it. Events trade places where they differ by less than `tolerance` of the last one's
/// time; a subharmonic motion, whose `period_ratio` both have, begins with the forcing period in which its orbit is
/// nearest to that of `answer`.
[[nodiscard]] Answer aligned(const Answer& answer, Answer other, double tolerance);

}  // namespace dualdamp::scenarios
