#include "identify/ledger/estimate/unstated_constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "core/constants.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify {

namespace {

/// The largest change of zeta or F0 by a departure that the tests of this assumption may miss, relative.
double most_missed(const Ledger& ledger, Assumption assumption) {
  const LedgerEntry& entry = ledger.entry(assumption);
  // Beside one that is free no test sees another.
  const bool is_freed = assumption == Assumption::constants && entry.is_as_stated;
  if (entry.standing == Standing::untested || is_freed) return core::infinity;
  // What is missed in one record of five lies 2.8 standard errors from nothing. At the level of a family of tests,
  // some 2.9 of them, one record of twenty misses 2.9 + 1.6.
  constexpr double of_family = 1.6;
  return of_family * entry.sight.value_or(0.0);
}

/// An estimate that one set of constants may move, by no more than the tests may miss.
struct Moved {
  ConstantUncertainties by;
  double most = 0.0;
};

/// Constants, then gains, of which none is stated to be surer.
std::array<Moved, 2> unstated(const KnownConstants& constants, const LedgerOptions& options, const Ledger& ledger) {
  std::array<Moved, 2> list = {
      {{{}, most_missed(ledger, Assumption::constants)}, {{}, most_missed(ledger, Assumption::sensors)}}};
  for (const StatedNumber& number : stated_numbers) {
    const double size = number.is_gain() ? 1.0 : constants.*number.constant;
    ConstantUncertainties& by = list[number.is_gain() ? 1 : 0].by;
    if (!(options.uncertainties.*number.uncertainty > 0.0) && std::isfinite(size))
      by.*number.uncertainty = unstated_uncertainty * size;
  }
  return list;
}

/// An end of the range moves by what the uncertainty adds to the interval, as an independent error does.
void reach(double value, double most, const Interval& plain, const Interval& uncertain, Interval& range,
           std::array<std::string, 2>& by) {
  for (std::size_t end = 0; end < 2; ++end) {
    const double own = plain[end] - value;
    const double added = std::sqrt(std::max(0.0, std::pow(uncertain[end] - value, 2) - own * own));
    const double counted = std::min(added, most * std::abs(value));
    const double before = std::abs(range[end] - value);
    const double side = std::hypot(before, counted);
    range[end] = end == 0 ? std::min(range[0], std::max(0.0, value - side)) : std::max(range[1], value + side);
    if (counted > before) by[end] = "constants or gains off by 1 %";
  }
}

}  // namespace

void reach_over_unstated(const Record& record, const KnownConstants& constants, const LedgerOptions& options,
                         Ledger& ledger) {
  if (!ledger.unseen || !ledger.joint) return;
  const Reader read = [&](const Record& moved, const KnownConstants& known) {
    return joint_fit(moved, known, ledger.relaxed, options);
  };
  std::optional<Estimate> plain;
  for (const Moved& moved : unstated(constants, options, ledger)) {
    if (!moved.by.any() || !(moved.most > options.least_change)) continue;
    if (!plain) plain = read(record, constants);
    const Estimate uncertain = with_uncertainties(read, record, constants, moved.by);
    if (!plain->interval95 || !uncertain.interval95) {
      ledger.warnings.emplace_back(
          "the range of the answer does not count errors of 1 % of constants and gains, which were not tested: with "
          "such an error there is no joint fit");
      return;
    }
    UnseenRange& range = *ledger.unseen;
    std::array<std::string, 2> unnamed;
    const auto reach_of = [&](double ParameterSet::* value, Interval ParameterIntervals::* at,
                              std::array<std::string, 2>& by) {
      reach(plain->value.*value, moved.most, (*plain->interval95).*at, (*uncertain.interval95).*at, range.ends.*at,
            by);
    };
    reach_of(&ParameterSet::zeta, &ParameterIntervals::zeta, range.zeta_by);
    reach_of(&ParameterSet::F0, &ParameterIntervals::F0, range.F0_by);
    reach_of(&ParameterSet::c, &ParameterIntervals::c, unnamed);
    reach_of(&ParameterSet::x_f, &ParameterIntervals::x_f, unnamed);
  }
}

}  // namespace dualdamp::identify
