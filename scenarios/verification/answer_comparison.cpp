#include "scenarios/verification/answer_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <utility>

#include "core/angle.hpp"
#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "scenarios/verification/aligned_answer.hpp"
#include "scenarios/verification/telling_events.hpp"
#include "scenarios/verification/time_shift.hpp"

namespace dualdamp::scenarios {

namespace {

/// Two multipliers that are nearly equal move by the square root of an error of the motion, of 1e-8 here.
constexpr double multiplier_tolerance = 1e-4;

/// Numbers about the computation of a result.
bool is_account(const std::string& path) {
  return path.starts_with("certificate") || path == "energy.defect" || path == "fades" || path == "phase_reason";
}

/// "sticks[2].start" in the form of the fields: "sticks[].start".
std::string without_indices(const std::string& path) {
  std::string result;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) result += c;
    if (c == '[') inside = true;
  }
  return result;
}

std::string unit_of(const std::vector<ResultField>& fields, const std::string& path) {
  const auto field = std::ranges::find(fields, without_indices(path), &ResultField::path);
  return field == fields.end() ? "1" : field->unit;
}

/// Numbers, words and truth values of a result by their path.
using Leaves = std::map<std::string, Json>;

void collect(const Json& json, const std::string& path, Leaves& leaves) {
  if (is_account(path) || path == "multipliers" || path == "others") return;
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) collect(value, path.empty() ? key : path + "." + key, leaves);
  } else if (json.is_array()) {
    leaves[path + ".length"] = json.size();
    for (std::size_t i = 0; i < json.size(); ++i) collect(json[i], path + "[" + std::to_string(i) + "]", leaves);
  } else if (!json.is_null()) {
    leaves[path] = json;
  }
}

/// Lists that follow from another list of the result.
bool is_derived(const Table& table) { return table.key == "regimes"; }

/// Rows of a table that are compared: all but grazings.
std::vector<std::size_t> rows_of(const Table& table) {
  const Column* const kind = table.find("kind");
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (kind == nullptr || kind->text(i) != "grazing") rows.push_back(i);
  return rows;
}

/// For tables of samples: the columns that are continuous in time, which a shift of an event by rounding does not
/// change.
bool is_compared(const Table& table, const Column& column) {
  if (column.name.ends_with("reason")) return false;
  return !table.key.empty() || column.name == "t" || column.name == "x" || column.name == "v";
}

/// Whether it is a position or a velocity at a time.
bool is_sample(const Table& table, const Column& column) {
  return table.key.empty() && table.find("t") != nullptr && (column.name == "x" || column.name == "v");
}

/// The largest mean speed between two rows of a motion [m/s], which the motion reaches; at events the speed is
/// often 0.
double fastest_between_rows(const Table& table) {
  const Column* const t = table.find("t");
  const Column* const x = table.find("x");
  if (t == nullptr || x == nullptr || t->unit != "s" || x->unit != "m") return 0.0;
  if (t->numbers.empty()) return 0.0;
  double fastest = 0.0;
  const double rounding = 1e-9 * std::abs(t->numbers.back() - t->numbers.front());
  for (std::size_t i = 1; i < std::min(t->numbers.size(), x->numbers.size()); ++i) {
    const double duration = t->numbers[i] - t->numbers[i - 1];
    if (duration > rounding) fastest = std::max(fastest, std::abs(x->numbers[i] - x->numbers[i - 1]) / duration);
  }
  return fastest;
}

class Comparison {
 public:
  /// `finest`: sizes below which a number of a unit is not known to its tolerance.
  Comparison(const Answer& answer, const Answer& other, const std::vector<ResultField>& fields, SizesOfUnits finest)
      : answer_(answer), other_(other), fields_(fields), sizes_(std::move(finest)) {
    const auto length = sizes_.find("m");
    if (length != sizes_.end()) slow_swing_ = length->second;
  }

