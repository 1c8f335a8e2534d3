#pragma once
/// The program's own answer as a method of the stress test: what `dualdamp identify` would say of the record
/// without the range over laws (any_law), which takes a second or more for each record.
///
/// Runs all quick methods that the record allows and the ledger of assumptions. The answer is the estimate that the
/// program stands by (identify/answer/answer.hpp). If there is none, so that `identify` would continue with the
/// range over laws, the values are those of the joint model without relaxation, and they are not usable. A
/// departure that the ledger finds and can relax has an answer, so it is no rejection. The p-value is the smallest
/// p-value of the ledger.

#include "identify/method.hpp"

namespace dualdamp::bench {

/// "answer"
extern const identify::MethodEntry program_answer;

}  // namespace dualdamp::bench
