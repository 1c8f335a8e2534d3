#include "sim/departures.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "sim/with_law.hpp"

namespace dualdamp::sim {

namespace {

using friction::ParameterValues;

/// The truth with another friction law in place of the Coulomb friction.
Model with(const Truth& truth, std::string_view law, ParameterValues values) {
  return with_law(truth.model, law, std::move(values));
}

Model with_coulomb(const Truth& truth, ParameterValues values = {}) {
  values.set("kinetic", truth.F0);
  return with(truth, "coulomb", std::move(values));
}

/// Stiffness whose deflection under F0 is s X.
double contact_stiffness(const Truth& truth, const ReferenceMotion& reference, double s) {
  return truth.F0 / (s * reference.amplitude);
}

Model base_distortion(const Truth& truth, const ReferenceMotion& reference, double s) {
  Model model = with_coulomb(truth);
  model.excitation.harmonics = {{.order = 3, .amplitude = s * reference.Y, .phase = 0.0}};
  return model;
}

Model bouc_wen(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with(truth, "bouc_wen",
              {{"limit", truth.F0}, {"stiffness", contact_stiffness(truth, reference, s)}, {"exponent", 2.0}});
}

Model contact_compliance(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with(truth, "contact_compliance",
              {{"kinetic", truth.F0}, {"contact_stiffness", contact_stiffness(truth, reference, s)}});
}

Model cubic_spring(const Truth& truth, const ReferenceMotion& reference, double s) {
  Model model = with_coulomb(truth);
  model.oscillator.cubic_stiffness = s * model.oscillator.stiffness / (reference.amplitude * reference.amplitude);
  return model;
}

Model dahl(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with(truth, "dahl", {{"kinetic", truth.F0}, {"sigma0", contact_stiffness(truth, reference, s)}});
}

/// The test is driven at another frequency than the laboratory takes for resonance.
Model detuning(const Truth& truth, const ReferenceMotion&, double s) {
  Model model = with_coulomb(truth);
  model.excitation.frequency *= 1.0 + s;
  return model;
}

Model elasto_plastic(const Truth& truth, const ReferenceMotion& reference, double s) {
  const double stiffness = contact_stiffness(truth, reference, s);
  return with(truth, "elasto_plastic",
              {{"kinetic", truth.F0},
               {"stribeck_velocity", 0.1 * reference.speed()},
               {"sigma0", stiffness},
               {"sigma1", bristle_damping(truth.model.oscillator, stiffness)},
               {"elastic_limit", 0.5 * truth.F0 / stiffness}});
}

Model friction_lag(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with(truth, "friction_lag",
              {{"kinetic", truth.F0},
               {"static", (1.0 + s) * truth.F0},
               {"stribeck_velocity", 0.1 * reference.speed()},
               {"lag", s / reference.frequency}});
}

/// Four elements that slip at equal shares of the level, one after the other, none of them before half of the mean
/// deflection.
Model generalized_maxwell_slip(const Truth& truth, const ReferenceMotion& reference, double s) {
  const double stiffness = contact_stiffness(truth, reference, s);
  std::vector<ParameterValues> elements;
  for (const double deflection : {0.5, 0.75, 1.25, 1.5})  // over their mean
    elements.push_back({{"stiffness", 0.25 * stiffness / deflection}, {"share", 0.25}});
  return with(truth, "generalized_maxwell_slip",
              {{"elements", elements},
               {"kinetic", truth.F0},
               {"static", (1.0 + s) * truth.F0},
               {"stribeck_velocity", 0.1 * reference.speed()},
               // Slipping elements follow the level within a hundredth of a period.
               {"attraction", 100.0 * truth.F0 * reference.frequency}});
}

Model iwan(const Truth& truth, const ReferenceMotion& reference, double s) {
  // The last slider slides at a stretch of twice F0 over the stiffness.
  return with(truth, "iwan",
              {{"limit", truth.F0}, {"stiffness", 2.0 * contact_stiffness(truth, reference, s)}, {"count", 20.0}});
}

Model lugre(const Truth& truth, const ReferenceMotion& reference, double s) {
  const double stiffness = contact_stiffness(truth, reference, s);
  return with(truth, "lugre",
              {{"kinetic", truth.F0},
               {"static", (1.0 + s) * truth.F0},
               {"stribeck_velocity", 0.02 * reference.speed()},
               {"sigma0", stiffness},
               {"sigma1", bristle_damping(truth.model.oscillator, stiffness)}});
}

/// The rider's own vibration is ten times as fast as the forcing and damped to a tenth.
Model normal_vibration(const Truth& truth, const ReferenceMotion& reference, double s) {
  constexpr double mu = 0.3;
  constexpr double approach = 1e-6;
  const double weight = truth.F0 / mu;
  const double fast = 10.0 * reference.frequency;
  return with(truth, "normal_vibration",
              {{"mu", mu},
               {"weight", weight},
               {"normal_mass", 2.0 * weight / (approach * fast * fast)},
               {"static_approach", approach},
               {"normal_damping_ratio", 0.1},
               {"lift", s * weight / reference.speed()},
               {"lift_velocity", reference.speed()}});
}

Model position_slope(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with_coulomb(truth, {{"position_slope", -s * truth.F0 / reference.amplitude}});
}

Model reset_integrator(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with(truth, "reset_integrator",
              {{"kinetic", truth.F0}, {"stiffness", contact_stiffness(truth, reference, s)}, {"static_gain", s}});
}

/// Friction that varies along the way, the same at each passage.
Model rough_way(const Truth& truth, const ReferenceMotion& reference, double s) {
  const ParameterValues roughness{
      {"ratio", s / 3.0}, {"correlation_length", 0.1 * reference.amplitude}, {"seed", 1.0}};
  return with_coulomb(truth, {{"fluctuation", std::vector<ParameterValues>{roughness}}});
}

Model static_friction(const Truth& truth, const ReferenceMotion&, double s) {
  return with_coulomb(truth, {{"static", (1.0 + s) * truth.F0}});
}

Model stribeck(const Truth& truth, const ReferenceMotion& reference, double s) {
  return with(
      truth, "stribeck",
      {{"kinetic", truth.F0}, {"static", (1.0 + s) * truth.F0}, {"stribeck_velocity", 0.1 * reference.speed()}});
}

/// Viscous friction by another law in place of the damper.
Model without_damper(Model model, const Truth& truth, std::string_view law, ParameterValues values) {
  model.oscillator.damping = 0.0;
  Truth undamped = truth;
  undamped.model = std::move(model);
  return with(undamped, law, std::move(values));
}

Model viscous_power(const Truth& truth, const ReferenceMotion& reference, double s) {
  return without_damper(with_coulomb(truth), truth, "viscous_power",
                        {{"coefficient", truth.c() * reference.speed()},
                         {"reference_velocity", reference.speed()},
                         {"exponent", 1.0 + s}});
}

Model viscous_saturating(const Truth& truth, const ReferenceMotion& reference, double s) {
  return without_damper(with_coulomb(truth), truth, "viscous_saturating",
                        {{"coefficient", truth.c()}, {"saturation_velocity", reference.speed() / s}});
}

/// Friction falls as it warms the contact, which takes five periods to warm.
Model warming(const Truth& truth, const ReferenceMotion& reference, double s) {
  const double period = 2.0 * std::numbers::pi / reference.frequency;
  const double mean_power = 4.0 * truth.F0 * reference.amplitude / period;
  const ParameterValues heat{{"power", mean_power / s}, {"time_constant", 5.0 * period}};
  return with_coulomb(truth, {{"warming", std::vector<ParameterValues>{heat}}});
}

}  // namespace

const std::vector<Departure>& departures() {
  static const std::vector<Departure> list = {
      {"base_distortion", "third harmonic of the base over its fundamental in the middle of the range", 1.0,
       base_distortion},
      {"bouc_wen", "yield deflection F0/stiffness over the amplitude X", 1.0, bouc_wen},
      {"contact_compliance", "deflection of the contact F0/K over the amplitude X", 1.0, contact_compliance},
      {"cubic_spring", "hardening k3 X^2 over the stiffness k", 10.0, cubic_spring},
      {"dahl", "deflection of the bristles F0/sigma0 over the amplitude X", 1.0, dahl},
      {"detuning", "forcing frequency over the stated one, less 1", 1.0, detuning},
      {"elasto_plastic", "deflection of the bristles F0/sigma0 over the amplitude X", 1.0, elasto_plastic},
      {"friction_lag",
       "lag times forcing frequency, and excess of friction at rest over F0, falling over 0.1 of the peak speed",
       10.0, friction_lag},
      {"generalized_maxwell_slip",
       "mean deflection of the elements over the amplitude X, and excess of static friction over F0", 1.0,
       generalized_maxwell_slip},
      {"iwan", "mean deflection of the sliders over the amplitude X", 1.0, iwan},
      {"lugre", "deflection of the bristles F0/sigma0 over the amplitude X, and excess of static friction over F0",
       1.0, lugre},
      {"normal_vibration", "lift at high speed over the weight; half of it at the peak speed", 1.0,
       normal_vibration},
      {"position_slope", "fall of the friction force at the amplitude X, over F0", 1.0, position_slope},
      {"reset_integrator",
       "stretch F0/stiffness at which the bond breaks over the amplitude X, and its static gain", 1.0,
       reset_integrator},
      {"rough_way", "three standard deviations of the friction force along the way over F0, correlated over 0.1 X",
       1.0, rough_way},
      {"static_friction", "excess of static over kinetic friction, over F0", 10.0, static_friction},
      {"stribeck", "excess of friction at rest over F0, falling over 0.1 of the peak speed", 10.0, stribeck},
      {"viscous_power", "exponent of the speed, less 1", 10.0, viscous_power},
      {"viscous_saturating", "peak speed over the saturation velocity", 100.0, viscous_saturating},
      {"warming", "mean power of Coulomb friction over the power at which it falls to 1/e", 10.0, warming},
  };
  return list;
}

const Departure* find_departure(std::string_view name) {
  const auto& list = departures();
  const auto found = std::ranges::find(list, name, &Departure::name);
  return found == list.end() ? nullptr : &*found;
}

Model undisturbed(const Truth& truth) { return with_coulomb(truth); }

}  // namespace dualdamp::sim
