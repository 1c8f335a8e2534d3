#pragma once
/// Further fits of a law where its curve over the severity is not yet known.
///
/// Between two severities the curve is compared with another one through the same fits: makima with the cubic
/// through the four nearest, with few fits a line with a parabola. Where they differ, and the law might be allowed
/// there, a fit is added in the middle.

#include <vector>

#include "identify/methods/any_law/law_profile.hpp"

namespace dualdamp::identify {

/// Adds fits to those of one law with severities of one sign, the mildest first. `near`: orbits of one of them.
void refine(const ReadingModel& model, const departures::Departure& departure, const ChannelNoise& noise,
            NearbyOrbits& near, std::vector<SeverityFit>& fits);

}  // namespace dualdamp::identify
