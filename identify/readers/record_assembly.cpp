#include "identify/readers/record_assembly.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "identify/readers/channel_checks.hpp"
#include "identify/readers/signal_checks.hpp"
#include "identify/readers/time_base.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/turning_points.hpp"

namespace dualdamp::identify {

namespace {

/// Rows [first, last) of one test.
struct Part {
  std::size_t first = 0;
  std::size_t last = 0;
};

class Assembly {
 public:
  Assembly(DataTable table, const ReadOptions& options, Problems& problems, std::vector<std::string>& warnings)
      : table_(std::move(table)),
        is_imposed_(options.is_imposed),
        words_(options.words),
        problems_(problems),
        warnings_(warnings) {}

  Record run() {
    Record record;
    if (runs_backwards()) return record;
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

  /// Adds a problem for times most of which decrease. Each of them would begin a test.
  [[nodiscard]] bool runs_backwards() {
    const std::vector<double>* t = values("t");
    constexpr std::size_t fewest = 3;
    if (t == nullptr || t->size() < fewest || values("Y") != nullptr) return false;
    std::size_t back = 0;
    for (std::size_t row = 1; row < t->size(); ++row) back += (*t)[row] < (*t)[row - 1] ? 1 : 0;
    if (2 * back <= t->size()) return false;
    complain(1, "t", "the time runs backwards", "rows in the order in which they were measured");
    return true;
  }

  [[nodiscard]] core::Diagnostic shown(std::size_t row, std::string_view name) const {
    return table_.show(source_row_.empty() ? row : source_row_[row], *known_column(name));
  }

  void complain(const std::vector<std::size_t>& rows, std::string_view name, const std::string& message,
                const std::string& allowed) {
    std::vector<std::size_t> sources = rows;
    if (!source_row_.empty())
      for (std::size_t& row : sources) row = source_row_[row];
    identify::complain(table_, sources, name, message, allowed, problems_);
  }

  void complain(std::size_t row, std::string_view name, const std::string& message, const std::string& allowed) {
    complain(std::vector{row}, name, message, allowed);
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
    std::vector<std::size_t> negative;
    std::vector<std::size_t> zero;
    for (std::size_t row = 0; row < column->size(); ++row) {
      if ((*column)[row] < 0.0) negative.push_back(row);
      if (zero_too && (*column)[row] == 0.0) zero.push_back(row);
    }
    const std::string subject = what + " of column " + std::string(name);
    complain(
        negative, name, subject + " is negative",
        "a number not below zero" + std::string(name == "Y" ? "; samples of the motion of the base are y" : ""));
    complain(zero, name, subject + " is zero", "a number above zero");
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
    check_pair_channels(table_, problems_, warnings_);
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

  /// Only x (and t), and x turns back at most rows: at every one but where noise or a missing row hides a turn. A
  /// sampled motion does not: with two and a half samples a period it turns at four rows of five.
  [[nodiscard]] bool holds_extremes() const {
    const std::vector<double>* x = values("x");
    if (x == nullptr) return false;
    for (const DataColumn& column : table_.columns)
      if (column.known->is_signal && column.known->name != "x") return false;
    const std::vector<LabelRun> runs = tests_of_extremes();
    if (values("t") == nullptr) return true;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const std::vector<double> part = cut(*x, runs, i);
      if (part.size() > 2 && turn_too_seldom(part)) return false;
    }
    return true;
  }

  /// Whether x turns back at less than four of five rows, with three rows or more.
  [[nodiscard]] static bool turn_too_seldom(const std::vector<double>& x) {
    return 5 * rows_that_turn(x) < 4 * (x.size() - 2);
  }

  /// Refuses amplitudes of a response without the excitation: they are no extremes.
  void refuse_response_without_Y() const {
    for (const std::string_view name : {"omega", "phase", "fundamental", "mean_square_speed"})
      if (values(name) != nullptr)
        core::refuse(
            {.file = table_.file},
            "there is a column " + std::string(name) + " and no column Y: pairs need the amplitude of the base",
            std::string(allowed_columns));
  }

  /// The decays in the file: several if there are labels, repeated headers, or times that begin anew.
  [[nodiscard]] std::vector<LabelRun> tests_of_extremes() const {
    if (!table_.sweeps.empty()) return table_.sweeps;
    std::vector<LabelRun> runs = {{{}, 0}};
    for (const std::size_t start : table_.restarts) runs.push_back({{}, start});
    if (const std::vector<double>* t = values("t"); t != nullptr && runs.size() == 1)
      for (std::size_t row = 1; row < t->size(); ++row)
        if ((*t)[row] < (*t)[row - 1] && (*t)[row] <= (*t)[1]) runs.push_back({{}, row});
    return runs;
  }

  [[nodiscard]] std::vector<double> cut(const std::vector<double>& column, const std::vector<LabelRun>& runs,
                                        std::size_t i) const {
    const std::size_t end = i + 1 < runs.size() ? runs[i + 1].first_row : column.size();
    return {column.begin() + static_cast<std::ptrdiff_t>(runs[i].first_row),
            column.begin() + static_cast<std::ptrdiff_t>(end)};
  }

  /// Extremes turn back at every row but where noise hides a turn or the mass has come to rest. Samples of a motion
  /// seldom do, and those of noise at two rows of three.
  void refuse_samples_without_times(const std::vector<double>& x) const {
    constexpr std::size_t many = 40;
    const std::size_t back = rows_that_turn(x);
    const bool are_samples = x.size() > 2 && (back == 0 || (x.size() >= many && turn_too_seldom(x)));
    if (!are_samples) return;
    const std::string often =
        back == 0 ? "never turns back"
                  : "turns back at " + std::to_string(back) + " of " + std::to_string(x.size()) + " rows";
    core::refuse({.file = table_.file},
                 "x is the only column and " + often + ": extremes of a free vibration alternate",
                 "signed extremes such as 5, -4, 3; or samples with their times t, or with their rate, as " +
                     words_(core::Setting::sample_rate, {}, "1 kHz"));
  }

  DecayRecord decay() {
    refuse_response_without_Y();
    warn_unused({"x", "t", "sweep"});
    const std::vector<LabelRun> runs = tests_of_extremes();
    std::vector<DecayRecord> decays;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      decays.push_back({cut(*values("x"), runs, i), {}});
      refuse_samples_without_times(decays.back().extremes);
      if (values("t") == nullptr) continue;
      decays.back().times = cut(*values("t"), runs, i);
      check_increasing(table_, runs[i].first_row, decays.back().times.size(), problems_);
    }
    if (decays.size() == 1) return std::move(decays.front());
    DecayRecord mean = mean_decay(decays);
    warnings_.push_back(mean_decay_warning(decays.size(), mean.extremes.size()));
    return mean;
  }

