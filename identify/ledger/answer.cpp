#include "identify/ledger/answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/ledger/advice.hpp"
#include "identify/ledger/misfit.hpp"
#include "identify/ledger/preferred.hpp"
#include "identify/methods.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

namespace {

std::string number(double value) {
  constexpr int digits = 4;
  return core::format_number(value, digits);
}

std::string statements(const std::vector<Assumption>& list, const std::string& last) {
  std::vector<std::string> texts;
  for (const Assumption assumption : list) texts.emplace_back(statement_of(assumption));
  return core::joined(texts, last);
}

/// What an estimate rests on; nothing for the joint model, in which violated assumptions are relaxed.
AssumptionSet rests_on(const Estimate& estimate) {
  const MethodEntry* method = find_method(estimate.method);
  return method == nullptr ? AssumptionSet() : method->rests_on;
}

/// A departure that was seen, moves zeta or F0, and violates nothing only because the stated uncertainties allow it
/// still spoils a fit with the constants as stated.
bool rests_on_departure(const Estimate& estimate, const Ledger& ledger) {
  return std::ranges::any_of(ledger.entries, [&](const LedgerEntry& entry) {
    const double change =
        std::max(std::abs(entry.zeta_change.value_or(0.0)), std::abs(entry.F0_change.value_or(0.0)));
    return entry.standing == Standing::holds && entry.p_value.value_or(1.0) < family_level &&
           change >= LedgerOptions{}.least_change && rests_on(estimate).contains(entry.assumption);
  });
}

/// What a method found stands where the ledger did not clear it: a ledger that tested something else than the
/// histories cannot speak against what a method found in them, and one that saw a departure bears it out.
bool keeps_its_findings(const Estimate& estimate, const Ledger& ledger) {
  const MethodEntry* method = find_method(estimate.method);
  if (method == nullptr || estimate.findings.empty()) return false;
  return (method->needs == RecordKind::history && !ledger.tests_histories) || rests_on_departure(estimate, ledger);
}

std::string misfit_text(const Misfit& misfit) {
  return misfit_size(misfit) +
         ", and no single assumption that is given up explains them: friction, the spring and a further mode may "
         "depart together, or in a way that is not tested";
}

/// A range over laws of which none fits, and any other estimate where the joint model misses the record, is a
/// number that does not describe it.
bool misses(Estimate& estimate, const Ledger& ledger) {
  if (!estimate.sound) return false;
  if (const std::string none = estimate.laws ? no_law_fits(*estimate.laws) : std::string(); !none.empty())
    estimate.reason = none;
  else if (ledger.misfit && !estimate.laws)
    estimate.reason = misfit_size(*ledger.misfit);
  else if (const std::string negative = negative_friction(ledger); !negative.empty() && !estimate.laws)
    estimate.reason = negative;
  else
    return false;
  estimate.usable = false;
  return true;
}

void judge(Estimate& estimate, const Ledger& ledger) {
  if (!estimate.outcome.ok() || misses(estimate, ledger) || ledger.data.empty() || !estimate.sound) return;
  std::vector<Assumption> violated;
  for (const LedgerEntry& entry : ledger.entries)
    if (entry.standing == Standing::violated && rests_on(estimate).contains(entry.assumption))
      violated.push_back(entry.assumption);
  const bool contradicted = !estimate.usable;
  const bool clears = !keeps_its_findings(estimate, ledger);
  estimate.usable = violated.empty() && (clears || !contradicted);
  if (!violated.empty())
    estimate.reason = "the data contradict that " + statements(violated, " or that ");
  else if (contradicted && clears)
    estimate.reason = "the assumptions it rests on hold in this record";
}

/// A method that knows its bias corrects only its interval for it: the middle of the interval is the corrected
/// value. Methods that read histories are always corrected. The value of a line at resonance is reported as its
/// formula gives it, unless the interval excludes it.
void correct(Estimate& estimate) {
  if (!estimate.outcome.ok() || !estimate.interval95) return;
  const MethodEntry* method = find_method(estimate.method);
  const bool always = method != nullptr && method->needs == RecordKind::history;
  for (const ReportedParameter& parameter : reported_parameters) {
    double& value = estimate.value.*parameter.value;
    const auto& [low, high] = (*estimate.interval95).*parameter.interval;
    if (always || value < low || value > high) value = 0.5 * (low + high);
  }
}

/// An answer is not negative, nor does its interval reach below zero, the nearest value that friction can have.
void keep_physical(Estimate& estimate) {
  for (const ReportedParameter& parameter : reported_parameters) {
    double& value = estimate.value.*parameter.value;
    if (value < 0.0 && (parameter.name == "zeta" || parameter.name == "F0"))
      estimate.warnings.push_back(std::string(parameter.name) + " is fitted best by a negative value (" +
                                  number(value) +
                                  " in SI units), and is answered as zero: the data do not tell it from zero");
    value = value < 0.0 ? 0.0 : value;
    if (!estimate.interval95) continue;
    double& low = ((*estimate.interval95).*parameter.interval)[0];
    low = low < 0.0 ? 0.0 : low;
  }
}

/// The departures of friction that the ledger can relax: a range over laws answers for them.
std::vector<const LedgerEntry*> friction_departures(const Ledger& ledger) {
  std::vector<const LedgerEntry*> found;
  for (const Assumption assumption : {Assumption::friction_velocity, Assumption::friction_displacement}) {
    const LedgerEntry& entry = ledger.entry(assumption);
    if (entry.standing == Standing::violated && entry.zeta_change && entry.F0_change) found.push_back(&entry);
  }
  return found;
}

/// The interval extended to the 95 % interval of a value that a relaxation changes by the share `change`. The value
/// without it and the change have independent errors; that of the change, the larger one, follows from the test.
/// Friction is not below zero.
Interval reached(const Interval& interval, double plain, double change, double p_value) {
  const double error = std::abs(plain * change) * normal95() / normal_score(p_value);
  const double value = plain * (1.0 + change);
  return {std::min(interval[0], std::max(0.0, value - error)), std::max(interval[1], value + error)};
}

/// The library of laws reads extremes, and its departures end at a largest severity; the ledger reads the whole
/// record. A range over laws that lacks the estimate with the departure relaxed is extended to it. Returns the
/// tests of these relaxations.
std::vector<std::string> extend_to_relaxed(Estimate& estimate, const Ledger& ledger) {
  std::vector<std::string> tests;
  if (!estimate.usable || !estimate.laws || !estimate.interval95) return tests;
  for (const LedgerEntry* entry : friction_departures(ledger)) {
    ParameterIntervals& at = *estimate.interval95;
    const ParameterIntervals before = at;
    at.zeta = reached(at.zeta, ledger.plain.zeta, *entry->zeta_change, *entry->p_value);
    at.c = reached(at.c, ledger.plain.c, *entry->zeta_change, *entry->p_value);
    at.x_f = reached(at.x_f, ledger.plain.x_f, *entry->F0_change, *entry->p_value);
    at.F0 = reached(at.F0, ledger.plain.F0, *entry->F0_change, *entry->p_value);
    if (at.zeta != before.zeta || at.F0 != before.F0) tests.push_back(entry->test);
  }
  return tests;
}

std::vector<std::string> names_of(const Ledger& ledger, Standing standing) {
  std::vector<std::string> names;
  for (const LedgerEntry& entry : ledger.entries)
    if (entry.standing == standing) names.emplace_back(name_of(entry.assumption));
  return names;
}

bool departs_in_friction(const Ledger& ledger) {
  return ledger.is_violated(Assumption::friction_velocity) || ledger.is_violated(Assumption::friction_displacement);
}

std::string why_preferred(const Identification& all) {
  const auto rivals =
      std::ranges::count_if(all.estimates, [](const Estimate& e) { return std::isfinite(area(e)); });
  std::string text = all.ledger.data.empty() ? "no assumption could be tested in this record"
                                             : "none of the assumptions it rests on is violated";
  const auto usable = std::ranges::count_if(all.estimates, &Estimate::usable);
  if (rivals == 0 && usable > 1)
    text += ", and " + std::to_string(usable) +
            " methods agree; the record has no more readings than parameters, so there is no interval";
  if (rivals > 1 && all.estimates[*all.answer].method == "joint_fit")
    text += ", and it has all data; a narrower interval beside it is narrower by chance";
  else if (rivals > 1 && has_few_readings(all.ledger) && !all.estimates[*all.answer].laws)
    text +=
        ", and of " + std::to_string(rivals) +
        " such estimates its intervals are the widest that agree: of so few readings a narrower one is narrow by "
        "chance";
  else if (rivals > 1)
    text += ", and of " + std::to_string(rivals) + " such estimates its intervals are the narrowest";
  const std::vector<std::string> untested = names_of(all.ledger, Standing::untested);
  if (!all.ledger.data.empty() && !untested.empty()) text += "; untested: " + core::joined(untested, ", ");
  if (all.estimates[*all.answer].laws && departs_in_friction(all.ledger))
    text += "; it is a range over laws, and what would narrow it: " + what_would_help(all.ledger);
  return text;
}

/// Why none of the estimates is used: every departure, and what would help with each.
std::string why_contradicted(const Ledger& ledger) {
  std::vector<std::string> held;
  for (const std::vector<Assumption>& departure : ledger.departures)
    held.push_back(statements(departure, ", or that "));
  return "the data contradict that " + core::joined(held, "; they contradict that ") +
         "; what would help: " + what_would_help(ledger);
}

/// Why the readings of a record are too few to test; nothing if a single method was asked for, which speaks for
/// itself, or beside histories, of which methods find more than the ledger.
std::string why_untested(const Identification& all) {
  if (!has_few_readings(all.ledger) || all.estimates.size() < 2 || all.ledger.entries.empty()) return {};
  return all.ledger.entries.front().reason;
}

std::string why_none(const Identification& all) {
  if (all.ledger.misfit)
    return misfit_text(*all.ledger.misfit) +
           (all.ledger.departures.empty() ? "" : "; " + why_contradicted(all.ledger));
  if (!all.ledger.departures.empty()) return why_contradicted(all.ledger);
  if (std::string negative = negative_friction(all.ledger); !negative.empty()) return negative;
  const auto there = std::ranges::find_if(all.estimates, [](const Estimate& e) { return e.outcome.ok(); });
  if (there == all.estimates.end())
    return all.estimates.empty() ? "" : all.estimates.front().method + ": " + all.estimates.front().outcome.reason;
  const auto usable = std::ranges::find_if(all.estimates, &Estimate::usable);
  if (usable != all.estimates.end())
    return "the usable estimates have no intervals and do not agree; what would help: more data";
  if (std::string untested = why_untested(all); !untested.empty()) return untested;
  return there->method + ": " + there->reason;
}

std::string with_interval(double value, const std::optional<ParameterIntervals>& intervals,
                          Interval ParameterIntervals::* member, const std::string& unit) {
  std::string text = number(value) + unit;
  if (intervals) {
    const auto& [low, high] = (*intervals).*member;
    text += " (95 %: " + number(low) + " to " + number(high) + unit + ")";
  }
  return text;
}

/// "c = 203.5 N.s/m" where there is no spring to make it a damping ratio.
std::string numbers_of(const Estimate& estimate, core::Coordinate coordinate) {
  const auto unit = [&](const char* name) { return " " + core::unit_for(coordinate, name); };
  const bool spring = std::isfinite(estimate.value.zeta);
  const std::string damping =
      spring ? "zeta = " + with_interval(estimate.value.zeta, estimate.interval95, &ParameterIntervals::zeta, "")
             : "c = " + with_interval(estimate.value.c, estimate.interval95, &ParameterIntervals::c, unit("N.s/m"));
  return damping +
         ", F0 = " + with_interval(estimate.value.F0, estimate.interval95, &ParameterIntervals::F0, unit("N"));
}

/// "These data contradict that ... (cubic stiffness, p = 0.002).", for each departure.
std::string departures_text(const Ledger& ledger) {
  std::string text;
  for (const std::vector<Assumption>& departure : ledger.departures) {
    const LedgerEntry& first = ledger.entry(departure.front());
    text += " These data contradict that " + statements(departure, ", or that ") + " (" + first.test +
            ", p = " + core::format_number(*first.p_value, 2) + ")";
    const std::string& wanted = ledger.entry(Assumption::constants).wanted;
    const bool of_constants = std::ranges::count(departure, Assumption::constants) > 0;
    text += of_constants && !wanted.empty() ? ": they want " + wanted + "." : ".";
  }
  return text;
}

/// "zero of x free (p = 1e-20)", of departures that are seen and violate nothing. Entries with the same p are one
/// departure.
std::string harmless_text(const Ledger& ledger) {
  std::vector<std::string> texts;
  std::vector<double> seen;
  for (const LedgerEntry& entry : ledger.entries) {
    if (entry.standing != Standing::holds || entry.p_value.value_or(1.0) >= family_level) continue;
    const auto known = std::ranges::find(seen, *entry.p_value);
    if (known != seen.end()) {
      texts[static_cast<std::size_t>(known - seen.begin())].insert(0, entry.test + " or ");
      continue;
    }
    seen.push_back(*entry.p_value);
    texts.push_back(entry.test + " (p = " + core::format_number(*entry.p_value, 2) + ")");
  }
  return core::joined(texts, "; ");
}

std::string trend_text(const std::vector<Estimate>& estimates, core::Coordinate coordinate) {
  const auto trend = std::ranges::find_if(estimates, [](const Estimate& e) { return e.subsets.size() > 1; });
  if (trend == estimates.end()) return {};
  const auto range = [&](double ParameterSet::* member) {
    return number(trend->subsets.front().value.*member) + " to " + number(trend->subsets.back().value.*member);
  };
  return " From " + trend->subsets.front().label + " to " + trend->subsets.back().label +
         " of the data zeta goes from " + range(&ParameterSet::zeta) + " and F0 from " + range(&ParameterSet::F0) +
         " " + core::unit_for(coordinate, "N") + ".";
}

/// An estimate cannot be used if the joint model excludes it, which has all of the same data and no known
/// departure. Ranges over laws are wider than the joint model on purpose, and are never excluded.
bool excluded(Estimate& estimate, const std::optional<Estimate>& joint) {
  if (!joint || !joint->usable || estimate.laws || !disagree(*joint, estimate)) return false;
  estimate.usable = false;
  estimate.reason = "joint_fit, which has all data, excludes it: zeta = " + number(joint->value.zeta) +
                    ", F0 = " + number(joint->value.F0);
  return true;
}

/// Did the method find against the law of friction? A method that claims no interval says so among its findings,
/// and says nothing about the law.
bool finds_departure(const Estimate& estimate) {
  if (!estimate.outcome.ok() || estimate.laws) return false;
  return (estimate.lack_of_fit && estimate.lack_of_fit->fired) ||
         (estimate.interval95 && !estimate.findings.empty());
}

/// Where the ledger tested nothing, what one method finds against the law counts against all that rest on it.
void share_findings(std::vector<Estimate>& estimates) {
  const auto finder = std::ranges::find_if(estimates, finds_departure);
  if (finder == estimates.end() || finder->findings.empty()) return;
  const std::string reason =
      finder->method + " finds a departure from the law that both rest on: " + finder->findings.front();
  for (Estimate& estimate : estimates) {
    if (!estimate.usable || estimate.laws) continue;
    estimate.usable = false;
    estimate.reason = reason;
  }
}

/// The ranges over all laws, and which laws end them, or why they are not to be used.
std::string over_laws(const Identification& all) {
  const auto found = std::ranges::find_if(all.estimates, [](const Estimate& e) { return e.laws != nullptr; });
  if (found == all.estimates.end()) return {};
  // Where nothing is usable, the reason of all says it.
  if (!found->usable)
    return all.answer ? " The range over laws is not to be used: " + found->reason + "." : std::string();
  const LawIntervals& laws = *found->laws;
  const auto range = [](const Interval& ends) { return number(ends[0]) + " to " + number(ends[1]); };
  const auto ends = [](const std::array<std::string, 2>& names) {
    return names[0] == names[1] ? "'" + names[0] + "' ends it" : "'" + names[0] + "' and '" + names[1] + "' end it";
  };
  const auto allowed = std::ranges::count_if(laws.laws, [](const LawAnswer& law) { return !law.rejected; });
  return " Over the " + std::to_string(allowed) + " laws that these data allow: zeta " + range(laws.zeta_hull) +
         " (" + ends(laws.zeta_ends) + "), F0 " + range(laws.F0_hull) + " " +
         core::unit_for(all.ledger.coordinate, "N") + " (" + ends(laws.F0_ends) + ").";
}

/// The interval of the answer and what is not excluded beyond it. A range over laws holds departures already.
std::optional<UnseenRange> range_of(const Estimate& best, const Ledger& ledger) {
  if (!best.interval95 || (!best.laws && !ledger.unseen)) return std::nullopt;
  UnseenRange range{.ends = *best.interval95};
  if (best.laws) return range;
  for (const ReportedParameter& parameter : reported_parameters) {
    Interval& own = range.ends.*parameter.interval;
    const Interval& other = ledger.unseen->ends.*parameter.interval;
    own = {std::min(own[0], other[0]), std::max(own[1], other[1])};
  }
  const auto name_ends = [&](Interval ParameterIntervals::* member, auto by) {
    for (std::size_t end = 0; end < 2; ++end)
      if ((range.ends.*member)[end] != ((*best.interval95).*member)[end])
        (range.*by)[end] = ((*ledger.unseen).*by)[end];
  };
  name_ends(&ParameterIntervals::zeta, &UnseenRange::zeta_by);
  name_ends(&ParameterIntervals::F0, &UnseenRange::F0_by);
  return range;
}

/// " What no test of these data excludes allows zeta from 0.018 to 0.024 (quadratic term over speed)."
std::string range_text(const Identification& all) {
  if (!all.range) return {};
  const auto ends = [](const Interval& range, const std::array<std::string, 2>& by, const std::string& unit) {
    const auto named = [](const std::string& name) { return name.empty() ? "" : " (" + name + ")"; };
    return number(range[0]) + (by[0] == by[1] ? "" : named(by[0])) + " to " + number(range[1]) + unit +
           named(by[1]);
  };
  const auto moved = [](const std::array<std::string, 2>& by) { return !by[0].empty() || !by[1].empty(); };
  std::vector<std::string> texts;
  if (moved(all.range->zeta_by)) texts.push_back("zeta from " + ends(all.range->ends.zeta, all.range->zeta_by, ""));
  if (moved(all.range->F0_by))
    texts.push_back("F0 from " +
                    ends(all.range->ends.F0, all.range->F0_by, " " + core::unit_for(all.ledger.coordinate, "N")));
  if (texts.empty()) return {};
  return " What no test of these data excludes allows " + core::joined(texts, " and ") + ".";
}

std::string verdict_of(const Identification& all) {
  std::string text = departures_text(all.ledger);
  const bool of_friction = departs_in_friction(all.ledger);
  if (!all.answer)
    return (text.empty()
                ? ""
                : text.substr(1) + (of_friction ? trend_text(all.estimates, all.ledger.coordinate) : "") + " ") +
           "No estimate is to be used: " + all.reason + "." + over_laws(all);
  const Estimate& best = all.estimates[*all.answer];
  const bool untested = all.ledger.data.empty();
  const std::string harmless = harmless_text(all.ledger);
  if (!all.ledger.departures.empty() && best.method == "joint_fit")
    if (const std::string& fitted = all.ledger.entry(Assumption::constants).fitted; !fitted.empty())
      text += " zeta and F0 are those of " + fitted + ".";
  if (all.ledger.misfit) text += " As a whole, " + misfit_text(*all.ledger.misfit) + ".";
  text =
      numbers_of(best, all.ledger.coordinate) + ", by " + best.method + no_freedom(best) + ". " +
      (!text.empty()       ? text.substr(1)
       : untested          ? "These data cannot tell whether friction is Coulomb + viscous."
       : !harmless.empty() ? "These data contradict no assumption in a way that matters; seen is: " + harmless + "."
                           : "These data do not contradict any assumption that they can test.");
  for (const Estimate& other : all.estimates)
    if (disagree(best, other))
      text += " " + other.method + " disagrees: " + numbers_of(other, all.ledger.coordinate) + ".";
  text += range_text(all);
  return text + over_laws(all);
}

}  // namespace

