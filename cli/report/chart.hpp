#pragma once
/// A chart as data, for the SVG writer and for the page of a comparison.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dualdamp::cli {

struct ChartAxis {
  std::string label;
  std::string unit;       ///< of the numbers; empty: none
  bool is_log = false;    ///< logarithmic; all numbers must be positive
  bool is_whole = false;  ///< integers
  /// SI unit, and the factor from SI to `unit`, if `unit` is one that the user wrote.
  std::optional<std::pair<std::string, double>> written_for = {};
  bool is_asked = false;  ///< the unit is used for numbers of any size (`--show-in`)
};

enum class SeriesKind {
  line,    ///< with a gap where a number does not exist
  dashed,  ///< a dashed line, with the same gaps
  points,
  cells,  ///< cells of a grid; the grid has the distinct x and y of all series
};

/// Number of the colour of measured points: grey.
inline constexpr int colour_of_data = 6;

struct ChartSeries {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;  ///< of the length of x; NaN: no value
  SeriesKind kind = SeriesKind::line;
  int colour = 0;            ///< number of its colour; related series have the same one
  bool is_measured = false;  ///< data, which several results may share
};

struct Chart {
  std::string title;
  std::string note;  ///< what the chart leaves out; empty: nothing
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
};

/// Whether a logarithmic axis suits the numbers: their ratios, rather than their differences, are even.
[[nodiscard]] bool is_geometric(const std::vector<double>& numbers);

}  // namespace dualdamp::cli
