#pragma once
/// A chart as an SVG file: axes with units and ticks, series, a legend. Light where nothing else is known, as on
/// paper; dark where the viewer asks for it. Series differ in colour and in their dashes.

#include <iosfwd>

#include "cli/report/chart.hpp"

namespace dualdamp::cli {

/// Long lines are thinned out to what can be seen: first, last, lowest and highest point of each half pixel.
void write_svg(std::ostream& out, const Chart& chart);

}  // namespace dualdamp::cli
