#pragma once
/// Writes a chart as an SVG file: axes with units and ticks, series, a legend. Its colours are light by default, as
/// on paper, and dark if the viewer asks for a dark scheme. Series differ in colour and in their dashes.

#include <iosfwd>

#include "cli/report/chart.hpp"

namespace dualdamp::cli {

/// Long lines are thinned out to the visible points: the first, last, lowest and highest one of each half pixel.
void write_svg(std::ostream& out, const Chart& chart);

}  // namespace dualdamp::cli
