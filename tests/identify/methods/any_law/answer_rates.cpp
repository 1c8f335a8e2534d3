#include "tests/identify/methods/any_law/answer_rates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "identify/answer/answer.hpp"
#include "identify/methods.hpp"
#include "identify/records/derived_records.hpp"

namespace dualdamp::identify::testing {

namespace {

/// Severity. Beyond it, contacts hardly slide, and a drag hides all other friction.
constexpr double strong = 1.0;

Record three_sweeps(const LawRig& rig, const identify::departures::Departure& departure, double severity,
                    std::uint64_t seed) {
  constexpr int levels = 8;
  constexpr int sweeps = 3;
  std::vector<PlannedState> states;
  for (int i = 0; i < sweeps * levels; ++i) {
    const double x = rig.reference.amplitude * (0.5 + i % levels / (levels - 1.0));
    const double friction = 4.0 / std::numbers::pi * rig.truth.F0 / rig.truth.model.oscillator.stiffness;
    states.push_back({2.0 * rig.zeta * x + friction, rig.reference.frequency});
  }
  Record record = states_record(rig, &departure, severity, states, false, seed);
  if (record.pairs)
    for (std::size_t i = 0; i < record.pairs->pairs.size(); ++i)
      record.pairs->pairs[i].sweep = std::to_string(i / levels + 1);
  return record;
}

Identification identified(Record record, const KnownConstants& constants) {
  static_cast<void>(complete(record, constants.frequency));
  Ledger ledger = ledger_of(record, constants);
  std::vector<Estimate> estimates;
  // If the estimate of the joint model is usable it answers, and the other methods need not run.
  if (ledger.joint && ledger.joint->usable && ledger.joint->interval95) {
    estimates.push_back(*ledger.joint);
    return concluded(std::move(estimates), std::move(ledger));
  }
  for (const MethodEntry& method : methods())
    if (method.lacks(record).empty()) estimates.push_back(method.run(record, constants));
  return concluded(std::move(estimates), std::move(ledger));
}

double missed(const Interval& interval, double truth) {
  return std::max({interval[0] - truth, truth - interval[1], 0.0}) / truth;
}

}  // namespace

void print_answers(const identify::departures::Departure& departure, int records, std::uint64_t first) {
  const double severity = std::min(strong, departure.largest);
  int played = 0;
  std::array<int, 2> held{};
  int far = 0;
  std::map<std::string, int> by;
  std::string misses;
  for (int i = 0; i < records; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    LawRig rig = law_rig(LawRecord::amplitudes, seed);
    rig.noise = 0.005;
    Record record = three_sweeps(rig, departure, severity, seed);
    if (!record.pairs) continue;
    ++played;
    const Identification all = identified(std::move(record), rig.constants);
    if (!all.answer || !all.estimates[*all.answer].interval95) {
      ++by["none"];
      continue;
    }
    const Estimate& answer = all.estimates[*all.answer];
    ++by[answer.method];
    const double zeta = departure.has_zeta ? missed(answer.interval95->zeta, rig.zeta) : 0.0;
    const double F0 = departure.has_F0 ? missed(answer.interval95->F0, rig.truth.F0) : 0.0;
    held[0] += zeta == 0.0 ? 1 : 0;
    held[1] += F0 == 0.0 ? 1 : 0;
    constexpr double much = 0.05;
    far += std::max(zeta, F0) > much ? 1 : 0;
    if (zeta > 0.0 || F0 > 0.0)
      misses += "  seed " + std::to_string(seed) + " misses zeta by " + std::to_string(100.0 * zeta) +
                " %, F0 by " + std::to_string(100.0 * F0) + " %: " + all.verdict + "\n";
  }
  std::printf("answers/%-26s severity %.2g n %d | hold zeta %d, F0 %d, miss by over 5 %% %d | by",
              std::string(departure.name).c_str(), severity, played, held[0], held[1], far);
  for (const auto& [method, count] : by) std::printf(" %s %d", method.c_str(), count);
  std::printf("\n%s", misses.c_str());
  std::fflush(stdout);
}

}  // namespace dualdamp::identify::testing