  Verification compare() {
    Leaves mine;
    Leaves theirs;
    collect(answer_.result, {}, mine);
    collect(other_.result, {}, theirs);
    size_up(mine);
    find_shift();
    // It follows from the Floquet multipliers, which are compared. With a Floquet multiplier on the unit circle
    // rounding would decide it.
    if (answer_.result.contains("multipliers")) {
      mine.erase("stable");
      theirs.erase("stable");
    }
    // A fundamental near the accuracy of a motion may have a phase by one computation and none by the other.
    if (!mine.contains("phase") || !theirs.contains("phase")) {
      mine.erase("phase");
      theirs.erase("phase");
    }
    for (const auto& [path, value] : mine) compare_leaf(path, value, theirs);
    for (const auto& [path, value] : theirs)
      if (!mine.contains(path)) differ(path, "only the other result has it");
    compare_multipliers();
    compare_others();
    for (const Table& table : answer_.tables)
      if (!is_derived(table)) compare_table(table);
    return std::move(result_);
  }

 private:
  /// The largest value of every unit.
  void size_up(const Leaves& leaves) {
    const auto add = [&](const std::string& unit, double value) {
      if (std::isfinite(value)) sizes_[unit] = std::max(sizes_[unit], std::abs(value));
    };
    for (const auto& [path, value] : leaves)
      if (value.is_number_float()) add(unit_of(fields_, path), value.get<double>());
    for (const Table& table : answer_.tables)
      for (const Column& column : table.columns)
        for (const double value : column.numbers) add(column.unit, value);
    for (const Table& table : answer_.tables) add("m/s", fastest_between_rows(table));
  }

  void differ(const std::string& quantity, const std::string& reason) {
    ++result_.quantities;
    if (!result_.agrees) return;
    result_.agrees = false;
    result_.quantity = quantity;
    result_.largest_difference = 1.0;
    result_.tolerance = 0.0;
    result_.reason = quantity + ": " + reason;
    share_ = core::infinity;
  }

  void add(const std::string& quantity, double difference, double tolerance, double mine, double theirs) {
    ++result_.quantities;
    const double share = difference / tolerance;
    if (share <= share_) return;
    share_ = std::isnan(share) ? core::infinity : share;
    result_.quantity = quantity;
    result_.largest_difference = difference;
    result_.tolerance = tolerance;
    result_.agrees = difference <= tolerance;
    if (!result_.agrees)
      result_.reason =
          quantity + ": " + core::format_number(mine) + ", the other result " + core::format_number(theirs);
  }

  void find_shift() {
    const auto events = std::ranges::find(answer_.tables, "events", &Table::key);
    const auto others = std::ranges::find(other_.tables, "events", &Table::key);
    if (events == answer_.tables.end() || others == other_.tables.end()) return;
    shift_ = TimeShift(*events, telling_rows(*events, rows_of(*events), sizes_["m"]), *others,
                       telling_rows(*others, rows_of(*others), sizes_["m"]));
  }

  /// Numbers at time t [s]; `rate`: of the other one [unit/s].
  void compare_at(double t, const std::string& quantity, const std::string& unit, double mine, double theirs,
                  double rate) {
    const double size = sizes_[unit];
    const double allowed = verification_tolerance(unit) * size;
    const double shift = shift_.at(t, rate, allowed);
    const double shifted = theirs + rate * shift;
    if (!(std::abs(mine - theirs) <= allowed) && std::abs(mine - shifted) < std::abs(mine - theirs)) {
      result_.time_shift = std::max(result_.time_shift, std::abs(shift));
      theirs = shifted;
    }
    compare_numbers(quantity, unit, mine, theirs, size);
  }

  void compare_numbers(const std::string& quantity, const std::string& unit, double mine, double theirs,
                       double size) {
    if (std::isnan(mine) && std::isnan(theirs)) return;
    if (unit == "rad" && (std::isnan(mine) || std::isnan(theirs))) return;
    double gap = std::abs(mine - theirs);
    if (unit == "rad") {
      gap = std::abs(core::wrapped(mine - theirs));
      size = 1.0;
    }
    add(quantity, gap == 0.0 ? 0.0 : gap / size, verification_tolerance(unit), mine, theirs);
  }

  void compare_leaf(const std::string& path, const Json& value, const Leaves& others) {
    const auto other = others.find(path);
    if (other == others.end()) return differ(path, "only this result has it");
    if (value.is_number_float() && other->second.is_number()) {
      const std::string unit = unit_of(fields_, path);
      const double mine = value.get<double>();
      const double theirs = other->second.get<double>();
      if (path == "final.x" || path == "final.v") {
        const double rate = path == "final.x" ? others.at("final.v").get<double>() : other_.final_acceleration;
        return compare_at(others.at("final.t").get<double>(), path, unit, mine, theirs, rate);
      }
      return compare_numbers(path, unit, mine, theirs, sizes_[unit]);
    }
    if (value != other->second) return differ(path, value.dump() + ", the other result " + other->second.dump());
    ++result_.quantities;
  }

