#include "identify/readers/data_table.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <tuple>
#include <utility>

#include "core/numbers.hpp"
#include "core/units.hpp"
#include "identify/readers/record_reader.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t most_problems = 20;
constexpr std::size_t fewest_samples = 16;
/// A stretch shorter than this share of the rows says little about the measurement.
constexpr double least_share = 0.1;
/// Larger steps are gaps.
constexpr double gap = 1.5;
constexpr std::size_t most_lone_gaps = 2;
/// Jitter of a clock that makes no difference, as a share of a step.
constexpr double clock_jitter = 0.01;

/// Rows [first, last) of one test.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
  [[nodiscard]] std::size_t size() const { return last - first; }
};

class Assembly {
 public:
  Assembly(DataTable table, Problems& problems, std::vector<std::string>& warnings)
      : table_(std::move(table)), problems_(problems), warnings_(warnings) {}

  Record run() {
    Record record;
    if (table_.find("Y") != nullptr)
      record.pairs = pairs();
    else if (holds_extremes())
      record.decay = decay();
    else
      record.histories = histories();
    return record;
  }

 private:
  [[nodiscard]] const std::vector<double>* values(std::string_view name) const {
    const DataColumn* column = table_.find(name);
    return column == nullptr ? nullptr : &column->values;
  }

  void complain(std::size_t row, std::string_view name, std::string message, std::string allowed) {
    core::Diagnostic problem =
        table_.show(row, table_.find(name) == nullptr ? *known_column(name) : *table_.find(name)->known);
    problem.message = std::move(message);
    problem.allowed = std::move(allowed);
    problems_.add(std::move(problem));
  }

  void warn_unused(std::initializer_list<std::string_view> used) {
    for (const DataColumn& column : table_.columns)
      if (std::find(used.begin(), used.end(), column.known->name) == used.end())
        warnings_.push_back("column " + std::string(column.known->name) + " is not used");
    if (!table_.sweeps.empty() && std::find(used.begin(), used.end(), "sweep") == used.end())
      warnings_.emplace_back("column sweep is not used");
  }

  void refuse_below(std::string_view name, bool zero_too, const std::string& what) {
    const std::vector<double>* column = values(name);
    if (column == nullptr) return;
    for (std::size_t row = 0; row < column->size(); ++row) {
      const double value = (*column)[row];
      if (value < 0.0)
        complain(row, name, what + " of column " + std::string(name) + " is negative", "a number not below zero");
      else if (zero_too && value == 0.0)
        complain(row, name, what + " of column " + std::string(name) + " is zero", "a number above zero");
    }
  }

  [[nodiscard]] std::vector<std::string> labels() const {
    std::vector<std::string> result(table_.rows());
    for (std::size_t i = 0; i < table_.sweeps.size(); ++i) {
      const std::size_t end = i + 1 < table_.sweeps.size() ? table_.sweeps[i + 1].first_row : result.size();
      for (std::size_t row = table_.sweeps[i].first_row; row < end; ++row) result[row] = table_.sweeps[i].label;
    }
    return result;
  }

  PairRecord pairs() {
    warn_unused({"Y", "x", "omega", "phase", "fundamental", "mean_square_speed", "sweep"});
    refuse_below("Y", false, "the amplitude");
    refuse_below("x", false, "the amplitude");
    refuse_below("fundamental", false, "the amplitude");
    refuse_below("mean_square_speed", false, "the mean square");
    refuse_below("omega", true, "the frequency");
    const std::vector<std::string> sweeps = labels();
    PairRecord record;
    record.pairs.resize(table_.rows());
    for (std::size_t row = 0; row < record.pairs.size(); ++row) {
      Pair& pair = record.pairs[row];
      pair.sweep = sweeps[row];
      pair.number = static_cast<int>(row) + 1;
    }
    using Member = double Pair::*;
    for (const auto& [name, member] : {std::pair<std::string_view, Member>{"Y", &Pair::Y},
                                       {"x", &Pair::x},
                                       {"omega", &Pair::omega},
                                       {"phase", &Pair::phase},
                                       {"fundamental", &Pair::fundamental},
                                       {"mean_square_speed", &Pair::mean_square_speed}})
      if (const std::vector<double>* column = values(name))
        for (std::size_t row = 0; row < column->size(); ++row) record.pairs[row].*member = (*column)[row];
    return record;
  }