  std::vector<History> histories() {
    warn_unused({"t", "x", "y", "v", "a", "force", "sweep"});
    if (values("t") == nullptr) {
      std::vector<std::string> names;
      for (const DataColumn& column : table_.columns) names.emplace_back(column.known->name);
      const bool are_amplitudes = values("omega") != nullptr || values("phase") != nullptr;
      core::refuse(
          {.file = table_.file},
          are_amplitudes ? "amplitudes need that of the base: there is no column Y"
                         : "signals need their times: there is no column t",
          are_amplitudes && values("force") != nullptr
              ? "Y and x; the amplitude of a force on the mass acts as a base that moves by F/k: for k = 2000 "
                "N/m " +
                    words_(core::Setting::column, "Y", "FORCE") + ", " +
                    words_(core::Setting::scale, "Y", "0.0005 m/N")
              : std::string(allowed_columns) + "; or samples of one rate, with " +
                    words_(core::Setting::sample_rate, {}, "1 kHz"),
          "columns " + core::joined(names, " and "));
    }
    if (!check_signals()) return {};
    drop_doubled_rows();
    const std::vector<LabelRun> runs = tests();
    std::set<std::string> seen;
    std::vector<History> result;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Part rows{runs[i].first_row, i + 1 < runs.size() ? runs[i + 1].first_row : table_.rows()};
      if (!seen.insert(runs[i].label).second) {
        complain(rows.first, "sweep", "the rows of sweep '" + runs[i].label + "' are not together",
                 "a label of its own for each test");
        continue;
      }
      if (auto sampled = history(rows, runs[i].label)) result.push_back(std::move(*sampled));
    }
    return result;
  }

  /// Removes channels without a signal. Adds a problem for one that is needed, and for clipped signals. False after
  /// a problem.
  bool check_signals() {
    if (!check_channels(table_, is_imposed_, problems_, warnings_)) return false;
    if (holds_placeholders()) return false;
    return std::ranges::all_of(std::array{"x", "y", "v", "a"}, [this](std::string_view name) {
      const std::vector<double>* signal = values(name);
      return signal == nullptr || check_range(name, *signal);
    });
  }

