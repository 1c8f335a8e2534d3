#include "cli/print.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "core/numbers.hpp"
#include "core/utf8.hpp"
#include "scenarios/results/shown_table.hpp"
#include "scenarios/results/shown_units.hpp"

namespace dualdamp::cli {

namespace {

constexpr std::size_t max_rows = 20;
constexpr int digits = 9;

struct Block {
  std::vector<std::string> cells;  ///< the heading first
  bool is_number = false;
};

/// A micro sign is one column wide.
std::size_t width(const std::string& text) { return core::count_characters(text); }

std::string cell(const scenarios::Column& column, std::size_t row) {
  if (column.kind == scenarios::CellKind::text) return column.text(row);
  const auto text = [&](double number) { return core::format_number(number, column.digits); };
  if (!std::isfinite(column.numbers[row])) return "-";
  if (column.intervals.empty() || std::isnan(column.intervals[row][0])) return text(column.numbers[row]);
  const auto& [low, high] = column.intervals[row];
  return text(column.numbers[row]) + " (" + text(low) + " to " + text(high) + ")";
}

Block block(const scenarios::Column& column) {
  Block result;
  result.is_number = column.kind != scenarios::CellKind::text && column.intervals.empty();
  result.cells.push_back(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  for (std::size_t row = 0; row < column.size(); ++row) result.cells.push_back(cell(column, row));
  return result;
}

std::string aligned(const std::vector<Block>& blocks) {
  std::string text;
  const std::size_t lines = blocks.empty() ? 0 : blocks.front().cells.size();
  for (std::size_t line = 0; line < lines; ++line) {
    std::string row;
    for (const Block& block : blocks) {
      std::size_t widest = 0;
      for (const std::string& cell : block.cells) widest = std::max(widest, width(cell));
      const std::string padding(widest - width(block.cells[line]), ' ');
      row += "  " + (block.is_number ? padding + block.cells[line] : block.cells[line] + padding);
    }
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// Where all rows of a printed table are: in its own file, or in that with the same first column; nullptr: in none.
const scenarios::Table* file_with_rows_of(const scenarios::Table& table,
                                          const std::vector<scenarios::Table>& tables) {
  if (table.is_file) return &table;
  const auto same = std::ranges::find_if(tables, [&](const scenarios::Table& other) {
    return other.is_file && !other.columns.empty() && other.columns.front().texts == table.columns.front().texts &&
           other.columns.front().numbers == table.columns.front().numbers && other.size() == table.size();
  });
  return same == tables.end() ? nullptr : &*same;
}

/// The headings and the first rows of a table.
std::string table_text(const scenarios::Table& table, const std::vector<scenarios::Table>& tables,
                       const scenarios::ShownUnits& units) {
  const std::size_t all = table.columns.empty() ? 0 : table.columns.front().size();
  const std::size_t rows = std::min(all, max_rows);
  std::vector<Block> blocks;
  for (const scenarios::Column& column : scenarios::in_shown_units(table, units, rows).columns)
    blocks.push_back(block(column));
  std::string text = aligned(blocks);
  if (rows == all) return text;
  const scenarios::Table* file = file_with_rows_of(table, tables);
  return text + "  ... " + std::to_string(all - rows) + " more row" + (all - rows == 1 ? "" : "s") +
         (file == nullptr ? "" : " in " + file->name + ".csv") + "\n";
}

constexpr std::string_view certificate = "certificate.";

/// The single numbers of a result, without its certificate.
std::string numbers_text(const scenarios::Table& summary) {
  std::vector<Block> blocks;
  for (const scenarios::Column& column : summary.columns) {
    Block& shown = blocks.emplace_back(Block{{column.name}});
    for (std::size_t i = 0; i < summary.size(); ++i)
      if (!summary.columns[0].texts[i].starts_with(certificate)) shown.cells.push_back(column.texts[i]);
  }
  if (blocks.front().cells.size() == 1) return {};
  blocks[1].is_number = true;  // aligned at the right, like numbers
  return "\n" + aligned(blocks);
}

/// The certificate of the result, on one line.
std::string certificate_text(const scenarios::Table& summary) {
  std::string text;
  for (std::size_t i = 0; i < summary.size(); ++i)
    if (const std::string& name = summary.columns[0].texts[i]; name.starts_with(certificate))
      text += (text.empty() ? "\ncertificate: " : ", ") + summary.columns[1].texts[i] + " " +
              name.substr(certificate.size());
  return text.empty() ? text : text + "\n";
}

/// The words of a text in lines of at most `widest` characters; a longer word has a line of its own.
std::vector<std::string> lines_of(const std::string& text, std::size_t widest) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > widest) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

/// The paragraph, broken into lines that fit a terminal.
std::string folded(const std::string& paragraph) {
  constexpr std::size_t widest = 100;
  std::string text;
  for (const std::string& line : lines_of(paragraph, widest)) text += (text.empty() ? "" : "\n") + line;
  return text;
}

std::string checks_text(const std::vector<scenarios::Check>& checks) {
  std::vector<std::vector<std::string>> rows = {{"value", "expected", "found", "difference", "ok", "source"}};
  for (const scenarios::Check& check : checks) {
    const auto found = core::parse_number(check.found);
    rows.push_back({check.path, check.expected,
                    found.value ? core::format_number(*found.value, digits) : check.found,
                    check.difference ? core::format_number(*check.difference, 3) : "-", check.ok ? "yes" : "NO",
                    check.source});
  }
  return columns(rows);
}

std::string verification_text(const scenarios::Verification& verification) {
  std::string text = "verified by " + verification.engine + ": ";
  if (verification.quantity.empty())
    return text + (verification.agrees ? "nothing to compare" : verification.reason);
  const auto rows = [](long count) { return std::to_string(count) + (count == 1 ? " row has " : " rows have "); };
  if (verification.rows_left_out > 0)
    text += rows(verification.rows_left_out) + "a number in only one of the two computations, ";
  if (verification.rows_without_numbers > 0)
    text += rows(verification.rows_without_numbers) + "a reason in place of a number in both, ";
  if (verification.others_left_out > 0)
    text += std::to_string(verification.others_left_out) +
            " of the other steady states known in only one of the two computations, ";
  if (verification.times_left_out > 0)
    text += std::to_string(verification.times_left_out) + (verification.times_left_out == 1 ? " time" : " times") +
            " of events left out at which the mass hardly moves, ";
  if (verification.multipliers_left_out > 0)
    text += std::to_string(verification.multipliers_left_out) +
            " of the Floquet multipliers depend on a slider that only just reaches its limit, ";
  if (verification.time_shift > 0.0)
    text += "events up to " + core::format_number(verification.time_shift, 2) +
            " s apart as their errors add up, numbers at a given time compared as long after the last of them, ";
  return text + "largest difference " + core::format_number(verification.largest_difference, 2) + " (" +
         verification.quantity + ", " + core::format_number(verification.tolerance, 2) + " allowed) of " +
         std::to_string(verification.quantities) +
         " quantities: " + (verification.agrees ? "agrees" : "DOES NOT AGREE: " + verification.reason);
}

}  // namespace

std::string columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<Block> blocks(rows.empty() ? 0 : rows.front().size());
  for (const std::vector<std::string>& row : rows)
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].cells.push_back(row[i]);
  return aligned(blocks);
}

std::string folded_columns(const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t widest = 40;
  constexpr std::size_t widest_last = 72;
  std::vector<std::vector<std::string>> lines;
  for (const std::vector<std::string>& row : rows) {
    const std::size_t first = lines.size();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::vector<std::string> parts = lines_of(row[i], i + 1 < row.size() ? widest : widest_last);
      if (lines.size() < first + parts.size())
        lines.resize(first + parts.size(), std::vector<std::string>(row.size()));
      for (std::size_t k = 0; k < parts.size(); ++k) lines[first + k][i] = parts[k];
    }
  }
  return columns(lines);
}

std::string readable(const scenarios::Scenario& scenario, const scenarios::RunResult& result) {
  const scenarios::ShownUnits units = scenarios::shown_units(scenario.written_units);
  std::string text = scenario.file + ": " + scenario.analysis_name;
  if (!scenario.title.empty()) text += ": " + scenario.title;
  text += "\n";
  if (!result.sentence.empty()) text += "\n" + folded(result.sentence) + "\n";
  text += numbers_text(result.summary);
  for (const scenarios::Table& table : result.tables)
    if (!table.is_long && table.columns.front().size() > 0) text += "\n" + table_text(table, result.tables, units);
  if (!result.checks.empty()) text += "\n" + checks_text(result.checks);
  if (result.verification) text += "\n" + folded(verification_text(*result.verification)) + "\n";
  text += certificate_text(result.summary);
  return text;
}

void show(const scenarios::Progress& progress) {
  std::cerr << "\r\x1b[K" << progress.done << " of " << progress.all << " cases, "
            << core::format_number(progress.rate, 3) << " a second";
  if (progress.done < progress.all)
    std::cerr << ", " << core::format_number(std::ceil(progress.remaining), 3) << " s left" << std::flush;
  else
    std::cerr << "\n";
}

}  // namespace dualdamp::cli