  /// Nothing but x (and t), and every row turns back: a sampled motion does not.
  [[nodiscard]] bool holds_extremes() const {
    const std::vector<double>* x = values("x");
    if (x == nullptr || !table_.sweeps.empty()) return false;
    for (const DataColumn& column : table_.columns)
      if (column.known->is_signal && column.known->name != "x") return false;
    if (values("t") == nullptr) return true;
    for (std::size_t i = 2; i < x->size(); ++i)
      if (((*x)[i] - (*x)[i - 1]) * ((*x)[i - 1] - (*x)[i - 2]) >= 0.0) return false;
    return true;
  }

  /// Amplitudes of a response, whose excitation is missing, are no extremes.
  void refuse_response_without_Y() const {
    for (const std::string_view name : {"omega", "phase", "fundamental", "mean_square_speed"})
      if (values(name) != nullptr)
        refuse_file(
            table_.file,
            "there is a column " + std::string(name) + " and no column Y: pairs need the amplitude of the base",
            std::string(allowed_columns));
  }

  DecayRecord decay() {
    refuse_response_without_Y();
    warn_unused({"x", "t"});
    DecayRecord record;
    record.extremes = *values("x");
    if (const std::vector<double>* t = values("t")) {
      check_increasing({0, t->size()});
      record.times = *t;
    }
    return record;
  }

  /// False when a time does not increase.
  bool check_increasing(Stretch rows) {
    const std::vector<double>& t = *values("t");
    bool increasing = true;
    for (std::size_t row = rows.first + 1; row < rows.last; ++row) {
      if (!(t[row] <= t[row - 1])) continue;
      increasing = false;
      complain(
          row, "t",
          t[row] == t[row - 1] ? "the time does not increase: it stands there twice" : "the time does not increase",
          "a time after the row above; tests of their own bear labels in a column sweep");
    }
    return increasing;
  }