  /// Adds a problem for a motion of the mass that jumps to a number of the logger. A drive may jump.
  bool holds_placeholders() {
    return std::ranges::any_of(std::array{"x", "v", "a"}, [this](const char* name) {
      const std::vector<double>* signal = values(name);
      const std::vector<std::size_t> rows =
          signal == nullptr ? std::vector<std::size_t>{} : placeholders_in(*signal);
      complain(rows, name,
               "column " + std::string(name) +
                   " holds a number far from all others, again and again the same: what a logger writes where it "
                   "measured nothing",
               "the file without these rows");
      return !rows.empty();
    });
  }

  /// Without the rests of the mass at which the measured force or base stops or turns.
  Clipping without_sticks_of(std::string_view name, const std::vector<double>& signal, Clipping clipping,
                             std::size_t fewest_places) {
    for (const std::string_view drive : {"force", "y"})
      if (const std::vector<double>* driven = name == "x" ? values(drive) : nullptr)
        clipping = without_sticks(clipping, signal, *driven, fewest_places);
    return clipping;
  }

  /// Adds a problem for a clipped signal, or a warning where it is not certain. False after a problem.
  bool check_range(std::string_view name, const std::vector<double>& signal) {
    const Clipping exact = without_sticks_of(name, signal, clipping_of(signal), 2);
    const Clipping clipping =
        exact.samples > 0 ? exact : without_sticks_of(name, signal, noisy_clipping_of(signal), 1);
    if (clipping.samples == 0) return true;
    const std::vector<double>* v = name == "x" ? values("v") : nullptr;
    if (v != nullptr && is_still_at(clipping, *v)) return true;
    const std::string where = std::to_string(clipping.samples) + " samples in " + std::to_string(clipping.places) +
                              (clipping.places == 1 ? " place" : " places") + " stay at the end of the range";
    const std::string subject = "column " + std::string(name);
    // A displacement does not stop short twice at the same place, unless it is imposed.
    const bool is_free = name != "x" || !is_imposed_;
    if (is_free && (exact.samples > 0 || (name == "x" && clipping.places > 1))) {
      complain(clipping.first, name, subject + " is clipped: " + where,
               "a record within the range of the sensor, or the part of it that is");
      return false;
    }
    warnings_.push_back(subject + " may be clipped: " + where +
                        ", and the swing beside them would go further. Clipping looks like friction");
    clipped_.insert(clipped_.end(), clipping.stretches.begin(), clipping.stretches.end());
    return true;
  }

  /// The labels of the file. Without labels, a test begins at a repeated header or where the time begins anew.
  [[nodiscard]] std::vector<LabelRun> tests() {
    if (!table_.sweeps.empty()) return table_.sweeps;
    std::vector<std::size_t> starts = table_.restarts;
    if (starts.empty()) starts = starts_by_time();
    if (starts.empty()) return {{{}, 0}};
    starts.insert(starts.begin(), 0);
    std::vector<LabelRun> runs;
    for (const std::size_t start : starts) runs.push_back({std::to_string(runs.size() + 1), start});
    warnings_.push_back(std::string(table_.restarts.empty() ? "the time begins anew" : "the header is repeated") +
                        ": the file is read as " + std::to_string(runs.size()) + " tests, labelled 1 to " +
                        std::to_string(runs.size()));
    return runs;
  }

  /// Rows whose time falls back to the start of the first test and increases from there. None if a time falls back
  /// elsewhere.
  [[nodiscard]] std::vector<std::size_t> starts_by_time() const {
    const std::vector<double>& t = *values("t");
    std::vector<std::size_t> starts;
    const double step = t.size() > 1 ? std::abs(t[1] - t[0]) : 0.0;
    for (std::size_t row = 1; row < t.size(); ++row) {
      if (!(t[row] < t[row - 1])) continue;
      const bool goes_on = row + 1 < t.size() && t[row + 1] - t[row] <= 2.0 * step;
      if (std::abs(t[row] - t[0]) > 2.0 * step || !goes_on) return {};
      starts.push_back(row);
    }
    return starts;
  }

