#include "scenarios/analyses/formula.hpp"

#include <algorithm>

namespace dualdamp::scenarios {

namespace {

Section formula_keys() {
  Choice forms{"name", {}};
  for (const FormulaEntry& entry : formulas())
    forms.variants.push_back({.name = std::string(entry.name),
                              .summary = std::string(entry.summary),
                              .section = entry.arguments,
                              .equation = std::string(entry.equation),
                              .results = entry.results});
  Field formula = choice("formula", std::move(forms), "the formula and its arguments");
  return {{std::move(formula).required()}};
}

std::unique_ptr<const Question> ask_formula(CheckedValues&& values) {
  const Json& formula = values.analysis.at("formula");
  return std::make_unique<FormulaQuestion>(*find_formula(formula.at("name").get<std::string>()), formula);
}

}  // namespace

Answer FormulaQuestion::run(const RunContext& /*context*/) const {
  Answer answer;
  answer.result = formula_.evaluate(arguments_);
  if (std::ranges::all_of(answer.result, [](const Json& value) { return value.is_null(); }))
    return failed("the formula has no value for these arguments");
  return answer;
}

const Analysis& formula_analysis() {
  static const Analysis analysis = {.name = "formula",
                                    .summary = "a closed form of the paper",
                                    .keys = formula_keys(),
                                    .needs = {{"", {}, {}, false, ""}},
                                    .results = {},  // those of the chosen form
                                    .ask = ask_formula};
  return analysis;
}

}  // namespace dualdamp::scenarios
