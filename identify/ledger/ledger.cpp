#include "identify/ledger/ledger.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <variant>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/ledger/advice.hpp"
#include "identify/ledger/amplitude_model.hpp"
#include "identify/ledger/decay_model.hpp"
#include "identify/ledger/estimate/changed_constants.hpp"
#include "identify/ledger/estimate/joint_estimate.hpp"
#include "identify/ledger/estimate/one_frequency.hpp"
#include "identify/ledger/estimate/relative_changes.hpp"
#include "identify/ledger/estimate/stated_shares.hpp"
#include "identify/ledger/force_balance.hpp"
#include "identify/ledger/histories/history_model.hpp"
#include "identify/ledger/other_geometry.hpp"
#include "identify/ledger/relaxation_tests.hpp"
#include "identify/ledger/sensor_or_symmetry.hpp"
#include "identify/ledger/stated_noise.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

std::string_view name_of(Standing standing) {
  constexpr std::array<std::string_view, 3> names = {"holds", "violated", "untested"};
  return names[static_cast<std::size_t>(standing)];
}

namespace {

using MaybeModel = std::variant<JointModel, std::string>;

constexpr int digits_shown = 2;

std::string rounded(double value) { return core::format_number(value, digits_shown); }

std::string in_percent(double share) { return core::percent(share, digits_shown); }

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

class Writer {
 public:
  Writer(const JointModel& model, const RelaxationTests& tests, const KnownConstants& stated,
         const StatedShares& shares, const LedgerOptions& options)
      : model_(model),
        tests_(tests),
        stated_(stated),
        shares_(shares),
        options_(options),
        scale_(model, tests.freedom) {}

  void write(Ledger& ledger) {
    for (const FoundDeparture& departure : tests_.departures) charge(departure, ledger);
    for (const FoundDeparture& departure : tests_.departures) join_constants(departure, ledger);
    for (const RelaxationTest& test : tests_.tests) hold(test, ledger);
    charge_unexplained(ledger);
    for (LedgerEntry& entry : ledger.entries)
      if (entry.standing == Standing::untested) explain(ledger, entry);
  }

  /// States for each assumption that holds how large a departure must be to be seen. A test that
  /// would see only huge departures does not count as a test, nor of few states one that would miss 10 %.
  void add_sight(Ledger& ledger) const {
    constexpr std::ptrdiff_t few = 9;
    const auto states = std::ranges::count(model_.readings, ReadingKind::amplitude, &Reading::kind);
    const double most = states > 0 && states <= few ? 0.1 : 0.3;
    for (LedgerEntry& entry : ledger.entries) {
      const double blind = blind_[static_cast<std::size_t>(entry.assumption)];
      if (entry.standing != Standing::holds || !entry.reason.empty() || !std::isfinite(blind)) continue;
      const std::string size = "a departure that moves zeta or F0 by " + in_percent(blind) + " would be seen";
      if (blind > most) {
        entry = {.assumption = entry.assumption,
                 .reason = "only " + size + would_show(entry.assumption, ledger.recorded)};
      } else {
        entry.reason = size;
        entry.sight = blind;
      }
    }
  }

  /// Where the model misses the record, no assumption is known to hold.
  void withdraw(const Misfit& misfit, Ledger& ledger) const {
    for (LedgerEntry& entry : ledger.entries) {
      if (entry.standing != Standing::holds) continue;
      entry = {.assumption = entry.assumption,
               .reason = "the joint model misses these data by " + rounded(misfit.times) +
                         " times their noise, so this record cannot show it" +
                         would_show(entry.assumption, ledger.recorded)};
    }
  }

 private:
  [[nodiscard]] Assumption assumption_of(const RelaxationTest& test) const {
    return model_.relaxations[test.index].assumption;
  }

  void set(const RelaxationTest& test, LedgerEntry& entry) const {
    entry.test = model_.relaxations[test.index].test;
    entry.p_value = test.p_value;
    entry.zeta_change = scale_.zeta(test.zeta_change);
    entry.F0_change = scale_.F0(test.F0_change);
  }

  /// Relative difference of a part of the record from the mean of all.
  [[nodiscard]] double unevenness(const RelaxationTest& test) const {
    return std::max(std::abs(scale_.F0(test.F0_part)), std::abs(scale_.zeta(test.zeta_part)));
  }

