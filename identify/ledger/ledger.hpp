#pragma once
/// The ledger of assumptions of one record: for each, whether the record can tell, by which test, and what it does
/// to zeta and F0 when it is relaxed.
///
/// One joint model of the record (amplitude_model.hpp, decay_model.hpp, history_model.hpp) is relaxed in one way
/// after another, all tests at one level for the family (relaxation_tests.hpp). A departure is charged to the
/// assumption whose relaxation explains it best, and to those that explain it as well. It violates the assumption
/// where it moves zeta or F0 by `least_change` or more; a smaller one is told and does no harm.
///
/// Constants and gains whose uncertainties are stated violate nothing as long as they need not be off by more than
/// 2.6 of them (1 %): the departure is told, and stays relaxed in the joint estimate.
///
/// A term of friction that a test of its own would reject at 25 %, though the family must allow for chance, is not
/// charged: the intervals of the joint estimate reach over the estimate with that term free.
///
/// Cost: that of the joint model; a history of 20,000 samples takes 0.2 s.

#include <optional>
#include <string>
#include <vector>

#include "identify/assumption.hpp"
#include "identify/estimate.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify {

enum class Standing { holds, violated, untested };

/// "holds", "violated", "untested"
[[nodiscard]] std::string_view name_of(Standing standing);

struct LedgerEntry {
  Assumption assumption = Assumption::constants;
  Standing standing = Standing::untested;
  std::string test;                   ///< what was set free; empty where nothing was tested
  std::optional<double> p_value;      ///< of the family of all tests
  std::optional<double> zeta_change;  ///< relative, when relaxed
  std::optional<double> F0_change;
  std::string reason;  ///< why it is untested, what else explains a departure, how small a one would be seen
};

struct LedgerOptions {
  double least_change = 0.02;  ///< relative change of zeta or F0 that matters
  /// What lies within them is no departure from what is stated.
  ConstantUncertainties uncertainties = {};
};

struct Ledger {
  std::string data;                  ///< what was tested: "24 steady states with phases"; empty: nothing
  std::vector<LedgerEntry> entries;  ///< one for each assumption
  /// Violated assumptions of each departure, best explanation first.
  std::vector<std::vector<Assumption>> departures;
  ParameterSet plain;                                            ///< of the joint model with nothing relaxed
  core::Coordinate coordinate = core::Coordinate::displacement;  ///< for the units in sentences
  std::vector<std::string> left_out;  ///< parts of the record outside the tests' conditions, each a sentence
  std::vector<std::string> relaxed;   ///< tests of the relaxations that the joint estimate has free
  /// What the joint model itself estimates, with departures that are not friction's relaxed; nothing where there is
  /// no model.
  std::optional<Estimate> joint;

  [[nodiscard]] const LedgerEntry& entry(Assumption assumption) const {
    return entries[static_cast<std::size_t>(assumption)];
  }
  [[nodiscard]] bool is_violated(Assumption assumption) const {
    return entry(assumption).standing == Standing::violated;
  }
};

[[nodiscard]] Ledger ledger_of(const Record& record, const KnownConstants& constants,
                               const LedgerOptions& options = {});

/// The joint estimate with these relaxations free and no others, by their tests: nothing is tested.
[[nodiscard]] Estimate joint_fit(const Record& record, const KnownConstants& constants,
                                 const std::vector<std::string>& relaxed);

}  // namespace dualdamp::identify