  /// Compares each with the nearest of those that are left.
  void compare_multipliers() {
    if (!answer_.result.contains("multipliers") || !other_.result.contains("multipliers")) return;
    std::vector<std::complex<double>> theirs = multipliers_of(other_);
    const std::vector<std::complex<double>> mine = multipliers_of(answer_);
    if (mine.size() != theirs.size()) return differ("multipliers", "another number of them");
    std::vector<std::complex<double>> rest;
    const auto compare = [&](const std::complex<double>& value, double allowed) {
      const auto nearest = std::ranges::min_element(
          theirs, {}, [&](const std::complex<double>& other) { return std::abs(other - value); });
      const double difference = std::abs(*nearest - value) / std::max(1.0, std::abs(value));
      if (!(difference <= allowed)) return rest.push_back(value);
      add("multipliers", difference, multiplier_tolerance, std::abs(value), std::abs(*nearest));
      theirs.erase(nearest);
    };
    for (const std::complex<double>& value : mine) compare(value, multiplier_tolerance);
    if (has_edge(rest, theirs) || has_edge(theirs, rest)) {
      result_.multipliers_left_out = std::ssize(rest);
      return;
    }
    for (const std::complex<double>& value : std::exchange(rest, {})) compare(value, core::infinity);
  }

  static std::vector<std::complex<double>> multipliers_of(const Answer& answer) {
    std::vector<std::complex<double>> result;
    for (const Json& pair : answer.result.at("multipliers"))
      if (pair[0].is_number() && pair[1].is_number()) result.emplace_back(pair[0], pair[1]);
    return result;
  }

  /// Whether one computation has a Floquet multiplier of 1 where the other has 0: a slider that only just reaches
  /// its limit on the orbit sticks in one of them and slips in the other, which moves further multipliers too.
  static bool has_edge(const std::vector<std::complex<double>>& one,
                       const std::vector<std::complex<double>>& other) {
    const auto has = [](const std::vector<std::complex<double>>& list, double value) {
      return std::ranges::any_of(
          list, [value](std::complex<double> each) { return std::abs(each - value) < multiplier_tolerance; });
    };
    return has(one, 1.0) && has(other, 0.0);
  }

