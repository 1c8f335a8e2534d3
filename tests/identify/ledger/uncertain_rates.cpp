#include "tests/identify/ledger/uncertain_rates.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify::testing {

namespace {

constexpr double deviation = 0.01;  // of m, k and the gain of x

struct Coverage {
  int intervals = 0, zeta = 0, F0 = 0;
};

/// A record with constants and a gain that are off by chance, as stated.
Measured drawn(Kind kind, std::uint64_t seed) {
  std::mt19937_64 random(7'000'003 * seed + static_cast<std::uint64_t>(kind));
  std::normal_distribution<double> off(0.0, deviation);
  const double mass = off(random);
  const double stiffness = off(random);
  Measured result = measured(kind, seed, nullptr, {.stiffness = stiffness, .gain = off(random)});
  result.constants.mass *= 1.0 + mass;
  static_cast<void>(complete(result.record, result.constants.frequency));
  return result;
}

Reader joint_reader() {
  return [](const Record& record, const KnownConstants& constants) {
    const Ledger ledger = ledger_of(record, constants);
    Estimate none;
    none.method = "joint_fit";
    refuse(none, "the ledger names friction");
    return ledger.joint.value_or(none);
  };
}

void count(const Reader& read, const Measured& measured, Coverage& coverage) {
  const ConstantUncertainties uncertainties{.mass = deviation * measured.constants.mass,
                                            .stiffness = deviation * measured.constants.stiffness,
                                            .gain_x = deviation};
  const Estimate found = with_uncertainties(read, measured.record, measured.constants, uncertainties);
  if (!found.outcome.ok() || !found.sound || !found.interval95) return;
  const auto holds = [](const std::array<double, 2>& interval, double truth) {
    return interval[0] <= truth && truth <= interval[1];
  };
  ++coverage.intervals;
  coverage.zeta += holds(found.interval95->zeta, measured.rig.zeta) ? 1 : 0;
  coverage.F0 += holds(found.interval95->F0, measured.rig.F0) ? 1 : 0;
}

}  // namespace

void print_uncertain_rates(Kind kind, int records, std::uint64_t first_seed) {
  std::map<std::string, Coverage> found;
  for (int i = 0; i < records; ++i) {
    const Measured record = drawn(kind, first_seed + static_cast<std::uint64_t>(i));
    count(joint_reader(), record, found["joint_fit"]);
    for (const MethodEntry& method : methods()) {
      if (method.takes_seconds || !method.lacks(record.record).empty()) continue;
      count([&](const Record& r, const KnownConstants& c) { return method.run(r, c); }, record,
            found[std::string(method.name)]);
    }
  }
  for (const auto& [name, c] : found) {
    const auto share = [&c = c](int part) { return 100.0 * part / std::max(1, c.intervals); };
    std::printf("uncertain, %-16s %-36s n %3d zeta %5.1f F0 %5.1f\n", std::string(name_of(kind)).c_str(),
                name.c_str(), c.intervals, share(c.zeta), share(c.F0));
  }
  std::fflush(stdout);
}

}  // namespace dualdamp::identify::testing
