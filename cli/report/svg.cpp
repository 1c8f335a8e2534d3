#include "cli/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "core/utf8.hpp"

namespace dualdamp::cli {

namespace {

constexpr double width = 720.0;
constexpr double plot_height = 380.0;
constexpr double top = 40.0;
constexpr double right = 20.0;
constexpr double letter = 6.8;  ///< width of a letter of 12 px, approximately
constexpr double line_height = 20.0;

/// The colours of the page on a light and on a dark background (page.css).
struct Paint {
  std::string_view light;
  std::string_view dark;
};
constexpr std::array paints = {Paint{"#0072b2", "#56b4e9"}, Paint{"#d55e00", "#ff8a3d"},
                               Paint{"#009e73", "#3ccf9e"}, Paint{"#a1478a", "#e59ad0"},
                               Paint{"#8a6d00", "#e6c229"}, Paint{"#3a88c5", "#a3cdf0"},
                               Paint{"#6b6b6b", "#b0b0b0"}};
constexpr std::array<std::string_view, 5> dashes = {"", "8 3", "3 3", "10 3 3 3", "1 3"};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) >= ' ')
      result += c;
  }
  return result;
}

double text_width(std::string_view text) { return letter * static_cast<double>(core::count_characters(text)); }

/// Conversion of numbers to pixels.
class Scale {
 public:
  Scale(const ChartAxis& axis, double low, double high, double from, double to)
      : axis_(axis), low_(low), high_(high), from_(from), to_(to) {}

  [[nodiscard]] double operator()(double value) const {
    return from_ + (to_ - from_) * (linear(value) - linear(low_)) / (linear(high_) - linear(low_));
  }
  [[nodiscard]] std::vector<double> ticks(int count) const {
    std::vector<double> list;
    if (axis_.is_log) list = decades();
    return list.size() > 2 ? list : round_numbers(count);
  }

 private:
  [[nodiscard]] double linear(double value) const { return axis_.is_log ? std::log(value) : value; }

  /// Ticks at 1, 2 and 5 times the powers of ten; only at the powers if there would be too many.
  [[nodiscard]] std::vector<double> decades() const {
    std::vector<double> list;
    for (double power = std::floor(std::log10(low_)); power <= std::log10(high_); ++power)
      for (const double step : {1.0, 2.0, 5.0}) {
        const double value = step * std::pow(10.0, power);
        if (value >= low_ && value <= high_ && (step == 1.0 || high_ / low_ < 1e4)) list.push_back(value);
      }
    return list;
  }

  [[nodiscard]] std::vector<double> round_numbers(int count) const {
    const double raw = (high_ - low_) / count;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10.0 * power;
    for (const double factor : {5.0, 2.0, 1.0})
      if (factor * power >= raw) step = factor * power;
    if (axis_.is_whole) step = std::max(1.0, step);
    std::vector<double> list;
    for (double i = std::ceil(low_ / step); i * step <= high_; ++i) list.push_back(i == 0.0 ? 0.0 : i * step);
    return list;
  }

  const ChartAxis& axis_;
  double low_, high_, from_, to_;
};