  std::vector<History> histories() {
    warn_unused({"t", "x", "y", "v", "a", "force", "sweep"});
    if (values("t") == nullptr) {
      refuse_file(table_.file, "signals need their times: there is no column t", std::string(allowed_columns));
    }
    std::vector<LabelRun> runs = table_.sweeps;
    if (runs.empty()) runs.push_back({{}, 0});
    std::set<std::string> seen;
    std::vector<History> result;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Stretch rows{runs[i].first_row, i + 1 < runs.size() ? runs[i + 1].first_row : table_.rows()};
      if (!seen.insert(runs[i].label).second) {
        complain(rows.first, "sweep", "the rows of sweep '" + runs[i].label + "' do not stand together",
                 "a label of its own for each test");
      } else if (const Stretch steady = evenly_sampled(rows); steady.size() > 0) {
        result.push_back(history(steady, runs[i].label));
      }
    }
    return result;
  }

  [[nodiscard]] History history(Stretch rows, const std::string& label) const {
    const std::vector<double>& t = *values("t");
    History result;
    result.sweep = label;
    result.start = t[rows.first];
    result.sample_rate = static_cast<double>(rows.size() - 1) / (t[rows.last - 1] - t[rows.first]);
    using Member = std::vector<double> History::*;
    for (const auto& [name, member] : {std::pair<std::string_view, Member>{"x", &History::x},
                                       {"y", &History::y},
                                       {"v", &History::v},
                                       {"a", &History::a},
                                       {"force", &History::force}})
      if (const std::vector<double>* column = values(name))
        (result.*member)
            .assign(column->begin() + static_cast<std::ptrdiff_t>(rows.first),
                    column->begin() + static_cast<std::ptrdiff_t>(rows.last));
    return result;
  }

  /// The part of `rows` with a constant time step; empty after a problem.
  Stretch evenly_sampled(Stretch rows) {
    const std::vector<double>& t = *values("t");
    if (rows.size() < fewest_samples) {
      complain(rows.first, "t", "a history of " + std::to_string(rows.size()) + " rows is too short",
               "at least " + std::to_string(fewest_samples) + " rows; or extremes, each row turning back");
      return {};
    }
    if (!check_increasing(rows)) return {};
    for (std::size_t row = rows.first; row < rows.last; ++row)
      if (std::isnan(t[row])) return {};  // a problem already reported
    const bool even = is_even(rows);
    if (even && !has_long_step(rows)) return rows;

    const double step = median_step(rows);
    // A few long steps are samples that are missing; many that a line explains come of times rounded to about a
    // step.
    if (even && long_steps(rows, step) > most_lone_gaps) return rows;
    const Stretch longest = longest_without_gap(rows, step);
    if (longest.size() == rows.size() || !is_even(longest)) {
      complain(worst_row(longest), "t", "the time steps are not constant",
               "a constant sample rate; here a step of about " + core::format_number(step, 4) + " s");
      return {};
    }
    if (longest.size() < fewest_samples ||
        static_cast<double>(longest.size()) < least_share * static_cast<double>(rows.size())) {
      complain(longest.last < rows.last ? longest.last : longest.first, "t",
               "the times have gaps, and no stretch between them is long enough",
               "an uninterrupted stretch of " + std::to_string(fewest_samples) + " rows and a tenth of all");
      return {};
    }
    warnings_.push_back("the times have gaps: of " + std::to_string(rows.size()) + " rows only the longest " +
                        "uninterrupted stretch is used, " + std::to_string(longest.size()) +
                        " rows from t = " + core::format_number(t[longest.first], 6) + " s to " +
                        core::format_number(t[longest.last - 1], 6) + " s");
    return longest;
  }

  /// How far a printed time may be off.
  [[nodiscard]] double rounding_of(double t) const {
    if (t == 0.0) return table_.time_quantum;
    const double last_digit = std::pow(10.0, std::floor(std::log10(std::abs(t))) + 1.0 - table_.time_digits);
    return std::max(table_.time_quantum, last_digit);
  }

  /// Distance of a time from the line through the first and the last one, beyond what rounding explains; in steps.
  [[nodiscard]] double excess(Stretch rows, std::size_t row, double largest_rounding) const {
    const std::vector<double>& t = *values("t");
    const double step = (t[rows.last - 1] - t[rows.first]) / static_cast<double>(rows.size() - 1);
    const double line = t[rows.first] + static_cast<double>(row - rows.first) * step;
    return (std::abs(t[row] - line) - largest_rounding) / step;
  }

  /// A line through two times that are off by half a unit of the last digit each is off by as much between them,
  /// and so is the time compared with it: together one unit.
  [[nodiscard]] double largest_rounding(Stretch rows) const {
    const std::vector<double>& t = *values("t");
    return std::max(rounding_of(t[rows.first]), rounding_of(t[rows.last - 1]));
  }

  [[nodiscard]] std::size_t worst_row(Stretch rows) const {
    const double rounding = largest_rounding(rows);
    std::size_t worst = rows.first;
    for (std::size_t row = rows.first; row < rows.last; ++row)
      if (excess(rows, row, rounding) > excess(rows, worst, rounding)) worst = row;
    return worst;
  }

  [[nodiscard]] bool is_even(Stretch rows) const {
    return rows.size() > 1 && excess(rows, worst_row(rows), largest_rounding(rows)) <= clock_jitter;
  }

  [[nodiscard]] std::size_t long_steps(Stretch rows, double step) const {
    const std::vector<double>& t = *values("t");
    std::size_t count = 0;
    for (std::size_t row = rows.first + 1; row < rows.last; ++row)
      count += t[row] - t[row - 1] > gap * step ? 1 : 0;
    return count;
  }

  [[nodiscard]] bool has_long_step(Stretch rows) const {
    const std::vector<double>& t = *values("t");
    return long_steps(rows, (t[rows.last - 1] - t[rows.first]) / static_cast<double>(rows.size() - 1)) > 0;
  }

  [[nodiscard]] double median_step(Stretch rows) const {
    const std::vector<double>& t = *values("t");
    std::vector<double> steps(rows.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = t[rows.first + i + 1] - t[rows.first + i];
    return upper_median(std::move(steps));
  }

  [[nodiscard]] Stretch longest_without_gap(Stretch rows, double step) const {
    const std::vector<double>& t = *values("t");
    Stretch longest{rows.first, rows.first};
    std::size_t first = rows.first;
    for (std::size_t row = rows.first + 1; row <= rows.last; ++row) {
      if (row < rows.last && t[row] - t[row - 1] <= gap * step) continue;
      if (row - first > longest.size()) longest = {first, row};
      first = row;
    }
    return longest;
  }

  DataTable table_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
};

}  // namespace