  /// Parts of the record differ: no single zeta and F0 describes them, even if the mean does not change.
  [[nodiscard]] bool is_uneven(const RelaxationTest& test) const {
    return unevenness(test) >= options_.least_change;
  }

  [[nodiscard]] bool matters(const RelaxationTest& test) const {
    return std::abs(scale_.zeta(test.zeta_change)) >= options_.least_change ||
           std::abs(scale_.F0(test.F0_change)) >= options_.least_change || is_uneven(test);
  }

  void charge(const FoundDeparture& departure, Ledger& ledger) const {
    const auto any = [&](auto is) { return std::ranges::any_of(departure.explanations, is); };
    const bool stated = any([&](const RelaxationTest& t) { return is_as_stated(t); });
    const bool of_step = is_of_step(departure.explanations.front());
    // The terms of speed have few forms: the drift shows what another form would move.
    const bool drift_matters =
        any([&](const RelaxationTest& t) { return model_.relaxations[t.index].is_like_speed && matters(t); });
    const auto harming = [&](const RelaxationTest& t) {
      const bool is_of_speed = assumption_of(t) == Assumption::friction_velocity;
      return !stated && !of_step && (matters(t) || (is_of_speed && drift_matters));
    };
    std::vector<Assumption> named;
    for (const RelaxationTest& test : departure.explanations) {
      LedgerEntry& entry = ledger.entry(assumption_of(test));
      if (entry.standing == Standing::violated) continue;
      const bool harms = harming(test);
      if (!harms && entry.p_value == test.p_value) continue;  // a better explanation has the entry
      set(test, entry);
      entry.is_like_speed = model_.relaxations[test.index].is_like_speed;
      entry.standing = harms ? Standing::violated : Standing::holds;
      entry.is_of_step = of_step && !stated;
      entry.is_as_stated = stated;
      entry.reason = harms    ? alternatives(departure, test)
                     : stated ? "a departure is seen, and lies within the uncertainties that are stated"
                     : of_step
                         ? "the drive steps between two samples, and where between them is not known: a delay of " +
                               rounded(test.coefficient) + " s, less than their distance of " +
                               rounded(model_.step_interval) + " s, stands for it"
                         : harmless() + (any(harming) ? " if it is this; " + alternatives(departure, test) : "");
      entry.reason += size_of_constant_force(model_, test);
      if (harms && is_uneven(test))
        entry.reason += std::string("; ") + (test.zeta_part == 0.0 ? "F0" : "zeta") +
                        " of a part of the record is off its mean by " + in_percent(unevenness(test));
      if (harms && entry.assumption == Assumption::constants) {
        entry.wanted = wanted_constants(departure);
        entry.fitted = constants_of_joint(departure);
        if (!entry.wanted.empty()) entry.reason = "these data fit " + entry.wanted + "; " + entry.reason;
      }
      if (harms) named.push_back(assumption_of(test));
    }
    if (!named.empty()) ledger.departures.push_back(std::move(named));
  }

  /// "a stiffness of 1421 N/m, not the stated 1563 N/m, or a mass of 1.1 kg, not the stated 1 kg", of the fits that
  /// explain the departure.
  [[nodiscard]] std::string wanted_constants(const FoundDeparture& departure) const {
    std::vector<std::string> texts;
    for (const RelaxationTest& test : departure.explanations)
      if (assumption_of(test) == Assumption::constants)
        for (const ChangedConstant& changed : changed_constants(test.constants, stated_))
          texts.push_back(changed.fitted + ", not the stated " + changed.stated);
    return core::joined(texts, ", or ");
  }

  /// The constants of the joint estimate: "a mass of 1.1 kg", or as stated where it explains the departure by
  /// something else.
  [[nodiscard]] std::string constants_of_joint(const FoundDeparture& departure) const {
    const RelaxationTest& best = departure.explanations.front();
    const bool shares =
        StatedShares::is_shared(model_.relaxations[best.index]) && shares_.apply_to(model_, departure);
    std::vector<std::string> texts;
    for (ChangedConstant& changed :
         changed_constants(shares ? shares_.of(best.constants) : best.constants, stated_))
      texts.push_back(std::move(changed.fitted));
    if (!texts.empty()) return core::joined(texts, " and ");
    const bool has_inertia = assumption_of(best) == Assumption::one_mode;
    return "the stated " + text_of(stated_) + (has_inertia ? ", with inertia that a further mode adds" : "");
  }

