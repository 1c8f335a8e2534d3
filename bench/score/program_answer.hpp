#pragma once
/// The program's own answer as a method of the stress test: what `dualdamp identify` would say of the record
/// without the range over laws (any_law), which takes a second or more for each record.
///
/// All quick methods that the record allows and the ledger of assumptions are run, and the estimate that the
/// program stands by is the answer (identify/ledger/answer.hpp). Where it stands by none, and `identify` would
/// answer by the range over laws, the joint model with nothing relaxed gives the values, and they are not usable. A
/// departure that the ledger finds and can relax is answered all the same, and is no rejection. The p-value is the
/// least of the ledger's: that nothing at all departs from what is assumed.

#include "identify/method.hpp"

namespace dualdamp::bench {

/// "answer"
extern const identify::MethodEntry program_answer;

}  // namespace dualdamp::bench
