#include "identify/records/repeats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>

namespace dualdamp::identify {

namespace {

constexpr double rounding = 1e-9;

/// Signals without any change are not compared.
bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || a.size() != b.size()) return false;
  const auto [low, high] = std::ranges::minmax(a);
  const double size = rounding * std::max(std::abs(low), std::abs(high));
  return low < high && std::ranges::equal(a, b, [size](double p, double q) { return std::abs(p - q) <= size; });
}

bool is_same(const History& a, const History& b, bool are_loops) {
  if (are_loops) return is_same(a.force, b.force);
  return is_same(a.x, b.x) || is_same(a.v, b.v) || is_same(a.a, b.a);
}

constexpr std::size_t marks_of_signal = 5;

/// Adds the marks of columns that belong together. Columns without any change have none.
void add_marks(std::initializer_list<const std::vector<double>*> columns, std::vector<double>& marks) {
  // Weights without a period: no two records of a rig, whatever their period, have the same sums.
  constexpr std::array<double, marks_of_signal - 2> steps = {1.0, 1.618033988749895, 2.718281828459045};
  std::array<double, steps.size()> sums{};
  double sizes = 0.0;
  std::size_t count = 0;
  bool changes = false;
  for (const std::vector<double>* column : columns) {
    if (column->empty()) continue;
    const auto [low, high] = std::ranges::minmax(*column);
    changes = changes || low < high;
    const double size = std::max(std::abs(low), std::abs(high));
    if (size > 0.0) sizes += std::log(size);
    for (const double value : *column) {
      ++count;
      const auto i = static_cast<double>(count);
      for (std::size_t k = 0; k < steps.size(); ++k)
        sums[k] += size > 0.0 ? value / size * std::cos(steps[k] * i * i) : 0.0;
    }
  }
  if (!changes) return;
  marks.push_back(static_cast<double>(count));
  marks.push_back(sizes);
  for (const double sum : sums) marks.push_back(sum / std::sqrt(static_cast<double>(count)));
}

bool is_same(const Pair& a, const Pair& b) {
  const auto alike = [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); };
  return a.Y == b.Y && a.x == b.x && a.x > 0.0 && alike(a.omega, b.omega) && alike(a.phase, b.phase);
}

}  // namespace

std::vector<double> marks_of(const Record& record, bool is_loop) {
  std::vector<double> marks;
  for (const History& history : record.histories) {
    if (is_loop) {
      add_marks({&history.force}, marks);
      continue;
    }
    for (const auto* signal : {&history.x, &history.v, &history.a}) add_marks({signal}, marks);
  }
  if (is_loop) return marks;
  if (record.decay) add_marks({&record.decay->extremes}, marks);
  if (!record.pairs) return marks;
  std::array<std::vector<double>, 4> columns;
  for (const Pair& pair : record.pairs->pairs) {
    const std::array<double, 4> values = {pair.x, pair.Y, pair.omega, pair.phase};
    for (std::size_t c = 0; c < values.size(); ++c) columns[c].push_back(std::isnan(values[c]) ? 0.0 : values[c]);
  }
  add_marks({columns.data(), &columns[1], &columns[2], &columns[3]}, marks);
  return marks;
}

bool share_marks(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double most = 4.0 * rounding;
  for (std::size_t i = 0; i + marks_of_signal <= a.size(); i += marks_of_signal)
    for (std::size_t j = 0; j + marks_of_signal <= b.size(); j += marks_of_signal) {
      bool is_same = a[i] == b[j];
      for (std::size_t k = 1; k < marks_of_signal; ++k)
        is_same = is_same && std::abs(a[i + k] - b[j + k]) <= most * std::max(1.0, std::abs(a[i + k]));
      if (is_same) return true;
    }
  return false;
}

bool share_readings(const Record& a, const Record& b, bool are_loops) {
  for (const History& one : a.histories)
    for (const History& other : b.histories)
      if (is_same(one, other, are_loops)) return true;
  if (a.decay && b.decay && is_same(a.decay->extremes, b.decay->extremes)) return true;
  return a.pairs && b.pairs && !a.pairs->pairs.empty() &&
         std::ranges::equal(a.pairs->pairs, b.pairs->pairs,
                            [](const Pair& one, const Pair& other) { return is_same(one, other); });
}

std::vector<std::string> repeated_readings(const Record& record) {
  std::vector<std::string> warnings;
  constexpr auto counts = "; repeated readings count twice, and the intervals are too narrow";
  for (std::size_t i = 0; i < record.histories.size(); ++i)
    for (std::size_t j = i + 1; j < record.histories.size(); ++j)
      if (is_same(record.histories[i], record.histories[j], false))
        warnings.push_back("tests '" + record.histories[i].sweep + "' and '" + record.histories[j].sweep +
                           "' hold the same samples" + counts);
  if (!record.pairs) return warnings;
  std::string numbers;
  const std::vector<Pair>& pairs = record.pairs->pairs;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(j);
    const auto first =
        std::find_if(pairs.begin(), end, [&](const Pair& other) { return is_same(other, pairs[j]); });
    if (first == end) continue;
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(pairs[j].number) + " that of " +
               std::to_string(first->number);
  }
  if (!numbers.empty()) warnings.push_back("pairs are repeated to the last digit: " + numbers + counts);
  return warnings;
}

}  // namespace dualdamp::identify
