/// How well fits to one history of random rigs predict another, and whether a wrong law is called so.
/// usage: prediction_rates [FIRST_SEED LAST_SEED [LAW]...]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "identify/fit/prediction.hpp"
#include "tests/identify/fit/random_rigs.hpp"

using namespace dualdamp;

namespace {

struct Rates {
  int rigs = 0, within = 0, called_wrong = 0, off = 0, off_and_called = 0;
  double worst = 0.0;
};

/// `error` over what the true rig reaches, its first state found like that of the others.
void count(const identify::Prediction& found, double true_error, Rates& rates) {
  constexpr double allowed = 1.1;
  const double ratio = found.error / true_error;
  ++rates.rigs;
  rates.worst = std::max(rates.worst, ratio);
  rates.within += ratio <= allowed ? 1 : 0;
  rates.called_wrong += found.is_wrong ? 1 : 0;
  rates.off += ratio > allowed ? 1 : 0;
  rates.off_and_called += ratio > allowed && found.is_wrong ? 1 : 0;
}

void say(const std::string& law, const char* fitted, const Rates& r) {
  std::printf(
      "%-20s fitted as %-12s %d of %d within 10 %% of the true rig, at most %.3g times; called wrong %d, of "
      "the %d others %d\n",
      law.c_str(), fitted, r.within, r.rigs, r.worst, r.called_wrong, r.off, r.off_and_called);
}

void describe(const std::string& what, std::uint64_t seed, double noise, const identify::Prediction& found,
              double true_error) {
  std::printf("%s, seed %d, noise %g: %.3g times; T %.3g of %g, chance %.2g; %s\n", what.c_str(),
              static_cast<int>(seed), noise, found.error / true_error, found.compromise.statistic,
              found.compromise.freedom, found.compromise.p_value, found.text.c_str());
}

void run(const std::string& law, std::uint64_t first, std::uint64_t last) {
  Rates right;
  Rates wrong;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const test::RandomRig rig = test::random_rig(law, test::MotionKind::forced, seed);
    const test::RandomRig second = test::driven_again(rig, 1.5, 100'000 + seed);
    const identify::Fit fit = test::fit_of(rig);
    const identify::Prediction truth =
        identify::predict_records(second.truth, {}, {}, test::experiments_of(second));
    if (!fit.outcome.ok() || !truth.outcome.ok()) {
      std::printf("%s, seed %d: no fit\n", law.c_str(), static_cast<int>(seed));
      continue;
    }
    const identify::Prediction found = test::predicted_by(fit, second);
    if (!(found.error > 0.0))
      std::printf("%s, seed %d: no prediction, %s\n", law.c_str(), static_cast<int>(seed),
                  found.outcome.reason.c_str());
    count(found, truth.error, right);
    describe(law, seed, rig.noise, found, truth.error);
    if (law == "coulomb") continue;
    test::RandomRig other = rig;
    other.sought.laws.front() = {friction::find_law("coulomb"), {}};
    const identify::Fit beside = test::fit_of(other);
    if (!beside.outcome.ok()) continue;
    const identify::Prediction missed = test::predicted_by(beside, second);
    count(missed, truth.error, wrong);
    describe(law + " as coulomb", seed, rig.noise, missed, truth.error);
  }
  say(law, law.c_str(), right);
  if (law != "coulomb") say(law, "coulomb", wrong);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const std::uint64_t last = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 12;
  std::vector<std::string> laws(argv + std::min(argc, 3), argv + argc);
  if (laws.empty()) laws = {"coulomb", "contact_compliance", "stribeck"};
  for (const std::string& law : laws) run(law, first, last);
  return 0;
}
