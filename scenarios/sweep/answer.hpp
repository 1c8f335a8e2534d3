#pragma once
/// The answer of a sweep, from its finished points.
///
/// Tables: `sweep`, one row a point, has the swept values in the units the user wrote, the status and the single
/// numbers of the result, those first by which the analysis is drawn; `sweep_LIST` has the rows of the lists LIST
/// of all points below each other, each with the number of its point and its swept values.

#include <string>
#include <vector>

#include "scenarios/format/result_field.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::scenarios {

/// A swept key in results.
struct SweptColumn {
  std::string path;
  std::string unit;             ///< as the user wrote it
  std::vector<double> numbers;  ///< of each point, in that unit
  std::vector<double> si;       ///< of each point
};

/// Point number `number` as a line of the file of finished points.
[[nodiscard]] std::string line_of(std::size_t number, const std::vector<SweptColumn>& keys, const RunResult& run);

/// `lines`: those of all points, in order. `fields`: fields of the result of a point, with the units of the
/// coordinate. `main`: the fields that are drawn.
[[nodiscard]] Answer answer_of_sweep(const std::vector<std::string>& lines, const std::vector<SweptColumn>& keys,
                                     const std::vector<ResultField>& fields,
                                     const std::vector<std::string_view>& main);

/// The fields of the result of a sweep, from those of a point.
[[nodiscard]] std::vector<ResultField> fields_of_sweep(const std::vector<ResultField>& fields);

/// "system.mass = 2 kg, excitation.frequency = 5 Hz"
[[nodiscard]] std::string describe_point(const std::vector<SweptColumn>& keys, std::size_t number);

}  // namespace dualdamp::scenarios
