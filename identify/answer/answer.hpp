#pragma once
/// The answer of an identification: the estimate that the program stands by, or none, and what would help.
///
/// An estimate is usable if its method found no fault, no assumption that the method rests on is violated in the
/// ledger, and the joint model does not exclude it. If the ledger could test nothing, the methods' own findings
/// decide: a departure from the law that one method finds counts against all that rest on it. What a method finds
/// in histories stands if the ledger could test something else alone. The estimate of the joint model answers if it
/// is usable: it has all data, and what is violated is relaxed in it. Otherwise the estimate with the smallest area
/// of the intervals of c and F0 answers; the order of a list plays no part. If none has an interval and all agree
/// to 2 %, the one in the middle answers. A range over laws that answers beside a departure of friction is extended
/// to the 95 % intervals of the estimates with this departure, and with what explains it as well, relaxed.

#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// All estimates of one record, its ledger, and the answer that follows from them.
struct Identification {
  std::vector<Estimate> estimates;  ///< `usable` and `reason` as the ledger sets them
  Ledger ledger;
  std::optional<std::size_t> answer;  ///< place among the estimates; nothing: no answer
  /// Of the answer: its interval, extended by what departures that no test sees may make of it. Nothing without an
  /// interval, and where nothing could be tested.
  std::optional<UnseenRange> range;
  std::string reason;   ///< why this one, or why none and what would help
  std::string verdict;  ///< the answer and what the data contradict, in sentences
};

/// `estimates`: of the methods asked for. If these are several, or the joint model excludes one, the estimate of
/// the joint model is added.
[[nodiscard]] Identification concluded(std::vector<Estimate> estimates, Ledger ledger);

}  // namespace dualdamp::identify
