#pragma once
/// The scores of a stress test as a result: ranking, families, cells, differences and consequences.

#include <vector>

#include "bench/score/scores.hpp"
#include "scenarios/format/result_field.hpp"
#include "scenarios/results/answer.hpp"

namespace dualdamp::bench {

[[nodiscard]] scenarios::Answer answer_of(const MarkedCases& cases, const Grid& grid);

/// The fields of such a result.
[[nodiscard]] std::vector<scenarios::ResultField> score_fields();

}  // namespace dualdamp::bench
