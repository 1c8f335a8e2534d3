#include "scenarios/analyses/xy_curve.hpp"

#include "scenarios/analyses/shared/curves.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

std::unique_ptr<const Question> ask_xy_curve(CheckedValues&& values) {
  return std::make_unique<XyCurveQuestion>(grid_values(values.analysis.at("amplitudes")),
                                           stepping_of(values.analysis));
}

}  // namespace

Answer XyCurveQuestion::run(const RunContext& context) const {
  const sim::Curve curve =
      stepping_ ? sim::stepped_xy_curve(context.model, amplitudes_, *stepping_, context.steady_states())
                : sim::xy_curve(context.model, amplitudes_, context.steady_states());
  return answer_of_curve(curve, context.model, {"Y", &sim::CurvePoint::Y, amplitude_unit(context.model.excitation)},
                         false, stepping_);
}

const Analysis& xy_curve_analysis() {
  static const Analysis analysis = {
      .name = "xy_curve",
      .summary = "output amplitude over input amplitude",
      .keys = {{amplitudes(), continue_key()}},
      .needs = needs_of_steady_states({"frequency"}),
      .results = curve_fields({{"points[].Y", unit_of_drive, "excitation amplitude"}}),
      .chart = {.table = "curve",
                .list = "points",
                .x = "Y",
                .y = "x",
                .x_label = "input amplitude Y",
                .y_label = "output amplitude x",
                .by = "direction",
                .is_by_x = true},
      .steady_vibrations = true,
      .verifiable = true,
      .check = check_stepping,
      .ask = ask_xy_curve,
      .length_of = number_of_points};
  return analysis;
}

}  // namespace dualdamp::scenarios
