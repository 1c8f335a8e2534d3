/// How often the truth lies within the intervals of fits: each law fitted to its own noisy records.
/// usage: fit_coverage [--no-profiles] [history|pairs|loop [SEEDS|FIRST-LAST [LAW]...]]
///        fit_coverage small [SEEDS|FIRST-LAST]: records of few readings

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

struct Count {
  int covered = 0, intervals = 0;
  int profiled = 0, profiles = 0;
  int named = 0;     ///< the fit says itself that the data do not hold it
  double sum = 0.0;  ///< of (estimate - truth)/std
  double squares = 0.0;

  void add(const identify::FittedParameter& fitted, double truth, bool is_named) {
    const auto holds = [truth](const identify::Interval& ends) { return ends[0] <= truth && truth <= ends[1]; };
    if (is_named || fitted.at_bound || std::isnan(fitted.interval95[0])) {
      ++named;
      return;
    }
    ++intervals;
    covered += holds(fitted.interval95) ? 1 : 0;
    const double off = fitted.std > 0.0 ? (fitted.value - truth) / fitted.std : 0.0;
    sum += off;
    squares += off * off;
    if (std::isnan(fitted.profile95[0]) || std::isnan(fitted.profile95[1])) return;
    ++profiles;
    profiled += holds(fitted.profile95) ? 1 : 0;
  }
};

bool stands_in_trade_offs(const identify::Fit& fit, const std::string& name) {
  return std::ranges::any_of(fit.not_identifiable, [&](const identify::TradeOff& trade_off) {
    return std::ranges::find(trade_off.parameters, name) != trade_off.parameters.end();
  });
}

struct Seeds {
  int first = 1;
  int last = 100;
};

void run(const test::LawCase& law, test::RecordKind kind, const Seeds& seeds, bool profile) {
  std::map<std::string, Count> counts;
  std::vector<std::string> order;
  std::string beside;
  int failed = 0;
  int warned = 0;
  const std::clock_t begin = std::clock();
  const std::string case_name = name_of(law);
  const identify::Rig rig = test::rig_with(law);
  const test::Laboratory laboratory(law, kind);
  for (int seed = seeds.first; seed <= seeds.last; ++seed) {
    const test::KnownFit known = laboratory.fit(static_cast<std::uint64_t>(seed), profile);
    const identify::Fit& fit = known.fit;
    if (!fit.outcome.ok()) {
      ++failed;
      std::printf("%s: %s\n", case_name.c_str(), fit.outcome.reason.c_str());
      continue;
    }
    if (!fit.warnings.empty()) ++warned;
    if (known.leaves_more_than_the_truth) beside += " " + std::to_string(seed);
    for (const identify::FittedParameter& fitted : fit.parameters) {
      const std::string& name = fitted.parameter.name;
      if (fitted.parameter.owner == identify::Owner::record) continue;
      if (!counts.contains(name)) order.push_back(name);
      counts[name].add(fitted, test::truth_of(rig, name), stands_in_trade_offs(fit, name));
    }
  }
  for (const std::string& name : order) {
    const Count& c = counts[name];
    const double intervals = std::max(c.intervals, 1);
    std::printf("%-24s %-22s %3d/%-3d %5.1f %%  profile %3d/%-3d %5.1f %%  named %3d  mean %5.2f  rms %5.2f\n",
                case_name.c_str(), name.c_str(), c.covered, c.intervals, 100.0 * c.covered / intervals, c.profiled,
                c.profiles, 100.0 * c.profiled / std::max(c.profiles, 1), c.named, c.sum / intervals,
                std::sqrt(c.squares / intervals));
  }
  const int fits = seeds.last - seeds.first + 1;
  std::printf("%-24s %d fits, %d failed, %d with warnings, %.2f s each%s%s\n", case_name.c_str(), fits, failed,
              warned, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / fits,
              beside.empty() ? "" : "; beside the least squares with seeds", beside.c_str());
  std::fflush(stdout);
}

/// Records of few readings, whose noise is not stated.
void run_small(const Seeds& seeds) {
  for (const test::SmallRecord& plan : std::initializer_list<test::SmallRecord>{{true, 5, true},
                                                                                {true, 6, true},
                                                                                {true, 8, true},
                                                                                {true, 12, true},
                                                                                {true, 6, false},
                                                                                {false, 4, true},
                                                                                {false, 4, false}}) {
    const identify::Rig rig = test::rig_of(plan);
    std::map<std::string, Count> counts;
    for (int seed = seeds.first; seed <= seeds.last; ++seed) {
      const identify::Fit fit = test::fit_of(plan, static_cast<std::uint64_t>(seed));
      for (const identify::FittedParameter& fitted : fit.parameters)
        if (fitted.parameter.owner != identify::Owner::record)
          counts[fitted.parameter.name].add(fitted, test::truth_of(rig, fitted.parameter.name), false);
    }
    for (const auto& [name, count] : counts)
      std::printf("%2d %s%s %-8s %3d/%-3d  none %3d  rms %5.2f\n", plan.readings,
                  plan.is_decay ? "extremes" : "amplitudes",
                  !plan.has_second ? ""
                  : plan.is_decay  ? ", times"
                                   : ", phases",
                  name.c_str(), count.covered, count.intervals, count.named,
                  std::sqrt(count.squares / std::max(count.intervals, 1)));
    std::fflush(stdout);
  }
}

Seeds seeds_of(const std::string& text) {
  const std::size_t cut = text.find('-');
  if (cut == std::string::npos) return {1, std::atoi(text.c_str())};
  return {std::atoi(text.c_str()), std::atoi(text.c_str() + cut + 1)};
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool profile = std::erase(words, "--no-profiles") == 0;
  const std::string kind = words.empty() ? "history" : words[0];
  const Seeds seeds = words.size() > 1 ? seeds_of(words[1]) : Seeds{};
  if (kind == "small") {
    run_small(seeds);
    return 0;
  }
  if (kind != "history" && kind != "pairs" && kind != "loop") {
    std::cerr << "usage: fit_coverage [--no-profiles] [history|pairs|loop [SEEDS|FIRST-LAST [LAW]...]]\n"
                 "       fit_coverage small [SEEDS|FIRST-LAST]\n";
    return 64;
  }
  words.erase(words.begin(), words.begin() + std::min<std::ptrdiff_t>(2, std::ssize(words)));
  const test::RecordKind records = kind == "pairs"  ? test::RecordKind::pairs
                                   : kind == "loop" ? test::RecordKind::loop
                                                    : test::RecordKind::history;
  for (const test::LawCase& law : test::law_cases())
    if ((words.empty() || std::ranges::find(words, name_of(law)) != words.end()) && test::shows(law, records))
      run(law, records, seeds, profile);
  return 0;
}
