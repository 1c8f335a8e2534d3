#include "identify/methods.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <memory>

#include "identify/departures/departures.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("The list of methods is sorted, complete and can be searched") {
  const auto& list = methods();
  REQUIRE(list.size() >= 3);
  CHECK(std::is_sorted(list.begin(), list.end(),
                       [](const MethodEntry& a, const MethodEntry& b) { return a.name < b.name; }));
  Record two_sweeps = pairs(table_1);
  for (Pair& pair : two_sweeps.pairs->pairs) pair.sweep = pair.number % 2 == 0 ? "even" : "odd";
  for (const MethodEntry& method : list) {
    CAPTURE(method.name);
    CHECK(find_method(method.name) == &method);
    CHECK_FALSE(method.summary.empty());
    CHECK_FALSE(method.assumes.empty());
    CHECK_FALSE(method.equation.empty());
    // Every method names itself, and says so when the record is not of its kind.
    const Estimate e = method.run(Record{}, table_1_constants, {});
    CHECK(e.method == method.name);
    CHECK_FALSE(e.outcome.ok());
    CHECK(e.reason == method.lacks(Record{}));
    CHECK_FALSE(method.sources.empty());
    if (!reads_pairs(method.needs)) continue;
    // Amplitudes at one frequency, two sweeps, without phases: only the methods that need phases lack something.
    CHECK((method.lacks(two_sweeps) == "the record holds no x-Y pairs with phases") ==
          (method.needs == RecordKind::phases));
    CHECK(method.lacks(two_sweeps).empty() == (method.needs != RecordKind::phases));
  }
  CHECK(find_method("free_decay")->needs == RecordKind::decay);
  CHECK(find_method("resonance_two_point")->needs == RecordKind::pairs);
  CHECK(find_method("resonance_two_point")->lacks(Record{}) == "the record holds no x-Y pairs");
  CHECK(find_method("resonance") == nullptr);
  CHECK(find_method("") == nullptr);
}

TEST_CASE("Pairs at several frequencies are no record of a resonance method") {
  Record record;
  record.pairs = PairRecord{{{.Y = 0.1, .x = 0.2, .sweep = {}, .number = 1, .omega = 10.0},
                             {.Y = 0.2, .x = 0.5, .sweep = {}, .number = 2, .omega = 10.5}}};
  CHECK(find_method("resonance_two_point")->lacks(record) == "the pairs were measured at several frequencies");
  record.pairs->pairs[1].omega = 10.0;
  CHECK(find_method("resonance_two_point")->lacks(record).empty());
}

namespace {

/// Fifteen states of a rig with zeta 0.1 and F0 2 N, at three frequencies; `has_phase`: which of them, from 0, have
/// a phase.
Record mixed_states(bool (*has_phase)(int), std::uint64_t seed = 5) {
  const double zeta = 0.1;
  const double F0 = 2.0;
  Normal normal(seed);
  Record record;
  record.pairs.emplace();
  for (int i = 0; i < 15; ++i) {
    departures::Truth rig;
    rig.F0 = F0;
    rig.model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 2.0 * zeta * 10.0};
    rig.model.excitation = {.type = dualdamp::sim::ExcitationType::base_harmonic,
                            .amplitude = 0.05 + 0.01 * (i % 5),
                            .frequency = 9.0 + 0.5 * (i / 5)};
    const dualdamp::sim::Model model = departures::undisturbed(rig);
    const auto state = dualdamp::sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    Pair pair{.Y = model.excitation.amplitude, .x = state.amplitude * (1.0 + 1e-3 * normal()), .number = i + 1};
    pair.omega = model.excitation.frequency;
    const double error = 1e-3 * normal();
    if (has_phase(i)) pair.phase = state.phase + error;
    record.pairs->pairs.push_back(pair);
  }
  return record;
}

}  // namespace

TEST_CASE("States with and without phases make one record, for every method, the ledger and any_law") {
  const Record record = mixed_states([](int i) { return i % 3 != 0; });
  const KnownConstants constants{1.0, 100.0, unknown};
  int answers = 0;
  for (const MethodEntry& method : methods()) {
    if (!method.lacks(record).empty()) continue;
    CAPTURE(method.name);
    const Estimate estimate = method.run(record, constants);
    CAPTURE(estimate.outcome.reason);
    REQUIRE(estimate.outcome.ok());
    ++answers;
    CHECK(estimate.value.zeta == Approx(0.1).epsilon(0.1));
    CHECK(estimate.value.F0 == Approx(2.0).epsilon(0.1));
    if (estimate.laws) CHECK(estimate.laws->data == "15 steady states with phases");
  }
  CHECK(answers >= 4);
  const Ledger ledger = ledger_of(record, constants);
  REQUIRE(ledger.joint);
  CHECK(ledger.joint->usable);
  CHECK(ledger.joint->value.zeta == Approx(0.1).epsilon(0.02));
  CHECK(ledger.joint->value.F0 == Approx(2.0).epsilon(0.02));
}

TEST_CASE("Two phases beside many amplitudes are not taken to be exact") {
  // The curve that separates noise leaves nothing of two phases.
  int violated = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Record record = mixed_states([](int i) { return i == 3 || i == 8; }, seed);
    const Ledger ledger = ledger_of(record, {1.0, 100.0, unknown});
    violated += std::ranges::any_of(ledger.entries,
                                    [](const LedgerEntry& entry) { return entry.standing == Standing::violated; })
                    ? 1
                    : 0;
  }
  CHECK(violated <= 1);
}
