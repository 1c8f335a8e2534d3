#pragma once
/// The answer to an identification: the estimate the program stands by, or none and what would help.
///
/// An estimate can be used when nothing that is known speaks against it: its method found no fault, and no
/// assumption that the method rests on is violated in the ledger. Where the ledger could test nothing, the method's
/// own findings decide. The joint model's own estimate answers where it can be used: it has all data, and has set
/// free what is violated. Else the one with the narrowest interval answers, the area of the intervals of c and F0;
/// the order of a list plays no part. Where none has an interval, and all agree to 2 %, the one in the middle
/// answers.

#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// What all estimates of one record and its ledger say together.
struct Identification {
  std::vector<Estimate> estimates;  ///< `usable` and `reason` as the ledger has them
  Ledger ledger;
  std::optional<std::size_t> answer;  ///< of the estimates; nothing: there is none
  std::string reason;                 ///< why this one, or why none and what would help
  std::string verdict;                ///< both in plain words
};

/// `estimates` by the methods asked for. Where these are several the joint model's own estimate is one more.
[[nodiscard]] Identification concluded(std::vector<Estimate> estimates, Ledger ledger);

}  // namespace dualdamp::identify
