#pragma once
/// What one comparison of one case found.

#include <string>
#include <vector>

namespace dualdamp::crosscheck {

enum class Verdict {
  agreed,
  not_compared,  ///< nothing to compare, or too long
  refused,       ///< the program says why it has no answer
  exception,     ///< they differ, or could not be compared throughout, for a named mathematical reason
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