  /// A further mode adds to the mass, the more the nearer the frequency comes to its own. Where the data want a
  /// lower natural frequency, and inertia that grows with the frequency beside it, both may be those of one further
  /// mode.
  void join_constants(const FoundDeparture& seen, Ledger& ledger) const {
    const RelaxationTest& inertia = seen.explanations.front();
    LedgerEntry& own = ledger.entry(Assumption::one_mode);
    const LedgerEntry& constants = ledger.entry(Assumption::constants);
    const bool grows = assumption_of(inertia) == Assumption::one_mode && inertia.coefficient > 0.0;
    if (!grows || own.standing != Standing::holds || constants.standing != Standing::violated) return;
    const auto charged = std::ranges::find_if(ledger.departures, [](const std::vector<Assumption>& named) {
      return names(named, Assumption::constants);
    });
    const auto is_lower = [&](const FoundDeparture& other) {
      return std::ranges::any_of(other.explanations, [&](const RelaxationTest& test) {
        return assumption_of(test) == Assumption::constants &&
               (test.constants.mass > stated_.mass || test.constants.stiffness < stated_.stiffness);
      });
    };
    if (charged == ledger.departures.end() || std::ranges::none_of(tests_.departures, is_lower)) return;
    charged->push_back(Assumption::one_mode);
    own.standing = Standing::violated;
    own.zeta_change = constants.zeta_change;
    own.F0_change = constants.F0_change;
    own.reason =
        "even with another constant the data show inertia that grows with frequency, as a second mode causes. The fitted "
        "mass may include that mode. Wrong constants explain the data equally well";
    LedgerEntry& other = ledger.entry(Assumption::constants);
    other.reason = "these data fit " + other.wanted + "; explained as well by: one_mode";
  }

  /// Do the stated uncertainties allow constants or gains to be off by as much? All uncertainties count for each of
  /// them: the record determines only the natural frequency and the ratio of forces to motion.
  [[nodiscard]] bool is_as_stated(const RelaxationTest& test) const {
    const KnownConstants& known = stated_;
    const double allowed = allowed_error(options_.uncertainties, known);
    if (!(allowed > 0.0)) return false;
    const Relaxation& relaxation = model_.relaxations[test.index];
    if (relaxation.assumption == Assumption::constants)
      return std::abs(std::log(test.constants.mass / known.mass)) < allowed &&
             std::abs(std::log(test.constants.stiffness / known.stiffness)) < allowed;
    return relaxation.freed == Freed::gain && std::abs(test.coefficient) < allowed;
  }

  /// The unknown place of a step between two samples shows as a delay: the drive is taken as smooth between them.
  [[nodiscard]] bool is_of_step(const RelaxationTest& test) const {
    constexpr double most = 0.75;  // of the interval: half of it, and the noise
    return model_.relaxations[test.index].freed == Freed::delay &&
           std::abs(test.coefficient) < most * model_.step_interval;
  }

  [[nodiscard]] std::string alternatives(const FoundDeparture& departure, const RelaxationTest& own) const {
    std::string text;
    std::vector<Assumption> said = {assumption_of(own)};
    for (const RelaxationTest& other : departure.explanations) {
      if (std::ranges::find(said, assumption_of(other)) != said.end()) continue;
      said.push_back(assumption_of(other));
      text += (text.empty() ? "" : ", ") + std::string(name_of(said.back()));
    }
    return text.empty() ? "no other assumption explains it as well" : "explained as well by: " + text;
  }

  /// The entry of an assumption shows that of its relaxations which has the least p-value.
  void hold(const RelaxationTest& test, Ledger& ledger) {
    LedgerEntry& entry = ledger.entry(assumption_of(test));
    const bool charged = entry.standing != Standing::untested && !entry.reason.empty();
    const bool weaker = entry.p_value && (*entry.p_value <= test.p_value || is_tie(*entry.p_value, test.p_value));
    if (charged || entry.standing == Standing::violated || weaker) return;
    set(test, entry);
    const double blind = std::max(scale_.zeta(test.zeta_blind), scale_.F0(test.F0_blind));
    blind_[static_cast<std::size_t>(entry.assumption)] = blind;
    entry.standing = Standing::holds;
    entry.reason.clear();
  }

