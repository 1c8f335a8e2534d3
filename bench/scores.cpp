#include "bench/scores.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/diagnostics.hpp"

namespace dualdamp::bench {

namespace {

using Json = nlohmann::json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double tolerable = 0.05;  // of a parameter: beyond it an estimate counts as wrong
constexpr double grave = 0.2;

double share(int part, int all) { return all == 0 ? none : static_cast<double>(part) / all; }

/// One parameter over the seeds.
struct Errors {
  std::vector<double> values;
  int intervals = 0;
  int covering = 0;

  void add(const Json& estimate, const char* name, const char* interval, double truth) {
    values.push_back(estimate.at(name).get<double>() / truth - 1.0);
    const Json& ends = estimate.at(interval);
    if (!ends.is_array() || ends[0].is_null() || ends[1].is_null()) return;
    ++intervals;
    if (ends[0].get<double>() <= truth && truth <= ends[1].get<double>()) ++covering;
  }

  [[nodiscard]] ParameterScore score() {
    if (values.empty()) return {none, none, none, none};
    const auto count = static_cast<double>(values.size());
    double mean = 0.0;
    for (const double value : values) mean += value / count;
    double square = 0.0;
    for (const double value : values) square += (value - mean) * (value - mean);
    for (double& value : values) value = std::abs(value);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return {mean, values.size() < 2 ? 0.0 : std::sqrt(square / (count - 1.0)), *middle, share(covering, intervals)};
  }
};

/// One method on one motion, over the seeds.
struct Tally {
  Errors zeta, F0;
  int cases = 0;
  int wrong = 0;
  int detected = 0;
  int false_alarms = 0;

  void add(const Json& estimate, double true_zeta, double true_F0) {
    ++cases;
    const bool given =
        estimate.contains("zeta") && estimate.at("zeta").is_number() && estimate.at("F0").is_number();
    if (!given) {
      ++wrong;
      ++detected;
      return;
    }
    zeta.add(estimate, "zeta", "zeta95", true_zeta);
    F0.add(estimate, "F0", "F095", true_F0);
    const bool off = std::abs(zeta.values.back()) > tolerable || std::abs(F0.values.back()) > tolerable;
    const bool has_diagnostic = !estimate.at("usable").get<bool>() || estimate.at("fired").get<bool>();
    if (off) ++wrong;
    if (has_diagnostic) ++(off ? detected : false_alarms);
  }

  [[nodiscard]] Score score() {
    Score result;
    result.cases = cases;
    result.estimates = static_cast<int>(zeta.values.size());
    result.zeta = zeta.score();
    result.F0 = F0.score();
    result.wrong = share(wrong, cases);
    result.knew = share(detected, wrong);
    result.false_alarm = share(false_alarms, cases - wrong);
    return result;
  }
};

/// Severity at which an error that was `before` at `from` and is `after` at `to` passes `threshold`.
double crossing(double from, double before, double to, double after, double threshold) {
  if (!(from > 0.0) || !(before > 0.0)) return to;
  const double part = std::log(threshold / before) / std::log(after / before);
  return from * std::pow(to / from, std::clamp(part, 0.0, 1.0));
}

/// First severity with an error beyond `threshold`; a case without any number counts as one.
double first_beyond(const std::vector<const Score*>& scores, const Grid& grid, ParameterScore Score::* parameter,
                    double threshold) {
  double severity = 0.0;
  double error = 0.0;
  for (const Score* score : scores) {
    const double here = grid.motion(score->motion).severity;
    const double off = (score->*parameter).median_error;
    if (std::isnan(off)) return here;
    if (off > threshold) return crossing(severity, error, here, off, threshold);
    severity = here;
    error = off;
  }
  return std::numeric_limits<double>::infinity();
}

/// Sums over scores, in cases: a share times what it is a share of.
struct Diagnosed {
  double cases = 0.0, wrong = 0.0, detected = 0.0, false_alarms = 0.0;

