#include "identify/ledger/estimate/one_frequency.hpp"

#include <algorithm>
#include <vector>

namespace dualdamp::identify {

namespace {

std::string beside(const std::string& wanted, const std::string& other) {
  return (wanted.empty() ? "" : "these data fit " + wanted + "; ") +
         "at one frequency its effect is that of the other: explained as well by: " + other;
}

}  // namespace

void join_at_one_frequency(const KnownConstants& constants, Ledger& ledger) {
  using Assumption::one_mode;
  const bool is_alike = ledger.recorded.states && !ledger.recorded.frequencies && !ledger.tests_histories;
  if (!is_alike || !ledger.is_violated(Assumption::constants) || !ledger.is_violated(one_mode)) return;
  const auto departure_of = [&](Assumption assumption) {
    return std::ranges::find_if(ledger.departures, [&](const auto& named) { return names(named, assumption); });
  };
  const auto first = departure_of(one_mode);
  const auto second = departure_of(Assumption::constants);
  if (first == ledger.departures.end() || second == ledger.departures.end() || first == second) return;
  for (const Assumption assumption : *second)
    if (!names(*first, assumption)) first->push_back(assumption);
  ledger.departures.erase(second);
  LedgerEntry& own = ledger.entry(Assumption::constants);
  own.reason = beside(own.wanted, "one_mode");
  ledger.entry(one_mode).reason = beside("", "constants");
  if (!ledger.joint || !ledger.joint->interval95) return;
  ParameterIntervals& at = *ledger.joint->interval95;
  const double critical = constants.critical_damping();
  at.zeta = {std::min(at.zeta[0], at.c[0] / critical), std::max(at.zeta[1], at.c[1] / critical)};
  if (ledger.unseen)
    ledger.unseen->ends.zeta = {std::min(ledger.unseen->ends.zeta[0], at.zeta[0]),
                                std::max(ledger.unseen->ends.zeta[1], at.zeta[1])};
}

}  // namespace dualdamp::identify
