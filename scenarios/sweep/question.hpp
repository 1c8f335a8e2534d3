#pragma once
/// The question of a sweep: runs all points as a campaign and joins their results.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenarios/analysis.hpp"
#include "scenarios/sweep/points.hpp"

namespace dualdamp::scenarios {

class SweepQuestion final : public Question, public Campaign {
 public:
  /// `fields`, `main`: those of the analysis that is swept; `inputs`: digests of the other files that the points
  /// read.
  SweepQuestion(SweepPoints points, std::vector<SweptColumn> columns, std::vector<ResultField> fields,
                std::vector<std::string_view> main, std::string inputs)
      : points_(std::move(points)),
        columns_(std::move(columns)),
        fields_(std::move(fields)),
        main_(std::move(main)),
        inputs_(std::move(inputs)) {}

  /// "6 points: system.friction.kinetic (3 values), excitation.frequency (2 values)"
  [[nodiscard]] std::string size(const RunContext& context) const override;
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  [[nodiscard]] std::string line(std::size_t point, const RunOptions& options) const;
  /// False in all processes but the first.
  [[nodiscard]] bool run_with_file(const RunContext& context, std::vector<std::string>& lines,
                                   std::string& damage) const;

  SweepPoints points_;
  std::vector<SweptColumn> columns_;
  std::vector<ResultField> fields_;
  std::vector<std::string_view> main_;
  std::string inputs_;
};

}  // namespace dualdamp::scenarios
