#include "identify/ledger/force_balance.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.hpp"
#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

std::string shown(double value) {
  constexpr int digits = 4;
  return core::format_number(value, digits);
}

/// Values of a constant at which no state needs more force than its drive gives.
struct Allowed {
  double least = 0.0;
  double most = core::infinity;

  void intersect(double low, double high) {
    least = std::max(least, low);
    most = std::min(most, high);
  }

  /// "a stiffness from 1195 to 2313 N/m, not the stated 3136 N/m"; empty where no value is allowed.
  [[nodiscard]] std::string text(const std::string& what, double stated, const std::string& unit) const {
    if (!(least < most)) return {};
    const std::string range =
        std::isfinite(most) ? "from " + shown(least) + " to " + shown(most) : "above " + shown(least);
    return what + " " + range + " " + unit + ", not the stated " + shown(stated) + " " + unit;
  }
};

/// The balance of all states of a record.
struct ForceBalance {
  int states = 0;
  int above = 0;                ///< states that need more force than their drive gives
  bool above_resonance = true;  ///< all of these
  double largest = 0.0;         ///< force needed over force given
  Allowed stiffness, mass;
};

/// Relative size of the errors that are stated.
struct StatedErrors {
  double ratio = 0.0;  ///< of m w^2/k
  double gain = 0.0;   ///< of x/Y
};

StatedErrors stated_errors(const KnownConstants& constants, const ConstantUncertainties& of) {
  return {counted_deviations * relative_of_inertia(of, constants),
          counted_deviations * std::hypot(of.gain_x, of.gain_y)};
}

ForceBalance force_balance(const std::vector<Pair>& pairs, const KnownConstants& constants,
                           const StatedErrors& errors) {
  constexpr double room = 1.1;
  ForceBalance balance;
  for (const Pair& pair : pairs) {
    const double square = std::pow(frequency_of(pair, constants), 2);
    const double inertia = constants.mass * square;
    const double ratio = inertia / constants.stiffness;
    if (!(std::isfinite(ratio) && pair.x > 0.0 && pair.Y > 0.0)) continue;
    ++balance.states;
    const double given = pair.Y / pair.x;  // k Y over k x
    balance.mass.intersect((1.0 - given) * constants.stiffness / square,
                           (1.0 + given) * constants.stiffness / square);
    balance.stiffness.intersect(inertia / (1.0 + given), given < 1.0 ? inertia / (1.0 - given) : core::infinity);
    const double needed = std::abs(1.0 - ratio) - errors.ratio * ratio;
    if (!(needed > room * (1.0 + errors.gain) * given)) continue;
    ++balance.above;
    balance.above_resonance = balance.above_resonance && ratio > 1.0;
    balance.largest = std::max(balance.largest, std::abs(1.0 - ratio) / given);
  }
  return balance;
}

std::string wanted_constants(const ForceBalance& balance, const KnownConstants& constants) {
  std::vector<std::string> texts;
  for (std::string text : {balance.stiffness.text("a stiffness", constants.stiffness, constants.unit("N/m")),
                           balance.mass.text("a mass", constants.mass, constants.unit("kg"))})
    if (!text.empty()) texts.push_back(std::move(text));
  return core::joined(texts, ", or ");
}

}  // namespace

void charge_force_balance(const Record& record, const KnownConstants& constants,
                          const ConstantUncertainties& uncertainties, Ledger& ledger) {
  if (!record.histories.empty() || !record.pairs || !ledger.departures.empty() || ledger.misfit) return;
  const ForceBalance balance =
      force_balance(record.pairs->pairs, constants, stated_errors(constants, uncertainties));
  if (2 * balance.above <= balance.states) return;
  ledger.force_excess = "spring and inertia need up to " + core::format_number(balance.largest, 2) +
                        " times the force that the base gives, k Y, in " + std::to_string(balance.above) + " of " +
                        std::to_string(balance.states) + " states";
  ledger.joint.reset();
  ledger.unseen.reset();
  ledger.relaxed.clear();
  std::vector<Assumption>& named = ledger.departures.emplace_back();
  const auto charge = [&](Assumption assumption) {
    LedgerEntry& entry = ledger.entry(assumption);
    entry = {.assumption = assumption, .standing = Standing::violated, .test = "balance of forces"};
    entry.reason = ledger.force_excess;
    named.push_back(assumption);
  };
  charge(Assumption::constants);
  LedgerEntry& entry = ledger.entry(Assumption::constants);
  entry.wanted = wanted_constants(balance, constants);
  if (!entry.wanted.empty()) entry.reason = "these data fit " + entry.wanted + "; " + entry.reason;
  if (balance.above_resonance) charge(Assumption::friction_displacement);
  if (!ledger.data.empty()) return;
  ledger.data = std::to_string(balance.states) + " steady states";
  for (LedgerEntry& other : ledger.entries)
    if (other.standing == Standing::untested) other.reason = "with these constants no friction has such states";
}

}  // namespace dualdamp::identify
