#include "identify/methods/amplitudes/input_levels.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/readers/refusals.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;

namespace {

constexpr KnownConstants rig{0.4, 364.0, 30.1662};  // at resonance
constexpr double x_f = 0.4e-3;

/// States of zeta = 0.02 at these inputs [mm], with 0.3 % of noise in x and, if asked for, 0.2 % in Y.
Record states(const std::vector<double>& inputs, bool phases, bool noisy_inputs = false) {
  Normal normal(17);
  PairRecord record;
  for (const double input : inputs) {
    const double Y = 1e-3 * input;
    const auto state = analytic::non_sticking_state(analytic::den_hartog(0.02, 1.0), Y, x_f);
    Pair& pair = record.pairs.emplace_back();
    pair.Y = Y * (noisy_inputs ? 1.0 + 0.002 * normal() : 1.0);
    pair.x = state->amplitude * (1.0 + 0.003 * normal());
    if (phases) pair.phase = state->phase + 0.003 * normal();
    pair.number = static_cast<int>(record.pairs.size());
    pair.omega = rig.frequency;
  }
  return {record, std::nullopt};
}

}  // namespace

TEST_CASE("States of one level give no estimate by any method, and the ledger says why") {
  // Three repeats of a reading gave zeta = 0 +- 1e-13, since the speeds differed by the noise of x.
  const std::vector<double> eight(8, 1.7);
  for (const Record& record : {states({1.7, 1.7, 1.7}, false), states(eight, false), states(eight, true),
                               states(eight, false, true), states(eight, true, true)}) {
    CAPTURE(record.pairs->pairs.size(), record.pairs->pairs[1].Y, record.pairs->pairs[1].phase);
    for (const MethodEntry& method : methods())
      if (method.lacks(record).empty() && !method.takes_seconds) {
        CAPTURE(method.name);
        const Estimate estimate = method.run(record, rig);
        CHECK_FALSE(estimate.outcome.ok());
        CHECK(mentions(estimate.outcome.reason, "one level"));
      }
    if (record.pairs->pairs.size() < 4) continue;
    const Ledger ledger = ledger_of(record, rig);
    CHECK(ledger.data.empty());
    CHECK(mentions(ledger.entry(Assumption::constants).reason, "one level"));
  }
}

TEST_CASE("Levels that are 1 % apart are levels, and so is one input at several frequencies") {
  const std::vector<double> near = {1.683, 1.7, 1.717, 1.683, 1.7, 1.717, 1.683, 1.7, 1.717};
  CHECK(lacks_levels(states(near, false).pairs->pairs).empty());
  CHECK(lacks_levels(states({1.0, 1.01}, false).pairs->pairs).empty());  // two states have no noise to tell
  Record response = states({1.7, 1.7, 1.7}, false);
  for (std::size_t i = 0; i < 3; ++i) response.pairs->pairs[i].omega = 30.0 + 0.1 * static_cast<double>(i);
  CHECK(lacks_levels(response.pairs->pairs).empty());
}