/// The smallest and the largest finite number, with a margin.
std::pair<double, double> extent(const Chart& chart, std::vector<double> ChartSeries::* list,
                                 const ChartAxis& axis) {
  double low = core::infinity;
  double high = -low;
  for (const ChartSeries& series : chart.series)
    for (const double value : series.*list)
      if (std::isfinite(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  if (low > high) return axis.is_log ? std::pair(1.0, 10.0) : std::pair(0.0, 1.0);
  if (axis.is_log) return {low / 1.05, high * 1.05};
  const double span = std::max(high - low, 1.0);
  if (axis.is_whole) return {low - 0.05 * span, low + 1.05 * span};
  // The labels of a narrower span would have more digits than fit, and its curve is one of rounding. Times may be
  // counted from long ago.
  const double narrow = axis.unit == "s" ? 0.0 : 1e-5;
  const double size = std::max(std::abs(low), std::abs(high));
  const double room = high - low > narrow * size ? 0.05 * (high - low) : size == 0.0 ? 1.0 : 0.1 * size;
  return {low - room, high + room};
}

std::string tick_text(double value, double step) {
  constexpr int digits = 6;
  const int needed = static_cast<int>(std::ceil(std::log10(std::max(std::abs(value), step) / step))) + 1;
  return core::format_number(value, std::max(digits, needed));
}

std::string title_of(const ChartAxis& axis) {
  return axis.unit.empty() || axis.unit == "1" ? axis.label : axis.label + " [" + axis.unit + "]";
}

class Drawing {
 public:
  Drawing(std::ostream& out, const Chart& chart) : out_(out), chart_(chart) {}

  void write() {
    const auto [x_low, x_high] = extent(chart_, &ChartSeries::x, chart_.x);
    const auto [y_low, y_high] = extent(chart_, &ChartSeries::y, chart_.y);
    const double bottom = top + plot_height;
    const Scale y(chart_.y, y_low, y_high, bottom, top);
    const std::vector<std::string> y_texts = texts(y.ticks(7));
    double widest = 0.0;
    for (const std::string& text : y_texts) widest = std::max(widest, text_width(text));
    const double left = 40.0 + widest;
    const Scale x(chart_.x, x_low, x_high, left, width - right);
    begin(left);
    axes(x, y, left, y_texts);
    out_ << fmt::format(
                "<clipPath id=\"plot\"><rect x=\"{:.2f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\"/></clipPath>\n",
                left, top, width - right - left, plot_height)
         << "<g clip-path=\"url(#plot)\">\n";
    for (const ChartSeries& series : chart_.series) draw(series, x, y);
    out_ << "</g>\n";
    legend(left, bottom + 62.0);
    out_ << "</svg>\n";
  }

 private:
  [[nodiscard]] static std::vector<std::string> texts(const std::vector<double>& ticks) {
    std::vector<std::string> result;
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    for (const double tick : ticks) result.push_back(tick_text(tick, step));
    return result;
  }

  /// The keys of the legend. Series of the same label share a key.
  [[nodiscard]] std::vector<const ChartSeries*> keys() const {
    std::vector<const ChartSeries*> list;
    for (const ChartSeries& series : chart_.series)
      if (std::ranges::none_of(list, [&](const ChartSeries* key) { return key->label == series.label; }))
        list.push_back(&series);
    return list.size() > 1 ? list : std::vector<const ChartSeries*>();
  }

  /// The position of each key of the legend.
  [[nodiscard]] std::vector<std::pair<double, double>> places(double left) const {
    std::vector<std::pair<double, double>> list;
    double x = left;
    double y = 0.0;
    for (const ChartSeries* key : keys()) {
      const double size = 48.0 + text_width(key->label);
      if (x > left && x + size > width - right) {
        x = left;
        y += line_height;
      }
      list.emplace_back(x, y);
      x += size;
    }
    return list;
  }

  void begin(double left) {
    const auto list = places(left);
    const double legend = list.empty() ? 0.0 : list.back().second + line_height + 8.0;
    const double height = top + plot_height + 52.0 + legend;
    out_ << fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" height=\"{1:.0f}\" "
        "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" "
        "role=\"img\">\n<title>{2}</title>\n<style>\n",
        width, height, escaped(chart_.title));
    out_ << "@media screen and (prefers-color-scheme: dark) { .ground { fill: #14171a } .ink { fill: #e8eaed } "
            ".soft { fill: #a9b1ba } .grid { stroke: #3a424b }";
    for (std::size_t i = 0; i < paints.size(); ++i)
      out_ << fmt::format(" .s{0} {{ stroke: {1} }} .f{0} {{ fill: {1}; stroke: {1} }}", i, paints[i].dark);
    out_ << " }\n</style>\n"
         << fmt::format("<rect class=\"ground\" width=\"{}\" height=\"{:.0f}\" fill=\"#ffffff\"/>\n", width, height)
         << fmt::format(
                "<text class=\"ink\" x=\"{:.2f}\" y=\"24\" font-size=\"15\" font-weight=\"bold\" "
                "fill=\"#1b1f24\">{}</text>\n",
                left, escaped(chart_.title + (chart_.note.empty() ? "" : ": " + chart_.note)));
  }

  void label(const std::string& text, const std::string& place, std::string_view anchor = "middle") {
    out_ << "<text class=\"soft\" fill=\"#57606a\" text-anchor=\"" << anchor << "\" " << place << ">"
         << escaped(text) << "</text>\n";
  }

  void axes(const Scale& x, const Scale& y, double left, const std::vector<std::string>& y_texts) {
    const double bottom = top + plot_height;
    const std::vector<double> x_ticks = x.ticks(8);
    const std::vector<std::string> x_texts = texts(x_ticks);
    const std::vector<double> y_ticks = y.ticks(7);
    out_ << "<path class=\"grid\" stroke=\"#d5dae0\" fill=\"none\" d=\"";
    for (const double tick : x_ticks) out_ << fmt::format("M{:.2f},{:.2f}V{:.2f}", x(tick), top, bottom);
    for (const double tick : y_ticks) out_ << fmt::format("M{:.2f},{:.2f}H{:.2f}", left, y(tick), width - right);
    out_ << "\"/>\n";
    for (std::size_t i = 0; i < x_ticks.size(); ++i)
      label(x_texts[i], fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", x(x_ticks[i]), bottom + 16.0));
    for (std::size_t i = 0; i < y_ticks.size(); ++i)
      label(y_texts[i], fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", left - 6.0, y(y_ticks[i]) + 4.0), "end");
    label(title_of(chart_.x), fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", (left + width - right) / 2, bottom + 38.0));
    label(title_of(chart_.y), fmt::format("transform=\"translate(16,{:.2f}) rotate(-90)\"", (top + bottom) / 2));
  }

  [[nodiscard]] static std::string stroke(const ChartSeries& series) {
    const auto index = static_cast<std::size_t>(series.colour);
    const std::size_t paint = index % paints.size();
    const std::string_view dash = series.kind == SeriesKind::dashed ? "6 4"
                                  : series.is_measured              ? ""
                                                                    : dashes[index % dashes.size()];
    return fmt::format("class=\"s{}\" stroke=\"{}\" fill=\"none\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{}",
                       paint, paints[paint].light,
                       dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash));
  }

  [[nodiscard]] static std::string filled(const ChartSeries& series) {
    const std::size_t paint = static_cast<std::size_t>(series.colour) % paints.size();
    return fmt::format("class=\"f{0}\" stroke=\"{1}\" fill=\"{1}\" stroke-width=\"0.5\"", paint,
                       paints[paint].light);
  }

  void draw(const ChartSeries& series, const Scale& x, const Scale& y) {
    if (series.kind == SeriesKind::cells) return cells(series, x, y);
    if (series.kind == SeriesKind::points) {
      out_ << "<path " << filled(series) << " d=\"";
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
          out_ << fmt::format("M{:.2f},{:.2f}m-2.5,0a2.5,2.5 0 1,0 5,0a2.5,2.5 0 1,0 -5,0", x(series.x[i]),
                              y(series.y[i]));
      out_ << "\"/>\n";
      return;
    }
    out_ << "<path " << stroke(series) << " d=\"";
    line(series, x, y);
    out_ << "\"/>\n";
  }

  /// The first, lowest, highest and last one of consecutive points in the same column of half a pixel.
  void line(const ChartSeries& series, const Scale& x, const Scale& y) {
    std::vector<std::pair<double, double>> column;
    bool is_open = false;
    const auto put = [&](const std::pair<double, double>& point) {
      out_ << fmt::format("{}{:.2f},{:.2f}", is_open ? "L" : "M", point.first, point.second);
      is_open = true;
    };
    const auto flush = [&] {
      if (column.size() <= 4) {
        for (const auto& point : column) put(point);
      } else {
        auto [low, high] = std::ranges::minmax_element(column, {}, &std::pair<double, double>::second);
        if (high < low) std::swap(low, high);
        for (const auto& point : {column.front(), *low, *high, column.back()}) put(point);
      }
      column.clear();
    };
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const std::pair point(x(series.x[i]), y(series.y[i]));
      if (!std::isfinite(point.first) || !std::isfinite(point.second)) {
        flush();
        is_open = false;
        continue;
      }
      if (!column.empty() && std::floor(2.0 * point.first) != std::floor(2.0 * column.back().first)) flush();
      column.push_back(point);
    }
    flush();
  }

  /// Distinct numbers of all series, as pixels in ascending order of the numbers.
  [[nodiscard]] std::vector<double> grid_lines(std::vector<double> ChartSeries::* list) const {
    std::vector<double> lines;
    for (const ChartSeries& series : chart_.series)
      if (series.kind == SeriesKind::cells) lines.insert(lines.end(), (series.*list).begin(), (series.*list).end());
    std::ranges::sort(lines);
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
  }

  /// Begin and end of a cell: half way to its neighbours.
  [[nodiscard]] static std::pair<double, double> sides(const std::vector<double>& lines, double value,
                                                       const Scale& scale) {
    const auto at = static_cast<std::size_t>(std::ranges::lower_bound(lines, value) - lines.begin());
    const double here = scale(value);
    if (lines.size() == 1) return {here - 20.0, here + 20.0};
    const double before = at > 0 ? (scale(lines[at - 1]) + here) / 2 : here - (scale(lines[1]) - here) / 2;
    const double after =
        at + 1 < lines.size() ? (scale(lines[at + 1]) + here) / 2 : here + (here - scale(lines[at - 1])) / 2;
    return std::minmax(before, after);
  }

  void cells(const ChartSeries& series, const Scale& x, const Scale& y) {
    const std::vector<double> columns = grid_lines(&ChartSeries::x);
    const std::vector<double> rows = grid_lines(&ChartSeries::y);
    out_ << "<path " << filled(series) << " d=\"";
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const auto [left, right_side] = sides(columns, series.x[i], x);
      const auto [upper, lower] = sides(rows, series.y[i], y);
      out_ << fmt::format("M{:.2f},{:.2f}H{:.2f}V{:.2f}H{:.2f}Z", left, upper, right_side, lower, left);
    }
    out_ << "\"/>\n";
  }

  void legend(double left, double y) {
    const std::vector<const ChartSeries*> list = keys();
    const auto at = places(left);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto [x, row] = at[i];
      const bool is_line = list[i]->kind == SeriesKind::line || list[i]->kind == SeriesKind::dashed;
      if (is_line)
        out_ << fmt::format("<path {} d=\"M{:.2f},{:.2f}h24\"/>\n", stroke(*list[i]), x, y + row - 4.0);
      else
        out_ << fmt::format("<path {} d=\"M{:.2f},{:.2f}h10v10h-10Z\"/>\n", filled(*list[i]), x + 8.0,
                            y + row - 9.0);
      label(list[i]->label, fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", x + 30.0, y + row), "start");
    }
  }

  std::ostream& out_;
  const Chart& chart_;
};

}  // namespace

bool is_geometric(const std::vector<double>& numbers) {
  std::vector<double> steps;
  for (const double number : numbers)
    if (std::isfinite(number)) steps.push_back(number);
  std::ranges::sort(steps);
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  constexpr double least_span = 8.0;
  if (steps.size() < 4 || steps.front() <= 0.0 || steps.back() < least_span * steps.front()) return false;
  const double first = steps[1] / steps[0];
  const double last = steps.back() / steps[steps.size() - 2];
  return std::abs(std::log(first / last)) < 0.2;
}

void write_svg(std::ostream& out, const Chart& chart) { Drawing(out, chart).write(); }

}  // namespace dualdamp::cli
