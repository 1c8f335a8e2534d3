/// How often the truth lies within the intervals of fits: each law fitted to its own noisy histories.
/// usage: fit_coverage [SEEDS [LAW]...]

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

struct Count {
  int fits = 0;
  int covered = 0;
  int profiles = 0;
  int profiled = 0;
  double sum = 0.0;  ///< of (estimate - truth)/std
  double squares = 0.0;
};

void run(const test::LawCase& law, int seeds) {
  std::map<std::string, Count> counts;
  std::vector<std::string> order;
  int failed = 0;
  const identify::Rig rig = test::rig_with(law);
  for (int seed = 0; seed < seeds; ++seed) {
    const identify::Fit fit = test::fit_of(law, static_cast<std::uint64_t>(seed) + 1);
    if (!fit.outcome.ok()) {
      ++failed;
      continue;
    }
    for (const identify::FittedParameter& fitted : fit.parameters) {
      const std::string& name = fitted.parameter.name;
      if (!counts.contains(name)) order.push_back(name);
      Count& count = counts[name];
      const double truth = test::truth_of(rig, name);
      if (!std::isnan(fitted.std) && fitted.std > 0.0) {
        ++count.fits;
        count.covered += fitted.interval95[0] <= truth && truth <= fitted.interval95[1] ? 1 : 0;
        const double off = (fitted.value - truth) / fitted.std;
        count.sum += off;
        count.squares += off * off;
      }
      if (std::isnan(fitted.profile95[0]) || std::isnan(fitted.profile95[1])) continue;
      ++count.profiles;
      count.profiled += fitted.profile95[0] <= truth && truth <= fitted.profile95[1] ? 1 : 0;
    }
  }
  for (const std::string& name : order) {
    const Count& c = counts[name];
    std::printf("%-26s %-24s %4d/%-4d %6.1f %%  profile %4d/%-4d  mean %6.2f  rms %5.2f\n", law.law.c_str(),
                name.c_str(), c.covered, c.fits, 100.0 * c.covered / std::max(c.fits, 1), c.profiled, c.profiles,
                c.sum / std::max(c.fits, 1), std::sqrt(c.squares / std::max(c.fits, 1)));
  }
  if (failed > 0) std::printf("%-26s %d of %d fits failed\n", law.law.c_str(), failed, seeds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 100;
  std::vector<std::string> wanted(argv + std::min(argc, 2), argv + argc);
  for (const test::LawCase& law : test::law_cases()) {
    bool is_wanted = wanted.empty();
    for (const std::string& name : wanted) is_wanted = is_wanted || name == law.law;
    if (is_wanted) run(law, seeds);
  }
  return 0;
}