Identification concluded(std::vector<Estimate> estimates, Ledger ledger) {
  Identification all{.estimates = std::move(estimates), .ledger = std::move(ledger)};
  bool beside = all.estimates.size() > 1;  // a single method that was asked for answers alone, if it can
  for (Estimate& estimate : all.estimates) {
    correct(estimate);
    judge(estimate, all.ledger);
    const bool borne_out =
        !estimate.usable && !estimate.findings.empty() && rests_on_departure(estimate, all.ledger);
    beside = excluded(estimate, all.ledger.joint) || borne_out || beside;
  }
  if (beside && all.ledger.joint) {
    all.estimates.push_back(*all.ledger.joint);
    correct(all.estimates.back());
    judge(all.estimates.back(), all.ledger);
  }
  if (all.ledger.data.empty()) share_findings(all.estimates);
  std::vector<std::string> reached_by;
  for (Estimate& estimate : all.estimates)
    if (estimate.laws) reached_by = extend_to_relaxed(estimate, all.ledger);
  all.answer = preferred(all.estimates, all.ledger);
  if (all.answer) {
    keep_physical(all.estimates[*all.answer]);
    all.range = range_of(all.estimates[*all.answer], all.ledger);
  }
  all.reason = all.answer ? why_preferred(all) : why_none(all);
  const bool any = std::ranges::any_of(all.estimates, [](const Estimate& e) { return e.outcome.ok(); });
  if (any) all.verdict = verdict_of(all);
  if (!reached_by.empty())
    all.verdict += " The interval of any_law also holds the estimate with " +
                   core::joined(reached_by, " and with ") + " free, which lies outside this range.";
  return all;
}

}  // namespace dualdamp::identify
