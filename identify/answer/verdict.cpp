#include "identify/answer/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/answer/answer.hpp"
#include "identify/answer/preferred.hpp"
#include "identify/ledger/advice.hpp"
#include "identify/ledger/misfit.hpp"
#include "identify/methods.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

namespace {

std::string misfit_text(const Misfit& misfit) {
  return misfit_size(misfit) +
         ", and no single assumption that is given up explains them: friction, the spring and a further mode may "
         "depart together, or in a way that is not tested";
}

std::vector<std::string> names_of(const Ledger& ledger, Standing standing) {
  std::vector<std::string> names;
  for (const LedgerEntry& entry : ledger.entries)
    if (entry.standing == standing) names.emplace_back(name_of(entry.assumption));
  return names;
}

/// Why none of the estimates is used: every departure, and what would help with each.
std::string why_contradicted(const Ledger& ledger) {
  std::vector<std::string> held;
  for (const std::vector<Assumption>& departure : ledger.departures)
    held.push_back(statements_of(departure, ", or that "));
  return "the data contradict that " + core::joined(held, "; they contradict that ") +
         "; what would help: " + what_would_help(ledger);
}

/// Why the readings of a record are too few to test; nothing if a single method was asked for, which speaks for
/// itself, or beside histories, of which methods find more than the ledger.
std::string why_untested(const Identification& all) {
  if (!has_few_readings(all.ledger) || all.estimates.size() < 2 || all.ledger.entries.empty()) return {};
  return all.ledger.entries.front().reason;
}

/// What would help where the histories themselves could not be tested; empty otherwise.
std::string what_would_test(const Ledger& ledger) {
  if (!ledger.data.empty() || !ledger.recorded.histories || ledger.entries.empty()) return {};
  return "; what would help: check the constants, the units, the sensors and the drive; smaller swings, in which a spring "
         "is linear; or a record of more swings, in which the assumptions can be tested (" +
         ledger.entries.front().reason + ")";
}

/// With what to test friction over speed where an answer rests on it untested; empty otherwise.
std::string what_would_test_friction(const Ledger& ledger) {
  const LedgerEntry& entry = ledger.entry(Assumption::friction_velocity);
  if (ledger.data.empty() || entry.standing != Standing::untested) return {};
  const std::string means = means_to_show(entry.assumption, ledger.recorded);
  return means.empty() ? "" : "; what would test " + std::string(name_of(entry.assumption)) + ": " + means;
}

std::string with_interval(double value, const std::optional<ParameterIntervals>& intervals,
                          Interval ParameterIntervals::* member, const std::string& unit) {
  std::string text = four_digits(value) + unit;
  if (intervals) {
    const auto& [low, high] = (*intervals).*member;
    text += " (95 %: " + four_digits(low) + " to " + four_digits(high) + unit + ")";
  }
  return text;
}

/// ", from 4 readings that leave no freedom for an interval": as many pairs or extremes as unknowns,
/// which are fitted exactly; empty otherwise.
std::string no_freedom(const Estimate& estimate) {
  constexpr std::size_t most_unknowns = 4;  // of a method that reads pairs or extremes
  const MethodEntry* method = find_method(estimate.method);
  const std::size_t count = estimate.used.size();
  const bool reads_few = method != nullptr && method->needs != RecordKind::history && count <= most_unknowns;
  if (!reads_few || count == 0 || estimate.interval95 || estimate.laws) return {};
  return ", from " + std::to_string(count) + " readings that leave no freedom for an interval";
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

/// ", explained as well by mass free, which would hardly change zeta and F0".
std::string harmless_text_beside(const LedgerEntry& violated, const Ledger& ledger) {
  std::vector<std::string> tests;
  for (const LedgerEntry* entry : harmless_beside(violated, ledger)) tests.push_back(entry->test);
  if (tests.empty()) return {};
  return ", explained as well by " + core::joined(tests, " or ") + ", which would hardly change zeta and F0";
}

/// "These data contradict that ... (cubic stiffness, p = 0.002).", for each departure.
std::string departures_text(const Ledger& ledger) {
  std::string text;
  for (const std::vector<Assumption>& departure : ledger.departures) {
    const LedgerEntry& first = ledger.entry(departure.front());
    text += " These data contradict that " + statements_of(departure, ", or that ") + " (" +
            (first.p_value ? first.test + ", " + p_text(*first.p_value) + harmless_text_beside(first, ledger)
                           : ledger.force_excess) +
            ")";
    const std::string& wanted = ledger.entry(Assumption::constants).wanted;
    const bool of_constants = names(departure, Assumption::constants);
    text += of_constants && !wanted.empty() ? ": they fit " + wanted + "." : ".";
  }
  return text;
}

/// "zero of x free (p = 1e-20)", of departures that are seen and violate nothing: those that the stated
/// uncertainties allow, or the others. Entries with the same p are one departure.
std::string harmless_text(const Ledger& ledger, bool as_stated) {
  std::vector<std::string> texts;
  std::vector<double> seen;
  for (const LedgerEntry& entry : ledger.entries) {
    if (entry.standing != Standing::holds || entry.p_value.value_or(1.0) >= family_level ||
        entry.is_as_stated != as_stated)
      continue;
    const auto known = std::ranges::find(seen, *entry.p_value);
    if (known != seen.end()) {
      texts[static_cast<std::size_t>(known - seen.begin())].insert(0, entry.test + " or ");
      continue;
    }
    seen.push_back(*entry.p_value);
    texts.push_back(entry.test + " (" + p_text(*entry.p_value) + ")");
  }
  return core::joined(texts, "; ");
}

/// What is said where nothing is violated.
std::string standing_text(const Ledger& ledger) {
  const std::string allowed = harmless_text(ledger, true);
  const std::string small = harmless_text(ledger, false);
  if (allowed.empty() && small.empty()) return "These data do not contradict any assumption that they can test.";
  std::string text = "No assumption is violated.";
  if (!allowed.empty())
    text += " The data show a departure from the constants as stated that their stated uncertainties allow: " +
            allowed + ". joint_fit has it free.";
  if (!small.empty()) text += " The data show small departures that hardly change zeta and F0: " + small + ".";
  return text;
}

/// The ranges over all laws, and which laws end them, or why they are not to be used.
std::string over_laws(const Identification& all) {
  const auto found = std::ranges::find_if(all.estimates, [](const Estimate& e) { return e.laws != nullptr; });
  if (found == all.estimates.end()) return {};
  // Where nothing is usable, the reason of all says it.
  if (!found->usable)
    return all.answer ? " The range over laws is not to be used: " + found->reason + "." : std::string();
  const LawIntervals& laws = *found->laws;
  const auto range = [](const Interval& ends) { return four_digits(ends[0]) + " to " + four_digits(ends[1]); };
  const auto ends = [](const std::array<std::string, 2>& names) {
    return names[0] == names[1] ? "'" + names[0] + "' ends it" : "'" + names[0] + "' and '" + names[1] + "' end it";
  };
  const auto allowed = std::ranges::count_if(laws.laws, [](const LawAnswer& law) { return !law.rejected; });
  return " Over the " + std::to_string(allowed) + " laws that these data allow: zeta " + range(laws.zeta_hull) +
         " (" + ends(laws.zeta_ends) + "), F0 " + range(laws.F0_hull) + " " +
         core::unit_for(all.ledger.coordinate, "N") + " (" + ends(laws.F0_ends) + ").";
}

/// " The tests of these data do not exclude zeta from 0.018 to 0.024 (quadratic term over speed)."
std::string range_text(const Identification& all) {
  if (!all.range) return {};
  const auto ends = [](const Interval& range, const std::array<std::string, 2>& by, const std::string& unit) {
    const auto named = [](const std::string& name) { return name.empty() ? "" : " (" + name + ")"; };
    return four_digits(range[0]) + (by[0] == by[1] ? "" : named(by[0])) + " to " + four_digits(range[1]) + unit +
           named(by[1]);
  };
  const auto moved = [](const std::array<std::string, 2>& by) { return !by[0].empty() || !by[1].empty(); };
  std::vector<std::string> texts;
  if (moved(all.range->zeta_by)) texts.push_back("zeta from " + ends(all.range->ends.zeta, all.range->zeta_by, ""));
  if (moved(all.range->F0_by))
    texts.push_back("F0 from " +
                    ends(all.range->ends.F0, all.range->F0_by, " " + core::unit_for(all.ledger.coordinate, "N")));
  if (texts.empty()) return {};
  return " The tests of these data do not exclude " + core::joined(texts, " and ") + ".";
}

/// Is the answer that of the joint model with terms of friction free?
bool frees_law(const Identification& all) {
  return all.ledger.frees_law && all.estimates[*all.answer].method == "joint_fit";
}

/// Does the answer rest on an assumption that is violated? A range over laws does, where that may depart in place
/// of friction.
bool rests_on_violated(const Identification& all) {
  const MethodEntry* method = find_method(all.estimates[*all.answer].method);
  return method != nullptr && std::ranges::any_of(all.ledger.entries, [&](const LedgerEntry& entry) {
           return entry.standing == Standing::violated && method->rests_on.contains(entry.assumption);
         });
}

}  // namespace

std::string four_digits(double value) {
  constexpr int digits = 4;
  return core::format_number(value, digits);
}

std::string statements_of(const std::vector<Assumption>& list, const std::string& last) {
  std::vector<std::string> texts;
  for (const Assumption assumption : list) texts.emplace_back(statement_of(assumption));
  return core::joined(texts, last);
}

std::string why_preferred(const Identification& all) {
  const auto rivals =
      std::ranges::count_if(all.estimates, [](const Estimate& e) { return std::isfinite(area(e)); });
  const bool has_terms = frees_law(all);
  std::string text = all.ledger.data.empty() ? "no assumption could be tested in this record"
                     : has_terms ? "it has free what the data contradict, and follows every sample to the noise"
                     : rests_on_violated(all)
                         ? "its interval also holds what explains the departure as well as friction does"
                         : "none of the assumptions it rests on is violated";
  const auto usable = std::ranges::count_if(all.estimates, &Estimate::usable);
  if (rivals == 0 && usable > 1)
    text += ", and " + std::to_string(usable) +
            " methods agree; the record has no more readings than parameters, so there is no interval";
  if (rivals > 1 && all.estimates[*all.answer].method == "joint_fit")
    text += ", and it uses all data: another estimate with a narrower interval has it by chance";
  else if (rivals > 1 && has_few_readings(all.ledger) && !all.estimates[*all.answer].laws)
    text +=
        ", and of " + std::to_string(rivals) +
        " such estimates it has the widest intervals that agree: from so few readings, another estimate has narrower "
        "ones by chance";
  else if (rivals > 1)
    text += ", and of " + std::to_string(rivals) + " such estimates its intervals are the narrowest";
  const std::vector<std::string> untested = names_of(all.ledger, Standing::untested);
  if (!all.ledger.data.empty() && !untested.empty()) text += "; untested: " + core::joined(untested);
  text += what_would_test_friction(all.ledger);
  if (has_terms) text += "; what would help further: " + what_would_help(all.ledger);
  if (all.estimates[*all.answer].laws && all.ledger.violates_law())
    text += "; it is a range over laws, and what would narrow it: " + what_would_help(all.ledger);
  return text;
}

std::string why_none(const Identification& all) {
  if (!all.ledger.gross_error.empty())
    return all.ledger.gross_error +
           "; what would help: correct this reading or remove it, or 'robust', which leaves it out";
  if (!all.ledger.other_geometry.empty())
    return all.ledger.other_geometry +
           "; what would help: state x and the drive for this geometry, as docs/choosing.md says under 'Friction "
           "against a base that moves'" +
           (all.ledger.departures.empty() ? "" : "; if x is as stated, " + why_contradicted(all.ledger));
  if (all.ledger.misfit)
    return misfit_text(*all.ledger.misfit) +
           (all.ledger.departures.empty() ? "" : "; " + why_contradicted(all.ledger));
  std::string fault = fault_of_joint(all.ledger);
  if (!all.ledger.departures.empty()) return fault + (fault.empty() ? "" : "; ") + why_contradicted(all.ledger);
  if (!fault.empty()) return fault;
  const auto there = std::ranges::find_if(all.estimates, [](const Estimate& e) { return e.outcome.ok(); });
  if (there == all.estimates.end())
    return all.estimates.empty() ? "" : all.estimates.front().method + ": " + all.estimates.front().outcome.reason;
  const auto usable = std::ranges::find_if(all.estimates, &Estimate::usable);
  if (usable != all.estimates.end())
    return "the usable estimates have no intervals and do not agree; what would help: more data";
  if (has_few_readings(all.ledger))
    for (const Estimate& ranges : all.estimates)
      if (const std::string none = no_law_fits(ranges); !none.empty())
        return none + "; what would help: check mass, stiffness, frequency and units, or take more readings";
  if (std::string untested = why_untested(all); !untested.empty()) return untested;
  return there->method + ": " + there->reason + what_would_test(all.ledger);
}

std::string verdict_of(const Identification& all) {
  std::string text = all.ledger.gross_error.empty() ? departures_text(all.ledger) : "";
  if (!all.answer)
    return (text.empty() ? "" : text.substr(1) + " ") + "No estimate is to be used: " + all.reason + "." +
           over_laws(all);
  const Estimate& best = all.estimates[*all.answer];
  const bool untested = all.ledger.data.empty();
  if (frees_law(all))
    text += " zeta and F0 are those of Coulomb and viscous friction beside what joint_fit has free: " +
            core::joined(all.ledger.relaxed) + ".";
  if (!all.ledger.departures.empty() && best.method == "joint_fit")
    if (const std::string& fitted = all.ledger.entry(Assumption::constants).fitted; !fitted.empty())
      text += " zeta and F0 are those of " + fitted + ".";
  if (all.ledger.misfit) text += " As a whole, " + misfit_text(*all.ledger.misfit) + ".";
  text = numbers_of(best, all.ledger.coordinate) + ", by " + best.method + no_freedom(best) + ". " +
         (!text.empty() ? text.substr(1)
          : untested    ? "These data cannot show whether friction is Coulomb + viscous."
                        : standing_text(all.ledger));
  for (const Estimate& other : all.estimates)
    if (disagree(best, other))
      text += " " + other.method + " disagrees: " + numbers_of(other, all.ledger.coordinate) + ".";
  text += range_text(all);
  return text + over_laws(all);
}

}  // namespace dualdamp::identify
