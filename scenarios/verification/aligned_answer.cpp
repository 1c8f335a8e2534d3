#include "scenarios/verification/aligned_answer.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/constants.hpp"

namespace dualdamp::scenarios {

namespace {

/// nullptr: there is none.
template <class Tables>
auto* table_named(Tables& tables, std::string_view name) {
  const auto found = std::ranges::find(tables, name, &Table::name);
  return found == tables.end() ? nullptr : &*found;
}

void swap_rows(Table& table, std::size_t a, std::size_t b) {
  for (Column& column : table.columns) {
    if (column.kind != CellKind::text)
      std::swap(column.numbers[a], column.numbers[b]);
    else if (column.choices.empty())
      std::swap(column.texts[a], column.texts[b]);
    else
      std::swap(column.choices[a], column.choices[b]);
  }
}

void align_events(const Table& events, Table& other, double tolerance) {
  const Column* t = events.find("t");
  const Column* kind = events.find("kind");
  if (t == nullptr || kind == nullptr || t->numbers.empty() || other.size() != events.size()) return;
  const Column* other_t = other.find("t");
  const Column* other_kind = other.find("kind");
  const double near = tolerance * std::abs(t->numbers.back());
  for (std::size_t i = 0; i < events.size(); ++i)
    for (std::size_t j = i; j < events.size() && std::abs(other_t->numbers[j] - t->numbers[i]) <= near; ++j) {
      if (other_kind->text(j) != kind->text(i)) continue;
      if (j > i) swap_rows(other, i, j);
      break;
    }
}

/// The samples of an orbit, beginning with another of its equal parts; the last sample equals the first.
void begin_later(Table& orbit, std::size_t shift) {
  for (Column& column : orbit.columns) {
    if (column.name == "t" || column.kind == CellKind::text) continue;
    std::rotate(column.numbers.begin(), column.numbers.begin() + static_cast<std::ptrdiff_t>(shift),
                column.numbers.end() - 1);
    column.numbers.back() = column.numbers.front();
  }
}

double distance(const Table& orbit, const Table& other) {
  const Column* x = orbit.find("x");
  const Column* other_x = other.find("x");
  double largest = 0.0;
  for (std::size_t i = 0; i < x->numbers.size(); ++i)
    largest = std::max(largest, std::abs(x->numbers[i] - other_x->numbers[i]));
  return largest;
}

/// Number of forcing periods by which the other orbit begins later; that orbit is shifted by them.
int align_orbit(const Table& orbit, Table& other, int periods) {
  const std::size_t part = (orbit.size() - 1) / static_cast<std::size_t>(periods);
  double least = core::infinity;
  int best = 0;
  for (int k = 0; k < periods; ++k, begin_later(other, part))
    if (const double here = distance(orbit, other); here < least) {
      least = here;
      best = k;
    }
  begin_later(other, static_cast<std::size_t>(best) * part);
  return best;
}

/// Shifts the starts of the sticks within the period of the orbit, and sorts the sticks.
void begin_sticks_later(Answer& answer, double shift, double period) {
  Json& sticks = answer.result["sticks"];
  for (Json& stick : sticks) {
    const double start = stick.at("start").get<double>() - shift;
    stick["start"] = start < 0.0 ? start + period : start;
  }
  std::sort(sticks.begin(), sticks.end(),
            [](const Json& a, const Json& b) { return a.at("start") < b.at("start"); });
  Table* table = table_named(answer.tables, "sticks");
  for (std::size_t i = 0; table != nullptr && i < sticks.size(); ++i)
    for (Column& column : table->columns) column.numbers[i] = sticks[i].at(column.name).get<double>();
}

void align_subharmonic(const Answer& answer, Answer& other) {
  if (!answer.result.contains("period_ratio") || !answer.result.contains("sticks")) return;
  const int periods = answer.result.at("period_ratio").get<int>();
  const Table* orbit = table_named(answer.tables, "orbit");
  Table* other_orbit = table_named(other.tables, "orbit");
  if (periods < 2 || other.result.value("period_ratio", 0) != periods) return;
  if (orbit == nullptr || other_orbit == nullptr || orbit->size() != other_orbit->size()) return;
  if (orbit->size() < 2 || (orbit->size() - 1) % static_cast<std::size_t>(periods) != 0) return;
  const int later = align_orbit(*orbit, *other_orbit, periods);
  const double period = answer.result.at("period").get<double>();
  if (later > 0) begin_sticks_later(other, later * period / periods, period);
}

}  // namespace

Answer aligned(const Answer& answer, Answer other, double tolerance) {
  align_subharmonic(answer, other);
  for (const Table& table : answer.tables)
    if (Table* peer = table_named(other.tables, table.name); table.key == "events" && peer != nullptr)
      align_events(table, *peer, tolerance);
  return other;
}

}  // namespace dualdamp::scenarios