const KnownColumn* known_column(std::string_view name) {
  const auto found = std::find_if(known_columns.begin(), known_columns.end(), [name](const KnownColumn& known) {
    return name == known.name || (!known.alias.empty() && name == known.alias);
  });
  return found == known_columns.end() ? nullptr : &*found;
}

std::vector<std::string_view> column_names(bool numbers_only) {
  std::vector<std::string_view> names;
  for (const KnownColumn& known : known_columns)
    if (!numbers_only || !known.unit.empty()) names.push_back(known.name);
  return names;
}

const std::string* find_unit(const std::map<std::string, std::string>& units, const KnownColumn& known) {
  for (const std::string_view name : {known.name, known.alias})
    if (const auto found = units.find(std::string(name)); found != units.end() && !name.empty())
      return &found->second;
  return nullptr;
}

void check_names(const std::map<std::string, std::string>& map, const std::string& option, const std::string& file,
                 Problems& problems) {
  for (const auto& [name, value] : map) {
    if (known_column(name) != nullptr) continue;
    std::string names;
    for (const std::string_view known : column_names()) names += (names.empty() ? "" : ", ") + std::string(known);
    problems.add(
        {{file, 0, 0, {}}, option + ": there is no column '" + name + "' that could be used", names, {}, {}});
  }
}

void Problems::add(core::Diagnostic diagnostic) {
  diagnostics_.push_back(std::move(diagnostic));
  if (diagnostics_.size() < most_problems) return;
  core::Diagnostic end;
  end.place.file = diagnostics_.back().place.file;
  end.message = "too many problems; those after the first " + std::to_string(most_problems) + " are not listed";
  diagnostics_.push_back(std::move(end));
  throw core::InputError(diagnostics_);
}

void Problems::throw_if_any() {
  if (diagnostics_.empty()) return;
  std::sort(diagnostics_.begin(), diagnostics_.end(), [](const auto& a, const auto& b) {
    return std::tie(a.place.line, a.place.column, a.message) < std::tie(b.place.line, b.place.column, b.message);
  });
  throw core::InputError(diagnostics_);
}

void refuse_file(const std::string& file, std::string message, std::string allowed) {
  throw core::InputError(core::Diagnostic{{file, 0, 0, {}}, std::move(message), std::move(allowed), {}, {}});
}

const DataColumn* DataTable::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [name](const DataColumn& c) { return c.known->name == name; });
  return found == columns.end() ? nullptr : &*found;
}

std::optional<double> factor_of_caller(const std::map<std::string, std::string>& units, const KnownColumn& known,
                                       const std::string& file, Problems& problems) {
  const std::string* unit = find_unit(units, known);
  if (unit == nullptr) return std::nullopt;
  const core::QuantityText factor = core::unit_factor(*unit, known.unit.empty() ? "1" : known.unit);
  if (factor.value) return factor.value;
  problems.add({{file, 0, 0, {}},
                "the unit of column " + std::string(known.name) + ": " + factor.fault,
                core::describe_dimension(known.unit),
                *unit,
                factor.suggestion});
  return 1.0;
}

DataTable join(const std::string& file, const std::vector<TestColumns>& tests) {
  DataTable table;
  table.file = file;
  for (const TestColumns& test : tests) {
    const std::size_t row = table.rows();
    if (tests.size() > 1 || !test.label.empty()) table.sweeps.push_back({test.label, row});
    if (table.columns.empty())
      for (const DataColumn& column : test.columns) table.columns.push_back({column.known, {}});
    bool alike = test.columns.size() == table.columns.size();
    for (const DataColumn& column : test.columns) {
      const DataColumn* whole = table.find(column.known->name);
      alike = alike && whole != nullptr;
      if (!alike)
        refuse_file(file, "the tests of the file do not hold the same signals: test '" + test.label + "'");
      auto& values = table.columns[static_cast<std::size_t>(whole - table.columns.data())].values;
      values.insert(values.end(), column.values.begin(), column.values.end());
    }
    if (!alike) refuse_file(file, "the tests of the file do not hold the same signals: test '" + test.label + "'");
  }
  table.show = [file](std::size_t row, const KnownColumn& known) {
    core::Diagnostic result;
    result.place.file = file;
    result.found = "element " + std::to_string(row + 1) + " of " + std::string(known.name);
    return result;
  };
  return table;
}

Record record_of(DataTable table, Problems& problems, std::vector<std::string>& warnings) {
  return Assembly(std::move(table), problems, warnings).run();
}

}  // namespace dualdamp::identify
