/// Where searches end: laws fitted to noisy motions of random rigs of their own kind.
/// usage: fit_minima [forced|decay [SIGNALS|any [FIRST LAST [LAW]...]]]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "tests/identify/fit/random_rigs.hpp"

using namespace dualdamp;

namespace {

void print(const test::RandomRig& rig, const identify::Fit& fit, std::uint64_t seed) {
  std::printf("  seed %llu, %s, noise %g, %.1f periods, warned %d:", static_cast<unsigned long long>(seed),
              rig.signals.c_str(), rig.noise, rig.periods, fit.warnings.empty() ? 0 : 1);
  if (!fit.outcome.ok()) std::printf(" %s", fit.outcome.reason.c_str());
  for (std::size_t s = 0; s < fit.signals.size(); ++s)
    std::printf(" %.3f of the noise", fit.signals[s].rms / rig.drawn_rms[s]);
  for (const identify::FittedParameter& fitted : fit.parameters) {
    if (fitted.parameter.owner == identify::Owner::record) continue;
    std::string fault;
    const auto truth = identify::named(identify::parameters_of(rig.truth), fitted.parameter.name, fault);
    std::printf("; %s %.4g (%.4g)", fitted.parameter.name.c_str(), fitted.value, truth.front().stated);
  }
  std::printf("\n");
}

void run(const std::string& law, test::MotionKind kind, const std::string& signals, std::uint64_t first,
         std::uint64_t last) {
  int right = 0;
  int silent = 0;
  int alarms = 0;
  double longest = 0.0;
  const std::clock_t begin = std::clock();
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const test::RandomRig rig = test::random_rig(law, kind, seed, signals);
    const std::clock_t start = std::clock();
    const identify::Fit fit = test::fit_of(rig);
    longest = std::max(longest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    const bool good = test::ends_at_noise(rig, fit);
    right += good ? 1 : 0;
    alarms += good && !fit.warnings.empty() ? 1 : 0;
    silent += !good && fit.outcome.ok() && fit.warnings.empty() ? 1 : 0;
    if (!good || !fit.warnings.empty()) print(rig, fit, seed);
    std::fflush(stdout);
  }
  const int all = static_cast<int>(last - first + 1);
  std::printf(
      "%-20s %d of %d at the noise, %d of the others silent, %d false alarms; %.2f s each, longest %.2f s\n",
      law.c_str(), right, all, silent, alarms, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / all,
      longest);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> given(argv + std::min(argc, 1), argv + argc);
  const auto kind = given.size() > 0 && given[0] == "decay" ? test::MotionKind::decay : test::MotionKind::forced;
  const std::string signals = given.size() > 1 && given[1] != "any" ? given[1] : "";
  const std::uint64_t first = given.size() > 2 ? std::stoull(given[2]) : 1;
  const std::uint64_t last = given.size() > 3 ? std::stoull(given[3]) : 20;
  std::vector<std::string> laws(given.begin() + std::min<std::ptrdiff_t>(4, std::ssize(given)), given.end());
  if (laws.empty()) laws = {"coulomb", "stribeck", "contact_compliance", "dahl", "lugre"};
  for (const std::string& law : laws) run(law, kind, signals, first, last);
  return 0;
}
