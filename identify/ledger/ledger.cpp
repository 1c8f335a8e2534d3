#include "identify/ledger/ledger.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "identify/conclusion.hpp"
#include "identify/ledger/advice.hpp"
#include "identify/ledger/amplitude_model.hpp"
#include "identify/ledger/decay_model.hpp"
#include "identify/ledger/estimate/joint_estimate.hpp"
#include "identify/ledger/estimate/one_frequency.hpp"
#include "identify/ledger/estimate/stated_errors.hpp"
#include "identify/ledger/estimate/stated_shares.hpp"
#include "identify/ledger/force_balance.hpp"
#include "identify/ledger/histories/history_model.hpp"
#include "identify/ledger/ledger_writer.hpp"
#include "identify/ledger/other_geometry.hpp"
#include "identify/ledger/relaxation_tests.hpp"
#include "identify/ledger/stated_noise.hpp"

namespace dualdamp::identify {

std::string_view name_of(Standing standing) {
  constexpr std::array<std::string_view, 3> names = {"holds", "violated", "untested"};
  return names[static_cast<std::size_t>(standing)];
}

namespace {

using MaybeModel = std::variant<JointModel, std::string>;

/// The first of the models that the record allows; else why there is none.
MaybeModel testable_model(const Record& record, const KnownConstants& constants, const KnownDeviations& known,
                          std::string* missed = nullptr) {
  MaybeModel model = std::string("the record holds nothing that can be tested");
  if (!record.histories.empty()) model = history_model(record, constants, known.sigma_x, missed);
  if (auto* of_histories = std::get_if<JointModel>(&model); of_histories != nullptr && known.sigma_Y > 0.0)
    of_histories->warnings.emplace_back(
        "the stated deviation of Y is not used by joint_fit: it reads the samples of the histories, and takes the "
        "noise of the drive from them");
  if (std::holds_alternative<std::string>(model) && record.pairs) model = amplitude_model(record, constants, known);
  if (std::holds_alternative<std::string>(model) && record.decay)
    model = decay_model(record, constants, known.sigma_x);
  return model;
}

Ledger tested_ledger(const Record& record, const KnownConstants& constants, const LedgerOptions& options) {
  Ledger ledger;
  ledger.coordinate = constants.coordinate;
  ledger.recorded = recorded_in(record);
  for (const Assumption assumption : assumptions()) ledger.entries.emplace_back().assumption = assumption;
  const MaybeModel found = testable_model(record, constants, options.deviations, &ledger.missed_motion);
  if (const auto* reason = std::get_if<std::string>(&found)) {
    for (LedgerEntry& entry : ledger.entries) entry.reason = *reason;
    return ledger;
  }
  const auto& model = std::get<JointModel>(found);
  ledger.data = model.data;
  ledger.tests_histories = model.of_histories;
  ledger.plain = model.value;
  ledger.left_out = model.left_out;
  ledger.unlike_zeros = model.unlike_zeros;
  ledger.warnings = model.warnings;
  const StatedShares shares(constants, options.uncertainties);
  const ConstantUncertainties& u = options.uncertainties;
  RelaxationTests tests =
      test_relaxations(model, {.least_change = options.least_change,
                               .mass = shares.mass(),
                               .stiffness = shares.stiffness(),
                               .gains = std::max({u.gain_x, u.gain_y, u.gain_v, u.gain_a, u.gain_force}) > 0.0,
                               .allowed = allowed_error(u, constants)});
  share_out(model, shares, tests);
  LedgerWriter writer(model, tests, constants, shares, options);
  writer.write(ledger);
  ledger.misfit = tests.misfit;
  if (ledger.misfit)
    writer.withdraw(*ledger.misfit, ledger);
  else
    writer.add_sight(ledger);
  // If friction over speed or displacement may be what departs, and it matters, no relaxed model has one zeta and
  // one F0, unless it is a law that has them and follows every sample. With friction that differs between the
  // directions, they are the means of both.
  const bool is_friction = std::ranges::any_of(ledger.departures, [](const std::vector<Assumption>& named) {
    return std::ranges::any_of(named, is_of_law);
  });
  const bool is_fitted = (!is_friction || follows_law(model, tests)) && !ledger.is_unexplained && !ledger.misfit;
  if (!is_fitted || !(constants.stiffness > 0.0 && constants.mass > 0.0)) return ledger;
  ledger.frees_law = is_friction;
  ledger.joint = relaxed_estimate(model, tests, shares);
  ledger.unseen = unseen_friction(model, tests, *ledger.joint, shares);
  ledger.joint_knows_uncertainties = knows_stated_errors(model);
  for (const FoundDeparture& departure : tests.departures)
    ledger.relaxed.push_back(model.relaxations[departure.explanations.front().index].test);
  note_nearly_seen(model, tests, ledger);
  return ledger;
}

}  // namespace

Ledger ledger_of(const Record& record, const KnownConstants& constants, const LedgerOptions& options) {
  Ledger ledger = tested_ledger(record, constants, options);
  explain_by_geometry(
      record, constants, [&](const Record& other) { return tested_ledger(other, constants, options); }, ledger);
  ledger.largest = largest_friction(record, constants);
  charge_force_balance(record, constants, options.uncertainties, ledger);
  join_at_one_frequency(constants, ledger);
  return ledger;
}

Estimate joint_fit(const Record& record, const KnownConstants& constants, const std::vector<std::string>& relaxed,
                   const LedgerOptions& options) {
  Estimate none;
  const MaybeModel found = testable_model(record, constants, options.deviations);
  if (const auto* reason = std::get_if<std::string>(&found)) {
    refuse(none, *reason);
    return none;
  }
  const auto& model = std::get<JointModel>(found);
  Taken numbers;
  for (const std::string& test : relaxed) {
    const auto at = std::ranges::find(model.relaxations, test, &Relaxation::test);
    if (at == model.relaxations.end()) {
      refuse(none, "the record does not determine: " + test);
      return none;
    }
    numbers.push_back(static_cast<std::size_t>(at - model.relaxations.begin()));
  }
  return joint_estimate(model.refit && !numbers.empty() ? model.refit(numbers) : model, numbers,
                        StatedShares(constants, options.uncertainties), "all of " + model.data + " together");
}

}  // namespace dualdamp::identify
