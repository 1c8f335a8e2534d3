#pragma once
/// The finding of one comparison of one case.

#include <string>
#include <vector>

namespace dualdamp::crosscheck {

enum class Verdict {
  agreed,
  not_compared,  ///< nothing to compare, or too long
  refused,       ///< the program gives a reason why it has no answer
  exception,     ///< a difference, or an incomplete comparison, with a named mathematical reason
  disagree,
};

struct Finding {
  std::string comparison;  ///< "exact against smooth"
  Verdict verdict = Verdict::agreed;
  double worst = 0.0;  ///< relative difference
  std::string text;    ///< reason of a refusal, name of an exception, what disagrees
};

using Findings = std::vector<Finding>;

}  // namespace dualdamp::crosscheck
