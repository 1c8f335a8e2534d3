#pragma once
/// Estimates and ledgers as methods and tests might leave them, for the tests of what is concluded from them.

#include <string>
#include <vector>

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify::testing {

/// Sound and usable, with intervals of this relative half width.
inline Estimate estimate(const std::string& method, double zeta, double F0, double spread) {
  Estimate e;
  e.method = method;
  e.sound = e.usable = true;
  e.value = {zeta, 100.0 * zeta, F0 / 1000.0, F0};
  const auto around = [spread](double value) { return Interval{value * (1.0 - spread), value * (1.0 + spread)}; };
  e.interval95 = {around(zeta), around(100.0 * zeta), around(F0 / 1000.0), around(F0)};
  return e;
}

/// All assumptions hold but these, which are one departure.
inline Ledger ledger(const std::vector<Assumption>& violated) {
  Ledger ledger;
  ledger.data = "24 steady states";
  for (const Assumption assumption : assumptions()) {
    LedgerEntry& entry = ledger.entries.emplace_back();
    entry.assumption = assumption;
    entry.standing = Standing::holds;
  }
  for (const Assumption assumption : violated) {
    LedgerEntry& entry = ledger.entry(assumption);
    entry.standing = Standing::violated;
    entry.test = "something free";
    entry.p_value = 0.003;
  }
  if (!violated.empty()) ledger.departures.push_back(violated);
  return ledger;
}

}  // namespace dualdamp::identify::testing
