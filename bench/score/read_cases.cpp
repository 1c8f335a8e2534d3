#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/score/scores.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::bench {

namespace {

using Json = nlohmann::json;

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
          .cramer_rao_F0 = number_in(line, "cramer_rao_F0")};
}

}  // namespace

MarkedCases read_cases(const std::string& path, const Grid& grid) {
  const StressTest& question = grid.question();
  MarkedCases result;
  result.marks.resize(question.entrants());
  for (std::vector<Mark>& list : result.marks) list.reserve(grid.cases());
  std::size_t number = 0;
  const auto refuse = [&](const std::string& message) {
    throw core::InputError(core::Diagnostic{{path, static_cast<int>(number) + 2, 0, {}}, message, {}, {}, {}});
  };
  std::ifstream file(path);
  if (!file) refuse("cannot be opened");
  std::string line;
  std::getline(file, line);  // the campaign
  const auto read_line = [&] {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded() || json.value("case", grid.cases()) != number || number >= grid.cases())
      refuse("case " + std::to_string(number) + " is missing");
    const Grid::Case place = grid.at(number);
    const TrueParameters truth = grid.parameters(grid.motion(place.motion));
    bool any = false;
    for (std::size_t method = 0; method < question.methods.size(); ++method) {
      const CaseAnswer answer = answer_in(json.at("estimates").at(method));
      any = any || answer.is_given();
      result.marks[method].push_back(mark_of(answer, truth));
    }
    for (std::size_t entry = 0; entry < question.entries.size(); ++entry)
      result.marks[question.methods.size() + entry].push_back(
          mark_of(question.entries[entry].answers.at(number), truth));
    if (!any) ++result.failed_cases;
    if (place.seed == 0) result.consequences.push_back(consequence_in(json));
  };
  for (; std::getline(file, line); ++number) {
    try {
      read_line();
    } catch (const Json::exception&) {
      refuse("the line does not hold a case");
    }
  }
  if (number != grid.cases()) refuse("case " + std::to_string(number) + " is missing");
  return result;
}

}  // namespace dualdamp::bench
