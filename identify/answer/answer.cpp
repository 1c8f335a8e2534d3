#include "identify/answer/answer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/diagnostics.hpp"
#include "identify/answer/preferred.hpp"
#include "identify/answer/verdict.hpp"
#include "identify/ledger/misfit.hpp"
#include "identify/methods.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

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

bool reads_histories(const Estimate& estimate) {
  const MethodEntry* method = find_method(estimate.method);
  return estimate.is_of_histories || (method != nullptr && method->needs == RecordKind::history);
}

/// Of the methods that read histories, none has the zero of x of each free: at most what it is beyond their mean.
bool takes_one_zero(const Estimate& estimate) {
  const MethodEntry* method = find_method(estimate.method);
  return method != nullptr && method->needs == RecordKind::history;
}

/// What a method found stands where the ledger did not clear it: a ledger that tested something else than the
/// histories cannot speak against what a method found in them, and one that saw a departure bears it out.
bool keeps_its_findings(const Estimate& estimate, const Ledger& ledger) {
  if (find_method(estimate.method) == nullptr || estimate.findings.empty()) return false;
  return (reads_histories(estimate) && !ledger.tests_histories) || rests_on_departure(estimate, ledger);
}

void withdraw(Estimate& estimate, std::string why) {
  estimate.usable = false;
  estimate.reason = std::move(why);
}

/// Why the numbers of an estimate do not describe the record; empty if they may. A range over laws of which none
/// fits does not, nor does any other estimate where the joint model misses the record, nor one that the motion
/// itself excludes.
std::string why_it_misses(const Estimate& estimate, const Ledger& ledger) {
  if (!estimate.sound) return "";
  if (!ledger.gross_error.empty()) return ledger.gross_error;
  if (!ledger.other_geometry.empty()) return ledger.other_geometry;
  if (std::string none = no_law_fits(estimate); !none.empty()) return none;
  if (!ledger.force_excess.empty()) return ledger.force_excess;
  if (!ledger.missed_motion.empty() && reads_histories(estimate)) return ledger.missed_motion;
  if (!ledger.unlike_zeros.empty() && takes_one_zero(estimate))
    return ledger.unlike_zeros + ", and the method takes one for all, or takes their mean for zero";
  if (ledger.misfit && !estimate.laws) return misfit_size(*ledger.misfit);
  if (std::string fault = fault_of_joint(ledger); !fault.empty() && !estimate.laws) return fault;
  const std::string beyond = beyond_motion(estimate, ledger.largest, ledger.coordinate);
  return beyond.empty() ? "" : "its " + beyond;
}

/// Is it friction over speed or displacement that departs, or what may depart in its place: a drift that follows
/// the speed, or what is named only beside friction, which explains the same departure?
bool stands_for_friction(const LedgerEntry& entry, const Ledger& ledger) {
  if (entry.is_like_speed) return true;
  bool found = false;
  for (const std::vector<Assumption>& departure : ledger.departures) {
    if (!names(departure, entry.assumption)) continue;
    if (std::ranges::none_of(departure, is_of_law)) return false;
    found = true;
  }
  return found;
}

void judge(Estimate& estimate, const Ledger& ledger) {
  if (!estimate.outcome.ok()) return;
  if (std::string why = why_it_misses(estimate, ledger); !why.empty()) return withdraw(estimate, std::move(why));
  if (ledger.data.empty() || !estimate.sound) return;
  std::vector<Assumption> violated;
  for (const LedgerEntry& entry : ledger.entries) {
    // A range over laws is extended to the fit with what explains the departure as well as friction does.
    const bool is_held = estimate.laws && stands_for_friction(entry, ledger);
    if (entry.standing == Standing::violated && !is_held && rests_on(estimate).contains(entry.assumption))
      violated.push_back(entry.assumption);
  }
  const bool contradicted = !estimate.usable;
  const bool clears = !keeps_its_findings(estimate, ledger);
  estimate.usable = violated.empty() && (clears || !contradicted);
  if (!violated.empty())
    estimate.reason = "the data contradict that " + statements_of(violated, " or that ");
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
  const auto to_middle = [always](double& value, const Interval& interval) {
    if (always || value < interval[0] || value > interval[1]) value = 0.5 * (interval[0] + interval[1]);
  };
  for (const ReportedParameter& parameter : reported_parameters)
    to_middle(estimate.value.*parameter.value, (*estimate.interval95).*parameter.interval);
  for (FurtherParameter& other : estimate.others)
    if (other.interval95) to_middle(other.value, *other.interval95);
}

/// An answer is not negative, nor does its interval reach below zero, the nearest value that friction can have.
void keep_physical(Estimate& estimate) {
  for (const ReportedParameter& parameter : reported_parameters) {
    double& value = estimate.value.*parameter.value;
    if (value < 0.0 && (parameter.name == "zeta" || parameter.name == "F0"))
      estimate.warnings.push_back(
          std::string(parameter.name) + " is fitted best by a negative value (" + four_digits(value) +
          " in SI units), and is reported as zero: the data cannot distinguish it from zero");
    value = value < 0.0 ? 0.0 : value;
    if (!estimate.interval95) continue;
    for (double& end : (*estimate.interval95).*parameter.interval) end = end < 0.0 ? 0.0 : end;
  }
}

