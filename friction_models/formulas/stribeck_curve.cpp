#include "friction_models/formulas/stribeck_curve.hpp"

#include "core/numbers.hpp"
#include "friction_models/formulas/static_parameter.hpp"

namespace dualdamp::friction {

namespace {

StribeckCurve::Form form_of(const ParameterValues& values) {
  if (!values.has("form")) return StribeckCurve::Form::gaussian;
  if (values.choice("form") == "exponential") return StribeckCurve::Form::exponential;
  return values.choice("form") == "lorentz" ? StribeckCurve::Form::lorentz : StribeckCurve::Form::gaussian;
}

}  // namespace

std::vector<Parameter> StribeckCurve::parameters(const Range& kinetic) {
  Parameter level_at_rest = static_parameter("friction level at rest");
  // Where it equals `kinetic` the level does not fall, and the speed over which it falls means nothing.
  level_at_rest.needed_in_fit = true;
  return {
      {.name = "kinetic", .unit = "N", .range = kinetic, .meaning = "friction level at high speed"},
      level_at_rest,
      {.name = "stribeck_velocity",
       .unit = "m/s",
       .range = positive,
       .meaning = "speed over which the level falls from static to kinetic"},
  };
}

std::vector<Parameter> StribeckCurve::shape_parameters() {
  return {
      {.name = "exponent",
       .unit = "1",
       .fallback = 2.0,
       .range = positive,
       .meaning = "exponent of r in the form gaussian"},
      {.name = "form",
       .kind = ParameterKind::choice,
       .words = {"gaussian", "exponential", "lorentz"},
       .fallback = "gaussian",
       .meaning = "how the level falls with r = speed/stribeck_velocity: exp(-r^exponent), exp(-r), 1/(1 + r^2)"},
  };
}

std::vector<ParameterFault> StribeckCurve::check_shape(const ParameterValues& values) {
  const std::string& form = values.choice("form");
  const double exponent = values.number("exponent");
  if (form == "gaussian" || exponent == 2.0) return {};
  return {{.name = "exponent",
           .message = "'exponent' belongs to the form gaussian, not to " + form,
           .allowed = "no exponent, or the form gaussian",
           .found = core::format_number(exponent)}};
}

StribeckCurve::StribeckCurve(const ParameterValues& values)
    : StribeckCurve(values.number("kinetic"), values.number("static"), values.number("stribeck_velocity"),
                    form_of(values), values.has("exponent") ? values.number("exponent") : 2.0) {}

}  // namespace dualdamp::friction