  /// Removes rows that a logger wrote twice after an interruption, or a joined table all over. In bursts, and with
  /// coarse stamps, some rows of one time differ: all are kept.
  void drop_doubled_rows() {
    const std::vector<double>& t = *values("t");
    std::vector<std::size_t> doubled;
    for (std::size_t row = 1; row < t.size(); ++row) {
      if (t[row] != t[row - 1]) continue;
      const bool same = std::ranges::all_of(
          table_.columns, [row](const DataColumn& column) { return column.values[row] == column.values[row - 1]; });
      if (!same) return;
      doubled.push_back(row);
    }
    if (doubled.empty()) return;
    warnings_.push_back(std::to_string(doubled.size()) + " row" + (doubled.size() == 1 ? " appears" : "s appear") +
                        " twice with the same time and the same values; the repetition is left out");
    source_row_.resize(t.size());
    std::iota(source_row_.begin(), source_row_.end(), std::size_t{0});
    const auto erase = [&doubled](auto& list) {
      std::size_t row = 0;
      std::size_t next = 0;
      std::erase_if(list, [&](const auto&) {
        const bool erased = next < doubled.size() && doubled[next] == row++;
        next += erased ? 1 : 0;
        return erased;
      });
    };
    for (DataColumn& column : table_.columns) erase(column.values);
    erase(source_row_);
    for (LabelRun& run : table_.sweeps)
      run.first_row -= static_cast<std::size_t>(std::ranges::lower_bound(doubled, run.first_row) - doubled.begin());
    for (std::size_t& start : table_.restarts)
      start -= static_cast<std::size_t>(std::ranges::lower_bound(doubled, start) - doubled.begin());
  }

  static std::span<const double> cut(const std::vector<double>& column, std::size_t first, std::size_t last) {
    return std::span<const double>(column).subspan(first, last - first);
  }

  /// What was measured in these rows; the times, if nothing was.
  [[nodiscard]] std::vector<std::span<const double>> signals(Part rows) const {
    std::vector<std::span<const double>> found;
    for (const std::string_view name : {"x", "y", "v", "a", "force"})
      if (const std::vector<double>* column = values(name)) found.push_back(cut(*column, rows.first, rows.last));
    if (found.empty()) found.push_back(cut(*values("t"), rows.first, rows.last));
    return found;
  }

  /// Nothing if there was a problem.
  std::optional<History> history(Part rows, const std::string& label) {
    const TimeBase base = time_base_of({.t = cut(*values("t"), rows.first, rows.last),
                                        .signals = signals(rows),
                                        .quantum = table_.time_quantum,
                                        .digits = table_.time_digits});
    if (base.fault) complain(rows.first + base.fault->row, "t", base.fault->message, base.fault->allowed);
    if (base.last == base.first) return std::nullopt;
    const std::string test = label.empty() ? "" : "test '" + label + "': ";
    if (!base.warning.empty()) warnings_.push_back(test + base.warning);
    const auto t = cut(*values("t"), rows.first + base.first, rows.first + base.last);
    History result;
    result.sweep = label;
    if (base.last - base.first < rows.last - rows.first) result.gaps = test + base.warning;
    result.is_clipped = std::ranges::any_of(clipped_, [&](const auto& stretch) {
      return stretch.first < rows.first + base.last && stretch.second > rows.first + base.first;
    });
    result.start = t.front();
    result.sample_rate = 1.0 / base.step;
    using Member = std::vector<double> History::*;
    for (const auto& [name, member] : {std::pair<std::string_view, Member>{"x", &History::x},
                                       {"y", &History::y},
                                       {"v", &History::v},
                                       {"a", &History::a},
                                       {"force", &History::force}})
      if (const std::vector<double>* column = values(name)) {
        const auto part = cut(*column, rows.first + base.first, rows.first + base.last);
        result.*member = even_samples(base, t, part);
      }
    if (const auto fault = check_test(result, is_imposed_, warnings_))
      complain(rows.first + base.first, fault->column, fault->message, fault->allowed);
    return result;
  }

  DataTable table_;
  std::vector<std::size_t> source_row_;  ///< if rows were left out: the row in the file of each row
  std::vector<std::pair<std::size_t, std::size_t>> clipped_;  ///< rows that may be clipped
  bool is_imposed_;
  core::SettingWords words_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
};

}  // namespace

Record record_of(DataTable table, const ReadOptions& options, Problems& problems,
                 std::vector<std::string>& warnings) {
  return Assembly(std::move(table), options, problems, warnings).run();
}

}  // namespace dualdamp::identify
