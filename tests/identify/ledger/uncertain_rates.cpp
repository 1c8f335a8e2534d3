#include "tests/identify/ledger/uncertain_rates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "identify/answer/answer.hpp"
#include "identify/conclusion.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify::testing {

namespace {

/// Records and intervals of one method.
struct Coverage {
  int records = 0, outcomes = 0, usable = 0, intervals = 0, zeta = 0, c = 0, F0 = 0;
  std::array<int, 2> zeta_sides{}, F0_sides{};  ///< intervals below and above the truth
};

/// A record with random errors of constants and gains, and the stated uncertainties.
struct Drawn {
  Measured measured;
  ConstantUncertainties uncertainties;
};

Drawn drawn(Kind kind, double deviation, std::uint64_t seed) {
  constexpr double of_frequency = 0.2;  // a clock is more accurate than a scale
  std::mt19937_64 random(7'000'003 * seed + static_cast<std::uint64_t>(kind));
  std::normal_distribution<double> normal;
  const auto off = [&](double share) { return share * normal(random); };
  const double mass = off(deviation);
  const double stiffness = off(deviation);
  const double gain = off(deviation);
  const double drive_gain = off(deviation);
  const bool levels = kind == Kind::xy || kind == Kind::xy_phase;
  const double frequency = levels ? off(of_frequency * deviation) : 0.0;
  Drawn result;
  result.measured =
      measured(kind, seed, nullptr,
               {.stiffness = stiffness, .frequency = frequency, .gain = gain, .drive_gain = drive_gain});
  KnownConstants& constants = result.measured.constants;
  constants.mass *= 1.0 + mass;
  static_cast<void>(complete(result.measured.record, constants.frequency));
  result.uncertainties = {.mass = deviation * constants.mass,
                          .stiffness = deviation * constants.stiffness,
                          .frequency = levels ? of_frequency * deviation * constants.frequency : 0.0,
                          .gain_y = deviation,
                          .gain_x = deviation,
                          .gain_force = deviation};
  return result;
}

Reader joint_reader(const LedgerOptions& options) {
  return [options](const Record& record, const KnownConstants& constants) {
    Estimate none;
    refuse(none, "there is no joint model");
    return ledger_of(record, constants, options).joint.value_or(none);
  };
}

void count_interval(const Estimate& found, const Rig& rig, Coverage& coverage) {
  ++coverage.records;
  if (!found.outcome.ok()) return;
  ++coverage.outcomes;
  if (!found.sound || !found.interval95) return;
  coverage.usable += found.usable ? 1 : 0;
  const auto holds = [](const Interval& interval, double truth) {
    return interval[0] <= truth && truth <= interval[1];
  };
  const auto side = [](const Interval& interval, double truth, std::array<int, 2>& sides) {
    sides[0] += truth < interval[0] ? 1 : 0;
    sides[1] += truth > interval[1] ? 1 : 0;
  };
  const ParameterIntervals& at = *found.interval95;
  ++coverage.intervals;
  coverage.zeta += holds(at.zeta, rig.zeta) ? 1 : 0;
  coverage.c += holds(at.c, 2.0 * rig.zeta * std::sqrt(rig.m * rig.k)) ? 1 : 0;
  coverage.F0 += holds(at.F0, rig.F0) ? 1 : 0;
  side(at.zeta, rig.zeta, coverage.zeta_sides);
  side(at.F0, rig.F0, coverage.F0_sides);
}

struct Rates {
  std::map<std::string, Coverage> of;  ///< by method
  int rejected = 0, friction = 0;      ///< records in which an assumption is violated
  std::map<std::string, int> named;    ///< the records in which each is
};

/// Every method that does not take seconds, and the answer of all of them.
void identify(const Drawn& drawn, Rates& rates) {
  const auto& [measured, uncertainties] = drawn;
  const auto with = [&](const Reader& read) {
    return with_uncertainties(read, measured.record, measured.constants, uncertainties);
  };
  std::vector<Estimate> estimates;
  for (const MethodEntry& method : methods()) {
    if (method.takes_seconds || !method.lacks(measured.record).empty()) continue;
    estimates.push_back(with([&](const Record& r, const KnownConstants& c) { return method.run(r, c); }));
  }
  const LedgerOptions options{.uncertainties = uncertainties};
  Ledger ledger = ledger_of(measured.record, measured.constants, options);
  if (ledger.joint && !ledger.joint_knows_uncertainties) ledger.joint = with(joint_reader(options));
  const Identification all = concluded(std::move(estimates), std::move(ledger));
  for (const Estimate& estimate : all.estimates) count_interval(estimate, measured.rig, rates.of[estimate.method]);
  if (all.answer) count_interval(all.estimates[*all.answer], measured.rig, rates.of["the answer"]);
  const auto violated = [&](Assumption assumption) { return all.ledger.is_violated(assumption); };
  for (const Assumption assumption : assumptions())
    if (violated(assumption)) ++rates.named[std::string(name_of(assumption))];
  using enum Assumption;
  rates.rejected += std::ranges::any_of(assumptions(), violated) ? 1 : 0;
  rates.friction += violated(friction_velocity) || violated(friction_displacement) || violated(symmetry) ? 1 : 0;
}

}  // namespace

void print_uncertain_rates(Kind kind, double deviation, int records, std::uint64_t first_seed) {
  Rates rates;
  for (int i = 0; i < records; ++i)
    identify(drawn(kind, deviation, first_seed + static_cast<std::uint64_t>(i)), rates);
  std::printf("uncertain %.1f %%, %-15s rejected any %.1f friction %.1f:", 100.0 * deviation,
              std::string(name_of(kind)).c_str(), 100.0 * rates.rejected / records,
              100.0 * rates.friction / records);
  for (const auto& [name, number] : rates.named) std::printf(" %s %d", name.c_str(), number);
  std::printf("\n");
  for (const auto& [name, c] : rates.of) {
    const auto share = [&counted = c](int part) { return 100.0 * part / std::max(1, counted.intervals); };
    std::printf(
        "uncertain %.1f %%, %-15s %-34s n %3d outcomes %3d usable %3d intervals %3d zeta %5.1f c %5.1f F0 %5.1f | "
        "zeta below %2d above %2d, F0 below %2d above %2d\n",
        100.0 * deviation, std::string(name_of(kind)).c_str(), name.c_str(), c.records, c.outcomes, c.usable,
        c.intervals, share(c.zeta), share(c.c), share(c.F0), c.zeta_sides[0], c.zeta_sides[1], c.F0_sides[0],
        c.F0_sides[1]);
  }
  std::fflush(stdout);
}

}  // namespace dualdamp::identify::testing