/// The departures of friction that the ledger can relax, and what may depart in their place: a range over laws
/// answers for them. Its library has wrong constants and a spring that is not linear among the laws.
std::vector<const LedgerEntry*> held_departures(const Estimate& ranges, const Ledger& ledger) {
  std::vector<const LedgerEntry*> found;
  for (const LedgerEntry& entry : ledger.entries) {
    const bool is_in_library = !is_of_law(entry.assumption) && !rests_on(ranges).contains(entry.assumption);
    if (entry.standing == Standing::violated && entry.zeta_change && entry.F0_change && !is_in_library &&
        stands_for_friction(entry, ledger))
      found.push_back(&entry);
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
/// tests of these relaxations, each with "free".
std::vector<std::string> extend_to_relaxed(Estimate& estimate, const Ledger& ledger) {
  std::vector<std::string> tests;
  if (!estimate.usable || !estimate.laws || !estimate.interval95) return tests;
  for (const LedgerEntry* entry : held_departures(estimate, ledger)) {
    ParameterIntervals& at = *estimate.interval95;
    const ParameterIntervals before = at;
    at.zeta = reached(at.zeta, ledger.plain.zeta, *entry->zeta_change, *entry->p_value);
    at.c = reached(at.c, ledger.plain.c, *entry->zeta_change, *entry->p_value);
    at.x_f = reached(at.x_f, ledger.plain.x_f, *entry->F0_change, *entry->p_value);
    at.F0 = reached(at.F0, ledger.plain.F0, *entry->F0_change, *entry->p_value);
    if (at.zeta != before.zeta || at.F0 != before.F0)
      tests.push_back(entry->test + (entry->test.ends_with(" free") ? "" : " free"));
  }
  return tests;
}

/// Why an estimate cannot be used beside that of the joint model, which has all of the same data and no known
/// departure; empty if both agree. Ranges over laws are wider than the joint model on purpose, and are never
/// excluded.
std::string why_excluded(const Estimate& estimate, const std::optional<Estimate>& joint) {
  if (!joint || !joint->usable || estimate.laws || !disagree(*joint, estimate)) return "";
  return "joint_fit, which has all data, excludes it: zeta = " + four_digits(joint->value.zeta) +
         ", F0 = " + four_digits(joint->value.F0);
}

/// Did the method find against the law of friction? A method that claims no interval says so among its findings,
/// and says nothing about the law. Nor does one with a fault of its own, or one that finds as much in motions of
/// its law.
bool finds_departure(const Estimate& estimate) {
  if (!estimate.outcome.ok() || estimate.laws || !estimate.sound || estimate.misreads_its_law) return false;
  return (estimate.lack_of_fit && estimate.lack_of_fit->fired) ||
         (estimate.interval95 && !estimate.findings.empty());
}

/// Readings that no law of the library fits are not those of Coulomb and viscous friction, which is one of them.
void share_misfit_of_laws(std::vector<Estimate>& estimates) {
  for (const Estimate& ranges : estimates) {
    const std::string none = no_law_fits(ranges);
    if (none.empty()) continue;
    for (Estimate& estimate : estimates) {
      if (estimate.usable && !estimate.laws) withdraw(estimate, none);
    }
  }
}

/// Where the ledger tested nothing, what one method finds against the law counts against all that rest on it.
void share_findings(std::vector<Estimate>& estimates) {
  const auto finder = std::ranges::find_if(estimates, finds_departure);
  if (finder == estimates.end() || finder->findings.empty()) return;
  const std::string reason =
      finder->method + " finds a departure from the law that both rest on: " + finder->findings.front();
  for (Estimate& estimate : estimates) {
    if (estimate.usable && !estimate.laws) withdraw(estimate, reason);
  }
}

/// The interval of the answer, which is not below zero, and what is not excluded beyond it. A range over laws holds
/// departures already.
std::optional<UnseenRange> range_of(const Estimate& best, const Ledger& ledger) {
  if (!best.interval95 || (!best.laws && !ledger.unseen)) return std::nullopt;
  UnseenRange range{.ends = *best.interval95};
  if (best.laws) return range;
  for (const ReportedParameter& parameter : reported_parameters) {
    Interval& own = range.ends.*parameter.interval;
    const Interval& other = ledger.unseen->ends.*parameter.interval;
    own = {std::min(own[0], std::max(0.0, other[0])), std::max(own[1], other[1])};
  }
  const auto name_ends = [&](Interval ParameterIntervals::* member, auto by) {
    for (std::size_t end = 0; end < 2; ++end)
      if (!is_tie((range.ends.*member)[end], ((*best.interval95).*member)[end]))
        (range.*by)[end] = ((*ledger.unseen).*by)[end];
  };
  name_ends(&ParameterIntervals::zeta, &UnseenRange::zeta_by);
  name_ends(&ParameterIntervals::F0, &UnseenRange::F0_by);
  return range;
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
    const std::string why = why_excluded(estimate, all.ledger.joint);
    if (!why.empty()) withdraw(estimate, why);
    beside = beside || borne_out || !why.empty();
  }
  if (beside && all.ledger.joint) {
    all.estimates.push_back(*all.ledger.joint);
    correct(all.estimates.back());
    judge(all.estimates.back(), all.ledger);
  }
  if (all.ledger.data.empty()) share_findings(all.estimates);
  if (has_few_readings(all.ledger)) share_misfit_of_laws(all.estimates);
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
    all.verdict += std::string(" The interval of any_law also holds the ") +
                   (reached_by.size() > 1 ? "estimates" : "estimate") + " with " +
                   core::joined(reached_by, " and with ") + ", which " + (reached_by.size() > 1 ? "lie" : "lies") +
                   " outside this range.";
  return all;
}

}  // namespace dualdamp::identify