  /// Other steady states: each computation lists those that it knows by its own way to the result. Two that are
  /// nearly equal are one.
  void compare_others() {
    if (!answer_.result.contains("others") || !other_.result.contains("others")) return;
    const Json& mine = answer_.result.at("others");
    const Json& theirs = other_.result.at("others");
    std::vector<char> is_met(theirs.size(), 0);
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const auto same = std::ranges::find_if(theirs, [&](const Json& state) { return is_one(mine[i], state); });
      if (same == theirs.end()) {
        ++result_.others_left_out;
        continue;
      }
      is_met[static_cast<std::size_t>(same - theirs.begin())] = 1;
      for (const char* key : {"peak", "trough"})
        compare_numbers("others[" + std::to_string(i) + "]." + key, "m", mine[i].at(key), same->at(key),
                        sizes_["m"]);
    }
    result_.others_left_out += std::ranges::count(is_met, 0);
  }

  bool is_one(const Json& a, const Json& b) {
    constexpr double nearly = 1e-4;
    const auto is_near = [&](const char* key) {
      return std::abs(a.at(key).get<double>() - b.at(key).get<double>()) <= nearly * sizes_["m"];
    };
    return a.at("period_ratio") == b.at("period_ratio") && is_near("peak") && is_near("trough");
  }

  void compare_table(const Table& table) {
    const auto other = std::ranges::find(other_.tables, table.name, &Table::name);
    const std::string& name = table.key.empty() ? table.name : table.key;
    if (other == other_.tables.end()) return differ(name, "the other result has none");
    std::vector<std::size_t> mine = telling_rows(table, rows_of(table), sizes_["m"]);
    std::vector<std::size_t> theirs = telling_rows(*other, rows_of(*other), sizes_["m"]);
    if (table.ends_with_accuracy) {
      mine.resize(std::min(mine.size(), theirs.size()));
      theirs.resize(mine.size());
    }
    if (mine.size() != theirs.size())
      return differ(name, std::to_string(mine.size()) + " rows, the other result " + std::to_string(theirs.size()));
    const std::vector<char> compared = compared_rows(table, mine, *other, theirs);
    const std::vector<char> timed = rows_with_times(table, mine, slow_swing_);
    result_.times_left_out += std::ranges::count(timed, 0);
    for (const Column& column : table.columns) {
      if (!is_compared(table, column)) continue;
      const Column* const peer = other->find(column.name);
      if (peer == nullptr) {
        if (has_cells(column, mine, compared)) differ(name + "[]." + column.name, "only this result has it");
        continue;
      }
      for (std::size_t i = 0; i < mine.size(); ++i)
        if (compared[i] && (timed[i] || column.name != "t"))
          compare_cell(name + "[" + std::to_string(i) + "]." + column.name, table, column, mine[i], *other, *peer,
                       theirs[i]);
    }
  }

  /// Whether a column that only one table has says something in a compared row. Columns for what few rows have are
  /// left out where no row has it.
  static bool has_cells(const Column& column, const std::vector<std::size_t>& rows,
                        const std::vector<char>& compared) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool is_empty =
          column.kind == CellKind::text ? column.text(rows[i]).empty() : std::isnan(column.numbers[rows[i]]);
      if (compared[i] && !is_empty) return true;
    }
    return false;
  }

  /// Rows for which a computation has a reason instead of numbers are not compared. Those are counted for which the
  /// other one has numbers; where both have a reason, they agree.
  std::vector<char> compared_rows(const Table& table, const std::vector<std::size_t>& mine, const Table& other,
                                  const std::vector<std::size_t>& theirs) {
    std::vector<char> result(mine.size(), 1);
    const auto has_reason = [](const Table& t, std::size_t row) {
      const Column* const reason = t.find("reason");
      return reason != nullptr && !reason->text(row).empty();
    };
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const bool one = has_reason(table, mine[i]);
      const bool two = has_reason(other, theirs[i]);
      if (one || two) result[i] = 0;
      result_.rows_left_out += one != two ? 1 : 0;
      result_.rows_without_numbers += one && two ? 1 : 0;
    }
    return result;
  }

  void compare_cell(const std::string& quantity, const Table& table, const Column& column, std::size_t row,
                    const Table& other, const Column& peer, std::size_t peer_row) {
    if (column.kind == CellKind::text) {
      if (column.text(row) != peer.text(peer_row))
        return differ(quantity, column.text(row) + ", the other result " + peer.text(peer_row));
      ++result_.quantities;
      return;
    }
    const double mine = column.numbers[row];
    const double theirs = peer.numbers[peer_row];
    const Column* const rate = is_sample(table, column) ? other.find(column.name == "x" ? "v" : "a") : nullptr;
    if (rate != nullptr)
      return compare_at(table.find("t")->numbers[row], quantity, column.unit, mine, theirs,
                        rate->numbers[peer_row]);
    if (column.kind == CellKind::number) {
      // Each point of a curve is a separate motion.
      const double size = table.key == "points" ? std::abs(mine) : sizes_[column.unit];
      return compare_numbers(quantity, column.unit, mine, theirs, size);
    }
    if (mine != theirs && !(std::isnan(mine) && std::isnan(theirs)))
      return differ(quantity, core::format_number(mine) + ", the other result " + core::format_number(theirs));
    ++result_.quantities;
  }

  const Answer& answer_;
  const Answer& other_;
  const std::vector<ResultField>& fields_;
  SizesOfUnits sizes_;
  TimeShift shift_;
  double slow_swing_ = 0.0;  ///< length of a swing below which the times of its ends are not known [m]
  double share_ = -1.0;
  Verification result_;
};

}  // namespace

double verification_tolerance(std::string_view unit) {
  // A force acts on the motion, so a length is as good as a velocity. The time of an event and a work are integrals
  // and roots of them.
  constexpr double of_motion = 1e-7;
  constexpr double of_times_and_works = 1e-6;
  return unit == "m" || unit == "m/s" || unit == "N" ? of_motion : of_times_and_works;
}

Verification compare_answers(const Answer& answer, const Answer& other, const std::vector<ResultField>& fields,
                             const SizesOfUnits& finest) {
  return Comparison(answer, aligned(answer, other, verification_tolerance("s")), fields, finest).compare();
}

}  // namespace dualdamp::scenarios
