#include "scenarios/format/excitations.hpp"

#include "friction_models/parameters.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/format/common_keys.hpp"
#include "sim/excitation.hpp"

namespace dualdamp::scenarios {

namespace {

/// The harmonic excitations differ in the unit of their amplitudes.
std::vector<Field> harmonic_fields(const std::string& unit) {
  const Section harmonic = {{integer("order", "multiple of the frequency").required().at_least(2).at_most(1000),
                             quantity("amplitude", {unit}, "its amplitude").required().at_least(0),
                             quantity("phase", {"rad"}, "its phase").with_fallback(0.0)}};
  return {
      quantity("amplitude", {unit}, "amplitude A of A cos(w t + phase)").at_least(0),
      quantity("frequency", {"rad/s"}, "forcing frequency w; natural: sqrt(k/m); damped: natural sqrt(1 - zeta^2)")
          .above(0)
          .or_words({"natural", "damped"})
          .with_uncertainty(),
      uncertainty_of("frequency", {"rad/s"}), quantity("phase", {"rad"}, "phase at t = 0").with_fallback(0.0),
      section_list("harmonics", harmonic, "further harmonics of a distorted drive")
          .items(1, static_cast<std::size_t>(sim::max_harmonics))};
}

std::vector<Field> noise_fields(const std::string& unit) {
  return {quantity("intensity", {unit}, "spectral density at low frequencies, two-sided").required().at_least(0),
          quantity("bandwidth", {"rad/s"}, "the signal is linear between random values at twice this rate")
              .required()
              .above(0),
          seed()};
}

Choice make_excitations() {
  std::vector<Field> force = harmonic_fields("N");
  force.push_back(quantity("offset", {"N"}, "constant force added").with_fallback(0.0));
  return {"type",
          {{"none", "no excitation: free vibration", {}},
           {"base_harmonic", "base motion y(t) = A cos(w t + phase)", {harmonic_fields("m")}, "m"},
           {"force_harmonic", "force on the mass f(t) = A cos(w t + phase) + offset", {std::move(force)}, "N"},
           {"base_ramp",
            "base moving at constant velocity, y(t) = V t",
            {{quantity("velocity", {"m/s"}, "velocity V").required()}}},
           {"force_ramp",
            "force growing at constant rate, f(t) = R t",
            {{quantity("rate", {"N/s"}, "rate R").required()}}},
           {"base_noise", "base in random motion y(t), band-limited white", {noise_fields("m^2.s")}},
           {"force_noise", "random force on the mass f(t), band-limited white", {noise_fields("N^2.s")}}}};
}

}  // namespace

const Choice& excitations() {
  static const Choice choice = make_excitations();
  return choice;
}

Choice friction_laws() {
  Choice result{"law", {}};
  for (const friction::LawEntry& law : friction::laws()) {
    result.variants.push_back({std::string(law.name), std::string(law.summary), {fields_of(law.parameters)}});
  }
  return result;
}

}  // namespace dualdamp::scenarios
