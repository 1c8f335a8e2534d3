#pragma once
/// A chart as data: what the SVG writer draws and the page of a comparison gets.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dualdamp::cli {

struct ChartAxis {
  std::string label;
  std::string unit;     ///< of the numbers; empty: none
  bool is_log = false;  ///< all numbers are positive, and a factor lies between neighbours rather than a distance
  bool is_whole = false;
  /// SI unit, and the factor from it, where the unit is one that the user wrote.
  std::optional<std::pair<std::string, double>> written_for = {};
  bool is_asked = false;  ///< that unit, for numbers of any size
};

enum class SeriesKind {
  line,    ///< broken where a number does not exist
  dashed,  ///< such a line
  points,
  cells,  ///< of a grid, whose lines are the distinct x and y of all series together
};

struct ChartSeries {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;  ///< as many; NaN: no value
  SeriesKind kind = SeriesKind::line;
  int colour = 0;  ///< series of one colour belong together
};

struct Chart {
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
};

/// Numbers that are spread by a factor rather than by a distance: a logarithmic axis shows them better.
[[nodiscard]] bool is_geometric(const std::vector<double>& numbers);

}  // namespace dualdamp::cli