  /// Tests may still reject beside all departures found: what was fitted does not explain the record. Beside
  /// friction that departs over speed or displacement this says little about anything else: its terms are no law,
  /// and follow it only in part. A range over laws may follow it.
  void charge_unexplained(Ledger& ledger) const {
    const bool is_friction = ledger.violates_law();
    std::vector<RelaxationTest> rejecting = tests_.tests;
    std::erase_if(rejecting, [](const RelaxationTest& test) { return test.p_value >= family_level; });
    sort_with_ties(
        rejecting, [](const RelaxationTest& test) { return -test.p_value; },
        [](const RelaxationTest& a, const RelaxationTest& b) { return a.index < b.index; });
    std::vector<Assumption> named;
    for (const RelaxationTest& test : rejecting) {
      LedgerEntry& entry = ledger.entry(assumption_of(test));
      if (entry.standing != Standing::holds) continue;
      if (!matters(test)) {
        if (entry.reason.empty()) entry.reason = harmless();
        continue;
      }
      set(test, entry);
      ledger.is_unexplained = true;
      if (is_friction && !is_of_law(entry.assumption)) {
        entry.standing = Standing::untested;
        entry.reason = "its test still rejects, beside friction that the terms of the ledger follow only in part";
        continue;
      }
      entry.standing = Standing::violated;
      entry.is_like_speed = model_.relaxations[test.index].is_like_speed;
      entry.reason = "its test still rejects beside the " + std::to_string(tests_.departures.size()) +
                     " departures found, which do not explain the record";
      named.push_back(entry.assumption);
    }
    if (!named.empty()) ledger.departures.push_back(std::move(named));
  }

  [[nodiscard]] std::string harmless() const {
    return "a departure is seen and moves zeta and F0 by less than " + in_percent(options_.least_change);
  }

  /// Why there is nothing to test of the drive; nothing if its history would show it.
  [[nodiscard]] static std::string about_drive(const Ledger& ledger) {
    if (ledger.recorded.drive && ledger.tests_histories)
      return "the measured drive enters the model as it is: nothing rests on its being harmonic and steady";
    if (ledger.recorded.drive)
      return "the states taken from the histories do not show it; a test of the histories themselves needs no "
             "harmonic drive";
    return ledger.recorded.free && !ledger.recorded.states ? "a free vibration has no drive" : "";
  }

  /// A constant that is not stated is a parameter of the fit, and nothing is left that could test it.
  [[nodiscard]] bool is_taken_from_record(Assumption assumption) const {
    return (assumption == Assumption::constants || assumption == Assumption::one_mode) && model_.of_histories &&
           (std::isnan(stated_.mass) || std::isnan(stated_.stiffness));
  }

  void explain(const Ledger& ledger, LedgerEntry& entry) const {
    if (entry.p_value && !entry.reason.empty()) return;
    if (entry.assumption == Assumption::drive) {
      entry.reason = about_drive(ledger);
      if (!entry.reason.empty()) return;
    }
    const auto is_alone = std::ranges::find_if(
        tests_.alone, [&](std::size_t index) { return model_.relaxations[index].assumption == entry.assumption; });
    entry.reason = is_alone != tests_.alone.end()
                       ? "in this record its effect cannot be distinguished from that of zeta and F0"
                       : "this record cannot show it";
    if (is_taken_from_record(entry.assumption))
      entry.reason = std::string("no ") + (std::isnan(stated_.mass) ? "mass" : "stiffness") +
                     " is stated, and the fit takes it from the record; one that is stated would show it";
    else
      entry.reason += would_show(entry.assumption, ledger.recorded);
  }

  const JointModel& model_;
  const RelaxationTests& tests_;
  const KnownConstants& stated_;
  const StatedShares& shares_;
  const LedgerOptions& options_;
  RelativeChanges scale_;
  std::array<double, assumption_count> blind_ = [] {
    std::array<double, assumption_count> none{};
    none.fill(unknown);
    return none;
  }();
};

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
  Writer writer(model, tests, constants, shares, options);
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
  ledger.unseen = unseen_friction(model, tests, *ledger.joint);
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
                   const KnownDeviations& known) {
  Estimate none;
  const MaybeModel found = testable_model(record, constants, known);
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
                        "all of " + model.data + " together");
}

}  // namespace dualdamp::identify
