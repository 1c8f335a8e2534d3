#include "bench/score/program_answer.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "identify/answer/answer.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods.hpp"

namespace dualdamp::bench {

namespace {

using identify::Estimate;

/// The smallest p-value of the ledger; 1 if it tested nothing.
double least_p_value(const identify::Ledger& ledger) {
  double least = 1.0;
  for (const identify::LedgerEntry& entry : ledger.entries) least = std::min(least, entry.p_value.value_or(1.0));
  return least;
}

Estimate answer(const identify::Record& record, const identify::KnownConstants& constants) {
  std::vector<Estimate> estimates;
  for (const identify::MethodEntry& method : identify::methods())
    if (!method.takes_seconds && method.lacks(record).empty()) estimates.push_back(method.run(record, constants));
  const identify::Identification found =
      identify::concluded(std::move(estimates), identify::ledger_of(record, constants));
  Estimate result;
  if (found.answer)
    result = found.estimates[*found.answer];
  else if (found.ledger.joint)
    result = *found.ledger.joint;
  else if (!found.ledger.data.empty())
    result.value = found.ledger.plain;
  else
    result.outcome = {core::OutcomeKind::not_identifiable, found.reason};
  result.method = program_answer.name;
  result.usable = found.answer.has_value();
  result.reason = found.reason;
  result.lack_of_fit = identify::LackOfFit{};
  result.lack_of_fit->test = "tests of the ledger";
  result.lack_of_fit->p_value = least_p_value(found.ledger);
  return result;
}

std::string lacks_nothing(const identify::Record& /*record*/) { return ""; }

}  // namespace

constinit const identify::MethodEntry program_answer{
    "answer",
    "the answer of the program without a range over laws: all quick methods, judged by the ledger of assumptions",
    "what the ledger finds to hold",
    "docs/verdict.md",
    "",
    identify::RecordKind::pairs,
    lacks_nothing,
    identify::call_of<answer>,
    identify::AssumptionSet::all_but()};

}  // namespace dualdamp::bench
