#include "identify/ledger/ledger_writer.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "identify/ledger/advice.hpp"
#include "identify/ledger/estimate/changed_constants.hpp"
#include "identify/ledger/sensor_or_symmetry.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

constexpr int digits_shown = 2;

std::string rounded(double value) { return core::format_number(value, digits_shown); }

std::string in_percent(double share) { return core::percent(share, digits_shown); }

}  // namespace

void LedgerWriter::write(Ledger& ledger) {
  for (const FoundDeparture& departure : tests_.departures) charge(departure, ledger);
  for (const FoundDeparture& departure : tests_.departures) join_constants(departure, ledger);
  for (const RelaxationTest& test : tests_.tests) record_as_held(test, ledger);
  charge_unexplained(ledger);
  for (LedgerEntry& entry : ledger.entries)
    if (entry.standing == Standing::untested) explain(ledger, entry);
}

void LedgerWriter::add_sight(Ledger& ledger) const {
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

void LedgerWriter::withdraw(const Misfit& misfit, Ledger& ledger) const {
  for (LedgerEntry& entry : ledger.entries) {
    if (entry.standing != Standing::holds) continue;
    entry = {.assumption = entry.assumption,
             .reason = "the joint model misses these data by " + rounded(misfit.times) +
                       " times their noise, so this record cannot show it" +
                       would_show(entry.assumption, ledger.recorded)};
  }
}

Assumption LedgerWriter::assumption_of(const RelaxationTest& test) const {
  return model_.relaxations[test.index].assumption;
}

void LedgerWriter::set(const RelaxationTest& test, LedgerEntry& entry) const {
  entry.test = model_.relaxations[test.index].test;
  entry.p_value = test.p_value;
  entry.zeta_change = scale_.zeta(test.zeta_change);
  entry.F0_change = scale_.F0(test.F0_change);
}

/// Relative difference of a part of the record from the mean of all.
double LedgerWriter::unevenness(const RelaxationTest& test) const {
  return std::max(std::abs(scale_.F0(test.F0_part)), std::abs(scale_.zeta(test.zeta_part)));
}

/// Parts of the record differ: no single zeta and F0 describes them, even if the mean does not change.
bool LedgerWriter::is_uneven(const RelaxationTest& test) const { return unevenness(test) >= options_.least_change; }

bool LedgerWriter::matters(const RelaxationTest& test) const {
  return std::abs(scale_.zeta(test.zeta_change)) >= options_.least_change ||
         std::abs(scale_.F0(test.F0_change)) >= options_.least_change || is_uneven(test);
}

LedgerWriter::Judgement LedgerWriter::judge(const FoundDeparture& departure) const {
  const auto any = [&](auto is) { return std::ranges::any_of(departure.explanations, is); };
  Judgement found;
  found.is_as_stated = any([&](const RelaxationTest& t) { return is_as_stated(t); });
  found.drift_matters =
      any([&](const RelaxationTest& t) { return model_.relaxations[t.index].is_like_speed && matters(t); });
  return found;
}

/// Does the departure violate the assumption of this test, one of its explanations?
bool LedgerWriter::harms(const Judgement& judgement, const RelaxationTest& test) const {
  const bool is_of_speed = assumption_of(test) == Assumption::friction_velocity;
  return !judgement.is_as_stated && (matters(test) || (is_of_speed && judgement.drift_matters));
}

void LedgerWriter::charge(const FoundDeparture& departure, Ledger& ledger) const {
  const Judgement judgement = judge(departure);
  std::vector<Assumption> named;
  for (const RelaxationTest& test : departure.explanations) {
    LedgerEntry& entry = ledger.entry(assumption_of(test));
    if (entry.standing == Standing::violated) continue;
    const bool is_violated = harms(judgement, test);
    if (!is_violated && entry.p_value == test.p_value) continue;  // a better explanation has the entry
    set(test, entry);
    entry.is_like_speed = model_.relaxations[test.index].is_like_speed;
    entry.standing = is_violated ? Standing::violated : Standing::holds;
    entry.is_as_stated = judgement.is_as_stated;
    entry.reason = reason_of(departure, judgement, test);
    if (!is_violated) continue;
    if (entry.assumption == Assumption::constants) {
      entry.wanted = wanted_constants(departure);
      entry.fitted = constants_of_joint(departure);
      if (!entry.wanted.empty()) entry.reason = "these data fit " + entry.wanted + "; " + entry.reason;
    }
    named.push_back(entry.assumption);
  }
  if (!named.empty()) ledger.departures.push_back(std::move(named));
}

/// Why the assumption of this test is violated, or why it holds although a departure is seen.
std::string LedgerWriter::reason_of(const FoundDeparture& departure, const Judgement& judgement,
                                    const RelaxationTest& test) const {
  const std::string constant_force = size_of_constant_force(model_, test);
  if (judgement.is_as_stated)
    return "a departure is seen, and lies within the uncertainties that are stated" + constant_force;
  if (harms(judgement, test))
    return alternatives(departure, test) + other_forms(departure, test) + constant_force +
           (is_uneven(test) ? size_of_unevenness(test) : "");
  const bool another_harms = std::ranges::any_of(
      departure.explanations, [&](const RelaxationTest& other) { return harms(judgement, other); });
  return harmless() + (another_harms ? " if it is this; " + alternatives(departure, test) : "") + constant_force;
}

std::string LedgerWriter::size_of_unevenness(const RelaxationTest& test) const {
  return std::string("; ") + (test.zeta_part == 0.0 ? "F0" : "zeta") +
         " of a part of the record is off its mean by " + in_percent(unevenness(test));
}

/// "a stiffness of 1421 N/m, not the stated 1563 N/m, or a mass of 1.1 kg, not the stated 1 kg", of the fits that
/// explain the departure.
std::string LedgerWriter::wanted_constants(const FoundDeparture& departure) const {
  std::vector<std::string> texts;
  for (const RelaxationTest& test : departure.explanations)
    if (assumption_of(test) == Assumption::constants)
      for (const ChangedConstant& changed : changed_constants(test.constants, stated_))
        texts.push_back(changed.fitted + ", not the stated " + changed.stated);
  return core::joined(texts, ", or ");
}

/// The constants of the joint estimate: "a mass of 1.1 kg", or as stated where it explains the departure by
/// something else.
std::string LedgerWriter::constants_of_joint(const FoundDeparture& departure) const {
  const RelaxationTest& best = departure.explanations.front();
  const bool shares =
      StatedShares::is_shared(model_.relaxations[best.index]) && shares_.apply_to(model_, departure);
  std::vector<std::string> texts;
  for (ChangedConstant& changed : changed_constants(shares ? shares_.of(best.constants) : best.constants, stated_))
    texts.push_back(std::move(changed.fitted));
  if (!texts.empty()) return core::joined(texts, " and ");
  const bool has_inertia = assumption_of(best) == Assumption::one_mode;
  return "the stated " + text_of(stated_) + (has_inertia ? ", with inertia that a further mode adds" : "");
}

/// A further mode adds to the mass, the more the nearer the frequency comes to its own. Where the data want a
/// lower natural frequency, and inertia that grows with the frequency beside it, both may be those of one further
/// mode.
void LedgerWriter::join_constants(const FoundDeparture& seen, Ledger& ledger) const {
  const RelaxationTest& inertia = seen.explanations.front();
  LedgerEntry& own = ledger.entry(Assumption::one_mode);
  const LedgerEntry& constants = ledger.entry(Assumption::constants);
  const bool grows = assumption_of(inertia) == Assumption::one_mode && inertia.coefficient > 0.0;
  if (!grows || own.standing != Standing::holds || constants.standing != Standing::violated) return;
  const auto charged = std::ranges::find_if(
      ledger.departures, [](const std::vector<Assumption>& named) { return names(named, Assumption::constants); });
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
bool LedgerWriter::is_as_stated(const RelaxationTest& test) const {
  const KnownConstants& known = stated_;
  const double allowed = allowed_error(options_.uncertainties, known);
  if (!(allowed > 0.0)) return false;
  const Relaxation& relaxation = model_.relaxations[test.index];
  if (relaxation.assumption == Assumption::constants)
    return std::abs(std::log(test.constants.mass / known.mass)) < allowed &&
           std::abs(std::log(test.constants.stiffness / known.stiffness)) < allowed;
  return relaxation.freed == Freed::gain && std::abs(test.coefficient) < allowed;
}

std::string LedgerWriter::alternatives(const FoundDeparture& departure, const RelaxationTest& own) const {
  std::vector<Assumption> said = {assumption_of(own)};
  std::vector<std::string_view> others;
  for (const RelaxationTest& other : departure.explanations) {
    if (std::ranges::find(said, assumption_of(other)) != said.end()) continue;
    said.push_back(assumption_of(other));
    others.push_back(name_of(said.back()));
  }
  return others.empty() ? "no other assumption explains it as well"
                        : "explained as well by: " + core::joined(others);
}

/// What else of the same assumption explains the departure as well.
std::string LedgerWriter::other_forms(const FoundDeparture& departure, const RelaxationTest& own) const {
  std::vector<std::string> forms;
  for (const RelaxationTest& other : departure.explanations)
    if (other.index != own.index && assumption_of(other) == assumption_of(own) && is_of_law(assumption_of(own)))
      forms.push_back(model_.relaxations[other.index].test);
  return forms.empty() ? "" : "; it may also be: " + core::joined(forms);
}

/// The entry of an assumption shows that of its relaxations which has the least p-value.
void LedgerWriter::record_as_held(const RelaxationTest& test, Ledger& ledger) {
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
void LedgerWriter::charge_unexplained(Ledger& ledger) const {
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

std::string LedgerWriter::harmless() const {
  return "a departure is seen and moves zeta and F0 by less than " + in_percent(options_.least_change);
}

/// Why there is nothing to test of the drive; nothing if its history would show it.
std::string LedgerWriter::about_drive(const Ledger& ledger) {
  if (ledger.recorded.drive && ledger.tests_histories)
    return "the measured drive enters the model as it is: nothing rests on its being harmonic and steady";
  if (ledger.recorded.drive)
    return "the states taken from the histories do not show it; a test of the histories themselves needs no "
           "harmonic drive";
  return ledger.recorded.free && !ledger.recorded.states ? "a free vibration has no drive" : "";
}

/// A constant that is not stated is a parameter of the fit, and nothing is left that could test it.
bool LedgerWriter::is_taken_from_record(Assumption assumption) const {
  return (assumption == Assumption::constants || assumption == Assumption::one_mode) && model_.of_histories &&
         (std::isnan(stated_.mass) || std::isnan(stated_.stiffness));
}

void LedgerWriter::explain(const Ledger& ledger, LedgerEntry& entry) const {
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

}  // namespace dualdamp::identify
