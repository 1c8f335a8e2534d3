#pragma once
/// The contract of an analysis: a question that a scenario can ask.
///
/// One file pair holds all parts of an analysis: its keys, its needs of the other sections, its checks, its
/// question with the run, and the fields of its result. The view of its page is a .js file of the same name beside
/// the pair, or the default view, which draws all tables. The list (`analyses.hpp`) is explicit. To add one:
/// docs/developing.md.
///
/// A file is read by the keys, then checked: `check` adds problems and fills in what the file left out. If there is
/// no problem, `ask` turns the checked values into a question, which is immutable and can be run.

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "identify/readers/record_reader.hpp"
#include "scenarios/analyses/shared/run_options.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/format/keys.hpp"
#include "scenarios/format/needs.hpp"
#include "scenarios/results/answer.hpp"
#include "sim/model.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::scenarios {

/// The checked scenario on which a question is run.
struct RunContext {
  const sim::Model& model;
  double tolerance = 0.0;       ///< closure of a steady state
  const std::string& resolved;  ///< the scenario as JSON
  const RunOptions& options;
  const sim::State* from = nullptr;  ///< where the search for a steady state begins; null: the initial state
  /// Units of written quantities, by path (`results/shown_units.hpp`), for numbers in sentences; null: none is
  /// known.
  const std::map<std::string, std::string>* written_units = nullptr;

  /// A search for steady states with the scenario's tolerance.
  [[nodiscard]] sim::SteadyStateOptions steady_states() const {
    sim::SteadyStateOptions steady;
    steady.tolerance = tolerance;
    if (from != nullptr) steady.from = *from;
    return steady;
  }
};

/// Some numbers of a result, computed in another way.
struct OtherWay {
  std::string words;  ///< which
  Answer answer;      ///< only these numbers, by their keys in the result
};

class Question;

/// A question about many points, restricted to some of them.
struct Sampled {
  std::unique_ptr<const Question> question;
  std::function<Answer(const Answer&)> part;  ///< the part of the answer about all points that concerns these
  std::string words;                          ///< "16 of 3600 points"
};

class Question {
 public:
  Question() = default;
  virtual ~Question() = default;
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

  /// A number that does not exist is null in the answer; no result at all has a reason.
  [[nodiscard]] virtual Answer run(const RunContext& context) const = 0;
  /// For a verification: numbers that can also be computed by a method that run() does not use; may be empty.
  [[nodiscard]] virtual std::optional<OtherWay> other_way(const RunContext& /*context*/,
                                                          const Answer& /*answer*/) const {
    return std::nullopt;
  }
  /// For a verification that would take too long at all points; nothing: it uses all points.
  [[nodiscard]] virtual std::optional<Sampled> sampled() const { return std::nullopt; }
};

/// Base of questions whose run is long: such a run writes its finished cases to `options.directory`, can be
/// resumed, and is shared by all processes, of which the first one answers.
class Campaign {
 public:
  Campaign() = default;
  virtual ~Campaign() = default;
  Campaign(const Campaign&) = delete;
  Campaign& operator=(const Campaign&) = delete;

  /// The resources that the run needs, in one line.
  [[nodiscard]] virtual std::string size(const RunContext& context) const = 0;
};

/// Input of `ask`: values without problems.
struct CheckedValues {
  const Json& analysis;
  const Json& system;      ///< null without one
  const Json& excitation;  ///< null without one
  const sim::Model& model;
  std::optional<identify::MeasuredRecord> data;
  std::vector<DataFile> files;
  bool initial_is_stated = false;    ///< the scenario has a section `initial`
  bool tolerance_is_stated = false;  ///< the scenario has `numerics.tolerance`
  std::optional<identify::MeasuredSignal> compared = {};
  double drive_start = 0.0;       ///< time of the first sample of the excitation on the clock of its file [s]
  core::SettingWords words = {};  ///< how messages name what a user may state
};

/// The main chart of a result: columns of one of its lists, or measured and computed curves over each other.
struct MainChart {
  std::string_view table;  ///< name of the list as a CSV file; empty: the list is only in the result
  std::string_view list;   ///< its path in the result; empty: it is only a file
  std::string_view x;      ///< column
  std::string_view y;      ///< column
  std::string_view x_label;
  std::string_view y_label;
  std::string_view further = {};  ///< a column that is drawn over x too
  std::string_view by = {};       ///< rows that differ in this column are separate series
  enum class Kind { line, points, cells } kind = Kind::line;
  std::string_view x_otherwise = {};  ///< column, where there is no column x
  bool is_by_x = false;               ///< the rows are in any order, and a line joins them in that of x
  std::string_view key = {};          ///< the key without which a run does not write the table
  std::string_view overlay = {};      ///< instead of a list: start of the names of the tables of such curves
};

struct Analysis {
  std::string_view name;
  std::string_view summary;
  Section keys;              ///< of `analysis`, beside its type
  std::vector<Needs> needs;  ///< of the other sections
  std::vector<ResultField> results;
  /// Single numbers by which results are compared and drawn, the most important first: paths of `results`.
  std::vector<std::string_view> main = {};
  MainChart chart = {};
  bool uses_uncertainties = false;  ///< it uses the uncertainties of the system's constants and of the frequency
  bool seeks_laws = false;          ///< numbers that laws of the system lack are fitted; the model has no friction
  /// Structural damping is allowed: the result is about steady vibrations only, or the analysis refuses other
  /// records.
  bool steady_vibrations = false;
  bool verifiable = false;  ///< the result follows from the model: another engine can compute it again
  /// Adds problems to the file and completes its values; may be absent.
  void (*check)(CheckedFile& file) = nullptr;
  std::unique_ptr<const Question> (*ask)(CheckedValues&& values) = nullptr;
  /// Length of a list of the result, if it is known before the run; may be absent.
  std::optional<std::size_t> (*length_of)(const CheckedFile& file, std::string_view list) = nullptr;
};

/// Analyses live as long as the program.
using AnalysisList = std::vector<const Analysis*>;

/// nullptr when the list has no analysis of that name.
[[nodiscard]] const Analysis* find_analysis(const AnalysisList& list, std::string_view name);

/// Fields that the result of a checked section `analysis` may hold: those of the analysis and of the choices in it.
[[nodiscard]] std::vector<ResultField> result_fields(const Analysis& analysis, const Json& section);

}  // namespace dualdamp::scenarios
