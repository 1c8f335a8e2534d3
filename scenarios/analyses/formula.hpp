#pragma once
/// `formula`: a closed form of the theory, which depends on its arguments alone.

#include "scenarios/analyses/shared/formulas.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class FormulaQuestion final : public Question {
 public:
  /// `arguments`: complete, in range, SI.
  FormulaQuestion(const FormulaEntry& formula, Json arguments)
      : formula_(formula), arguments_(std::move(arguments)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  const FormulaEntry& formula_;
  Json arguments_;
};

[[nodiscard]] const Analysis& formula_analysis();

}  // namespace dualdamp::scenarios
