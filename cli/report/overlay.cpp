#include "cli/report/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace dualdamp::cli {

namespace {

/// A name such as fit_0_x: the number of the record, and the signal.
struct CurveName {
  std::string record;
  std::string signal;
};

std::optional<CurveName> curve_name(const std::string& table, std::string_view prefix) {
  const std::size_t end = prefix.size();
  const std::size_t second = table.find('_', end + 1);
  if (!table.starts_with(prefix) || table.size() <= end || table[end] != '_' || second == std::string::npos)
    return std::nullopt;
  return CurveName{table.substr(end + 1, second - end - 1), table.substr(second + 1)};
}

/// The lines of steady states: one for each level. The amplitudes of a level, or its frequencies, may differ by
/// what a measurement of them misses.
std::vector<Rows> lines_of_levels(const StoredColumn& x, const StoredColumn& level, const Rows& rows) {
  constexpr double same = 1.03;
  std::vector<Rows> lines;
  double first = 0.0;
  for (const std::size_t row : in_order_of(level, rows)) {
    if (lines.empty() || level.numbers[row] > same * first) {
      lines.emplace_back();
      first = level.numbers[row];
    }
    lines.back().push_back(row);
  }
  for (Rows& line : lines) line = in_order_of(x, line);
  return lines;
}

}  // namespace

Rows in_order_of(const StoredColumn& column, Rows rows) {
  // Points without a number come last.
  const auto place = [&](std::size_t row) {
    return std::pair(std::isnan(column.numbers[row]), std::isnan(column.numbers[row]) ? 0.0 : column.numbers[row]);
  };
  std::ranges::stable_sort(rows, {}, place);
  return rows;
}

std::optional<Overlay> overlay_of(const StoredRun& run, std::string_view prefix) {
  constexpr std::array<std::string_view, 4> signals = {"x", "force", "v", "a"};
  Overlay overlay;
  std::set<std::string> records;
  auto rank = signals.size();
  for (const std::filesystem::path& path : run.tables()) {
    const std::optional<CurveName> name = curve_name(path.stem().string(), prefix);
    if (!name) continue;
    records.insert(name->record);
    const auto here = static_cast<std::size_t>(std::ranges::find(signals, name->signal) - signals.begin());
    if (name->record != "0" || here >= rank) continue;
    rank = here;
    overlay.signal = name->signal;
  }
  if (overlay.signal.empty()) return std::nullopt;
  overlay.records = records.size();
  overlay.table = run.table(std::string(prefix) + "_0_" + overlay.signal);
  const std::vector<StoredColumn>& columns = overlay.table.columns;
  const auto measured = std::ranges::find(columns, "measured", &StoredColumn::name);
  if (measured == columns.begin() || columns.end() - measured < 2)
    throw ChangedResult("a table of measured values has no computed ones");
  overlay.computed = std::next(measured)->name;
  Rows rows(columns.front().numbers.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const bool is_sampled = columns.front().name == "t" || columns.front().name == "number";
  const bool is_loop = is_sampled && columns[1].name == "x";
  overlay.x = columns[is_loop ? 1 : 0].name;
  if (is_sampled)
    overlay.lines = {std::move(rows)};
  else if (columns[1].name == "measured")
    overlay.lines = {in_order_of(columns.front(), std::move(rows))};
  else
    overlay.lines = lines_of_levels(columns.front(), columns[1], rows);
  constexpr std::size_t few = 60;
  overlay.is_dense = is_sampled && columns.front().numbers.size() > few;
  return overlay;
}

}  // namespace dualdamp::cli
