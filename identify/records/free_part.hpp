#pragma once
/// The part of a history without a drive in which the mass moves freely: it may be held before, until a release or
/// a blow.
///
/// A mass that rests where nothing drives it does not move later, so that a rest at the beginning, before a motion,
/// is a hold. The mass is held if the first signal of x, v and a that was measured stays equal within its noise for
/// more than half of a half swing, and a parabola through this time bends by less than half of what a motion bends
/// that begins at its turning point, 9 % of the swing (rms). A shorter hold is taken for motion.
///
/// The part begins as the extremes do that are derived from the history (derived_records.hpp): at the release, or
/// at the end of the largest swing. It lasts to the end of the record: where friction holds the mass, the rest
/// tells the friction.
///
/// Errors: none thrown. Cost: linear, about 1 us a sample.

#include <cstddef>
#include <string>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct FreePart {
  std::size_t held = 0;   ///< samples at the beginning in which the mass is held; 0: it moves freely
  std::size_t first = 0;  ///< first sample of the free motion, where it can be read
  std::string fault;      ///< why it cannot be read
};

[[nodiscard]] FreePart free_part(const History& history);

/// Leaves out the samples before the free part. Returns a warning: what was left out, or that the mass is held and
/// the free part cannot be read; empty if the mass moves from the first sample on.
[[nodiscard]] std::string leave_out_hold(History& history);

/// The time of the last sample at which the mass is held [s].
[[nodiscard]] double end_of_hold(const History& history, const FreePart& part);

}  // namespace dualdamp::identify
