#include "scenarios/analyses/frequency_response.hpp"

#include "scenarios/analyses/shared/curves.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

std::unique_ptr<const Question> ask_frequency_response(CheckedValues&& values) {
  return std::make_unique<FrequencyResponseQuestion>(grid_values(values.analysis.at("frequencies")),
                                                     stepping_of(values.analysis));
}

}  // namespace

Answer FrequencyResponseQuestion::run(const RunContext& context) const {
  const sim::Curve curve =
      stepping_ ? sim::stepped_frequency_response(context.model, frequencies_, *stepping_, context.steady_states())
                : sim::frequency_response(context.model, frequencies_, context.steady_states());
  return answer_of_curve(curve, context.model, {"omega", &sim::CurvePoint::omega, "rad/s"}, true, stepping_);
}

const Analysis& frequency_response_analysis() {
  static const Analysis analysis = {
      .name = "frequency_response",
      .summary = "output amplitude over frequency",
      .keys = {{frequencies(), continue_key()}},
      .needs = needs_of_steady_states({"amplitude"}),
      .results = curve_fields(
          {{"points[].omega", "rad/s", "forcing frequency"},
           {"points[].phase", "rad", "lag of x's fundamental behind the excitation; null: one has none"},
           {"points[].phase_reason", "", "for a point without phase: the reason"}}),
      .chart = {.table = "curve",
                .list = "points",
                .x = "omega",
                .y = "x",
                .x_label = "frequency",
                .y_label = "output amplitude x",
                .by = "direction",
                .is_by_x = true},
      .steady_vibrations = true,
      .verifiable = true,
      .check = check_stepping,
      .ask = ask_frequency_response,
      .length_of = number_of_points};
  return analysis;
}

}  // namespace dualdamp::scenarios
