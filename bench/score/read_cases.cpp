#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <utility>

#include "bench/score/scores.hpp"
#include "core/diagnostics.hpp"
#include "core/input_file.hpp"
#include "scenarios/format/json.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::Json;

double number_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : not_stated;
}

std::array<double, 2> interval_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array() || !found->at(0).is_number() || !found->at(1).is_number())
    return {not_stated, not_stated};
  return {found->at(0).get<double>(), found->at(1).get<double>()};
}

CaseAnswer answer_in(const Json& estimate) {
  CaseAnswer answer;
  if (!estimate.contains("zeta")) return answer;
  answer.zeta = number_in(estimate, "zeta");
  answer.F0 = number_in(estimate, "F0");
  answer.zeta95 = interval_in(estimate, "zeta95");
  answer.F095 = interval_in(estimate, "F095");
  answer.p_value = number_in(estimate, "p_value");
  answer.usable = estimate.at("usable").get<bool>() ? CaseAnswer::Usable::yes : CaseAnswer::Usable::no;
  return answer;
}

CaseConsequence consequence_in(const Json& line) {
  return {.distance = number_in(line, "distance"),
          .harm = number_in(line, "harm"),
          .harm_zeta = number_in(line, "harm_zeta"),
          .harm_F0 = number_in(line, "harm_F0"),
          .attainable_power = number_in(line, "attainable_power"),
          .cramer_rao_zeta = number_in(line, "cramer_rao_zeta"),
          .cramer_rao_F0 = number_in(line, "cramer_rao_F0"),
          .unmeasured = interval_in(line, "unmeasured")};
}

/// Scores the lines of `cases.jsonl` in parallel: they are independent, and predictions take time.
class CaseMarker {
 public:
  explicit CaseMarker(const Grid& grid) : grid_(grid), question_(grid.question()) {
    marked_.marks.resize(question_.entrants(), std::vector<Mark>(grid.cases()));
    marked_.consequences.resize(grid.motions() * question_.sensors.size());
  }

  /// Adds the lines of the cases from `first` on. Returns the first faulty line, if any: its index among them, and
  /// the fault.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::string>> add(std::size_t first,
                                                                       const std::vector<std::string>& lines) {
    constexpr std::size_t grain = 16;
    std::vector<std::string> faults(lines.size());
    std::vector<char> failed(lines.size(), 0);
    sim::in_parts(lines.size(), grain, 0, [&](std::size_t begin, std::size_t count) {
      for (std::size_t i = begin; i < begin + count; ++i) {
        try {
          if (first + i >= grid_.cases() || !mark(first + i, Json::parse(lines[i], nullptr, false), failed[i]))
            faults[i] = "case " + std::to_string(first + i) + " is missing";
        } catch (const Json::exception&) {
          faults[i] = "the line does not hold a case";
        }
      }
    });
    marked_.failed_cases += static_cast<std::size_t>(std::ranges::count(failed, 1));
    const auto bad = std::ranges::find_if(faults, [](const std::string& fault) { return !fault.empty(); });
    if (bad == faults.end()) return std::nullopt;
    return std::pair(static_cast<std::size_t>(bad - faults.begin()), *bad);
  }

  [[nodiscard]] MarkedCases take() { return std::move(marked_); }

 private:
  /// Returns false if the line is not that of the case. Sets `failed` if no method gives an estimate.
  bool mark(std::size_t number, const Json& line, char& failed) {
    if (line.is_discarded() || line.value("case", grid_.cases()) != number) return false;
    const Grid::Case place = grid_.at(number);
    const Grid::Motion motion = grid_.motion(place.motion);
    const CaseConsequence consequence = consequence_in(line);
    failed = 1;
    for (std::size_t entrant = 0; entrant < question_.entrants(); ++entrant) {
      const bool is_method = entrant < question_.methods.size();
      const CaseAnswer answer = is_method
                                    ? answer_in(line.at("estimates").at(entrant))
                                    : question_.entries[entrant - question_.methods.size()].answers.at(number);
      if (is_method && answer.is_given()) failed = 0;
      marked_.marks[entrant][number] = marked(answer, motion, consequence);
    }
    if (place.seed == 0) marked_.consequences[number / static_cast<std::size_t>(question_.seeds)] = consequence;
    return true;
  }

  [[nodiscard]] Mark marked(const CaseAnswer& answer, const Grid::Motion& motion,
                            const CaseConsequence& consequence) const {
    const TrueRig& rig = question_.rigs[motion.rig];
    Mark mark = mark_of(answer, grid_.parameters(motion));
    mark.prediction_error = static_cast<float>(
        prediction_error(answer, believed(rig.truth, motion), unmeasured_tests(question_.ranges[motion.range], rig),
                         consequence.unmeasured));
    return mark;
  }

  /// The rig with the constants that the laboratory believes in.
  static Truth believed(Truth truth, const Grid::Motion& motion) {
    sim::Oscillator& oscillator = truth.model.oscillator;
    Laboratory laboratory{{oscillator.mass, oscillator.stiffness, truth.model.excitation.frequency}, {}};
    motion.departure.mislead(laboratory, {}, motion.severity);  // constants do not depend on the motion
    oscillator.mass = laboratory.constants.mass;
    oscillator.stiffness = laboratory.constants.stiffness;
    return truth;
  }

  const Grid& grid_;
  const StressTest& question_;
  MarkedCases marked_;
};

}  // namespace

MarkedCases read_cases(const std::string& path, const Grid& grid) {
  constexpr std::size_t most_lines = 4096;  // in memory
  std::size_t number = 0;
  const auto refuse = [&](std::size_t at, const std::string& message) {
    throw core::InputError(core::Diagnostic{{path, static_cast<int>(at) + 2, 0, {}}, message, {}, {}, {}});
  };
  std::ifstream file(path);
  if (!file) core::fail_to_read(path, "cannot be opened", errno);
  std::string line;
  std::getline(file, line);  // the campaign
  CaseMarker marker(grid);
  std::vector<std::string> lines;
  while (file) {
    lines.clear();
    while (lines.size() < most_lines && std::getline(file, line)) lines.push_back(std::move(line));
    if (const auto fault = marker.add(number, lines)) refuse(number + fault->first, fault->second);
    number += lines.size();
  }
  if (number != grid.cases()) refuse(number, "case " + std::to_string(number) + " is missing");
  return marker.take();
}

}  // namespace dualdamp::bench