  void add(const Score& score) {
    cases += score.cases;
    const double off = score.wrong * score.cases;
    wrong += off;
    if (off > 0.0) detected += score.knew * off;
    if (off < score.cases) false_alarms += score.false_alarm * (score.cases - off);
  }
};

std::vector<Breakdown> breakdowns_of(const std::vector<Score>& scores, const Grid& grid) {
  using Key = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;  // law, range, sensors, method
  std::map<Key, std::vector<const Score*>> groups;
  const StressTest& question = grid.question();
  for (const Score& score : scores) {
    const Grid::Motion motion = grid.motion(score.motion);
    if (motion.law == nullptr) continue;
    const auto law = std::ranges::find(question.laws, motion.law) - question.laws.begin();
    const auto range = motion.range - question.ranges.data();
    groups[{static_cast<std::size_t>(law), static_cast<std::size_t>(range), score.sensors, score.method}].push_back(
        &score);
  }
  std::vector<Breakdown> result;
  for (const auto& [key, group] : groups) {
    const auto [law, range, sensors, method] = key;
    Diagnosed sums;
    for (const Score* score : group) sums.add(*score);
    result.push_back(
        {std::string(question.laws[law]->name), range, sensors, method,
         first_beyond(group, grid, &Score::zeta, tolerable), first_beyond(group, grid, &Score::zeta, grave),
         first_beyond(group, grid, &Score::F0, tolerable), first_beyond(group, grid, &Score::F0, grave),
         sums.wrong / sums.cases, sums.wrong > 0.0 ? sums.detected / sums.wrong : none});
  }
  return result;
}

std::vector<Ranking> ranking_of(const std::vector<Score>& scores, const Grid& grid) {
  std::vector<Ranking> result;
  for (std::size_t method = 0; method < grid.question().methods.size(); ++method) {
    Diagnosed sums;
    Ranking ranking{.method = method, .false_alarm = none, .coverage = none};
    double alarms = 0.0;
    double covered = 0.0;
    int truths = 0;
    int intervals = 0;
    for (const Score& score : scores) {
      if (score.method != method) continue;
      if (grid.motion(score.motion).law != nullptr) {
        sums.add(score);
        continue;
      }
      if (!std::isnan(score.false_alarm)) {
        ++truths;
        alarms += score.false_alarm;
      }
      if (!std::isnan(score.F0.coverage)) {
        ++intervals;
        covered += score.F0.coverage;
      }
    }
    ranking.wrong = sums.wrong / sums.cases;
    ranking.knew = sums.wrong > 0.0 ? sums.detected / sums.wrong : none;
    ranking.trusted = (sums.cases - sums.wrong - sums.false_alarms) / sums.cases;
    ranking.unwarned = (sums.wrong - sums.detected) / sums.cases;
    ranking.worth = ranking.trusted - ranking.unwarned;
    if (truths > 0) ranking.false_alarm = alarms / truths;
    if (intervals > 0) ranking.coverage = covered / intervals;
    result.push_back(ranking);
  }
  std::ranges::stable_sort(result, std::ranges::greater{}, &Ranking::worth);
  return result;
}

}  // namespace

Scores score(const std::string& path, const Grid& grid, double zeta, double F0) {
  const std::size_t methods = grid.question().methods.size();
  Scores result;
  std::vector<Tally> tallies(methods);
  std::size_t expected = 0;
  const std::size_t per_sensors = static_cast<std::size_t>(grid.question().seeds);
  const auto close = [&] {
    const Grid::Case last = grid.at(expected - 1);
    for (std::size_t method = 0; method < methods; ++method) {
      Score score = tallies[method].score();
      score.motion = last.motion;
      score.sensors = last.sensors;
      score.method = method;
      result.scores.push_back(score);
      tallies[method] = {};
    }
  };
  const auto refuse = [&](const std::string& message) {
    throw core::InputError(core::Diagnostic{{path, static_cast<int>(expected) + 2, 0, {}}, message, {}, {}, {}});
  };
  std::ifstream file(path);
  if (!file) refuse("cannot be opened");
  std::string line;
  std::getline(file, line);  // the campaign
  while (std::getline(file, line)) {
    const Json json = Json::parse(line);
    if (json.at("case") != expected) refuse("case " + std::to_string(expected) + " is missing");
    bool any = false;
    for (std::size_t method = 0; method < methods; ++method) {
      const Json& estimate = json.at("estimates").at(method);
      tallies[method].add(estimate, zeta, F0);
      any = any || estimate.contains("zeta");
    }
    if (!any) ++result.failed_cases;
    if (++expected % per_sensors == 0) close();
  }
  if (expected != grid.cases()) refuse("case " + std::to_string(expected) + " is missing");
  result.breakdowns = breakdowns_of(result.scores, grid);
  result.ranking = ranking_of(result.scores, grid);
  return result;
}

}  // namespace dualdamp::bench
