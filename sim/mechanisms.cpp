#include "sim/mechanisms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/with_law.hpp"

namespace dualdamp::sim {

namespace {

using friction::ParameterValues;
using Values = std::span<const double>;

constexpr friction::Range positive = {.low = 0.0, .low_open = true};

/// The driven oscillator with a damper c, without friction laws.
Model driven(const Rig& rig, double c, double Y) {
  Model model;
  model.oscillator = rig.oscillator;
  model.oscillator.damping = c;
  model.excitation = {.type = ExcitationType::base_harmonic, .amplitude = Y, .frequency = rig.reference.frequency};
  return model;
}

Model with_coulomb(Model model, double F0) { return with_law(std::move(model), "coulomb", {{"kinetic", F0}}); }

Model coulomb_viscous(const Rig& rig, const RigFriction& friction, Values, double Y) {
  return with_coulomb(driven(rig, friction.c, Y), friction.F0);
}

/// Coulomb friction and another law in place of the damper.
Model with_film(const Rig& rig, double F0, double Y, std::string_view law, ParameterValues values) {
  return with_law(with_coulomb(driven(rig, 0.0, Y), F0), law, std::move(values));
}

/// Fourier coefficients of tanh(a cos t)/tanh(a) of order 1, 3, 5, ... They fall by exp(-2 asinh(pi/2a)) from one
/// to the next, and the trapezoidal rule errs by those of order 2 * points and above.
std::array<double, 8> clipped_cosine(double a) {
  constexpr int points = 256;
  std::array<double, 8> coefficients{};
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    const double y = std::tanh(a * std::cos(angle)) / std::tanh(a);
    for (std::size_t j = 0; j < coefficients.size(); ++j)
      coefficients[j] += 2.0 / points * y * std::cos(static_cast<double>(2 * j + 1) * angle);
  }
  return coefficients;
}

Model base_clipping(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  Model model = coulomb_viscous(rig, friction, {}, Y);
  const std::array<double, 8> shares = clipped_cosine(Y / p[0]);
  model.excitation.amplitude = shares[0] * Y;
  for (std::size_t j = 1; j < shares.size(); ++j) {
    const double share = shares[j];
    // A phase takes the sign that an amplitude must not have.
    model.excitation.harmonics.push_back({.order = static_cast<int>(2 * j + 1),
                                          .amplitude = std::abs(share) * Y,
                                          .phase = share < 0.0 ? std::numbers::pi : 0.0});
  }
  return model;
}

Model contact_compliance(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(driven(rig, friction.c, Y), "contact_compliance",
                  {{"kinetic", friction.F0}, {"contact_stiffness", p[0]}});
}

Model dahl(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(driven(rig, friction.c, Y), "dahl", {{"kinetic", friction.F0}, {"sigma0", p[0]}});
}

Model detuning(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  Model model = coulomb_viscous(rig, friction, {}, Y);
  model.excitation.frequency *= 1.0 + p[0];
  return model;
}

Model friction_lag(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(driven(rig, friction.c, Y), "friction_lag",
                  {{"kinetic", friction.F0},
                   {"static", (1.0 + p[0]) * friction.F0},
                   {"stribeck_velocity", p[1]},
                   {"lag", p[2]}});
}

Model hardening_spring(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  Model model = coulomb_viscous(rig, friction, {}, Y);
  model.oscillator.cubic_stiffness = p[0];
  return model;
}

Model hardening_spring_detuned(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  Model model = hardening_spring(rig, friction, p, Y);
  model.excitation.frequency *= 1.0 + p[1];
  return model;
}

/// Speed over which friction falls from its value at rest where a film of oil begins to carry [m/s].
constexpr double boundary_lubrication = 0.01;

Model lugre(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(driven(rig, friction.c, Y), "lugre",
                  {{"kinetic", friction.F0},
                   {"static", (1.0 + p[1]) * friction.F0},
                   {"stribeck_velocity", boundary_lubrication},
                   {"sigma0", p[0]},
                   {"sigma1", bristle_damping(rig.oscillator, p[0])}});
}

Model position_dependence(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(driven(rig, friction.c, Y), "coulomb",
                  {{"kinetic", friction.F0}, {"position_slope", -friction.F0 / p[0]}});
}

Model quadratic_drag(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(coulomb_viscous(rig, friction, {}, Y), "viscous_power",
                  {{"coefficient", p[0]}, {"exponent", 2.0}});
}

Model rigid_and_compliant(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(with_coulomb(driven(rig, friction.c, Y), (1.0 - p[1]) * friction.F0), "contact_compliance",
                  {{"kinetic", p[1] * friction.F0}, {"contact_stiffness", p[0]}});
}

Model softening_spring(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  Model model = coulomb_viscous(rig, friction, {}, Y);
  model.oscillator.cubic_stiffness = -p[0];
  return model;
}

Model stribeck(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_law(driven(rig, friction.c, Y), "stribeck",
                  {{"kinetic", friction.F0}, {"static", (1.0 + p[0]) * friction.F0}, {"stribeck_velocity", p[1]}});
}

Model viscous_power(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  const double V = rig.reference.speed();
  return with_film(rig, friction.F0, Y, "viscous_power",
                   {{"coefficient", friction.c * V}, {"reference_velocity", V}, {"exponent", p[0]}});
}

Model viscous_saturating(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  return with_film(
      rig, friction.F0, Y, "viscous_saturating",
      {{"coefficient", friction.c * (1.0 + rig.reference.speed() / p[0])}, {"saturation_velocity", p[0]}});
}

std::vector<ParameterValues> warming(const Rig& rig, double power) {
  return {ParameterValues{{"power", power}, {"time_constant", rig.warming_time}}};
}

/// Friction of F0 warms by 4 F0 X each period.
Model warming_contact(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  const double heat = 2.0 / std::numbers::pi * friction.F0 * rig.reference.speed();
  return with_law(driven(rig, friction.c, Y), "coulomb",
                  {{"kinetic", friction.F0 * std::exp(heat / p[0])}, {"warming", warming(rig, p[0])}});
}

/// A damper warms by c V^2/2 in the mean.
Model warming_film(const Rig& rig, const RigFriction& friction, Values p, double Y) {
  const double heat = 0.5 * friction.c * rig.reference.speed() * rig.reference.speed();
  return with_film(
      rig, friction.F0, Y, "viscous_power",
      {{"coefficient", friction.c * std::exp(heat / p[0])}, {"exponent", 1.0}, {"warming", warming(rig, p[0])}});
}

std::vector<Mechanism> table() {
  const MechanismParameter contact = {.name = "contact_stiffness",
                                      .unit = "N/m",
                                      .meaning = "of the contact in series with its slider",
                                      .range = positive,
                                      .start = 1.0,
                                      .low = 0.05,
                                      .high = 300.0};
  const MechanismParameter bristles = {.name = "sigma0",
                                       .unit = "N/m",
                                       .meaning = "stiffness of the bristles",
                                       .range = positive,
                                       .start = 1.0,
                                       .low = 0.05,
                                       .high = 100.0};
  const MechanismParameter excess = {.name = "excess",
                                     .unit = "1",
                                     .meaning = "of friction at rest over F0, over F0",
                                     .range = {.low = 0.0},
                                     .start = 0.3,
                                     .low = 1e-4,
                                     .high = 3.0};
  const MechanismParameter fall = {.name = "stribeck_velocity",
                                   .unit = "m/s",
                                   .meaning = "speed over which the excess falls",
                                   .range = positive,
                                   .start = 0.3,
                                   .low = 0.01,
                                   .high = 5.0};
  const MechanismParameter cubic = {.name = "cubic_stiffness",
                                    .unit = "N/m^3",
                                    .meaning = "k3 of the spring, as a positive number",
                                    .range = positive,
                                    .start = 0.05,
                                    .low = 1e-4,
                                    .high = 0.5};
  const MechanismParameter power = {.name = "power",
                                    .unit = "W",
                                    .meaning = "power turned to heat at which the force has fallen to 1/e",
                                    .range = positive,
                                    .start = 6.0,
                                    .low = 0.1,
                                    .high = 1e3};
  const MechanismParameter offset = {.name = "offset",
                                     .unit = "1",
                                     .meaning = "forcing frequency over the stated one, less 1",
                                     .range = {.low = -0.5, .high = 1.0},
                                     .start = 0.02,
                                     .low = -0.15,
                                     .high = 0.15};
  return {
      {.name = "base_clipping",
       .meaning =
           "the exciter nears the end of its stroke: y = Y tanh(a cos wt)/tanh(a), a = Y/stroke, read by its "
           "peak",
       .parameters = {{.name = "stroke",
                       .unit = "m",
                       .meaning = "amplitude at which the base's motion begins to flatten",
                       .range = positive,
                       .start = 0.6,
                       .low = 0.1,
                       .high = 100.0}},
       .plausible = {{"", {10e-3}, "an exciter whose third harmonic is 3 % near the end of its stroke"}},
       .forced_only = true,
       .build = base_clipping},
      {.name = "contact_compliance",
       .meaning = "the contact gives way before it slides: a spring in series with Coulomb friction",
       .parameters = {contact},
       .plausible = {{"", {11.6e4}, "measured on the paper's rig, liang2004identifying"}},
       .build = contact_compliance},
      {.name = "coulomb_viscous",
       .meaning = "nothing: what the method assumes",
       .parameters = {},
       .plausible = {{"", {}, "what the method's own neglect of H bends"}},
       .build = coulomb_viscous},
      {.name = "dahl",
       .meaning = "bristles that give way gradually, whatever the speed",
       .parameters = {bristles},
       .plausible = {{"", {11.6e4}, "the measured contact stiffness, liang2004identifying"}},
       .build = dahl},
      {.name = "detuning",
       .meaning = "the drive is not at the resonance that the method takes it to be at",
       .parameters = {offset},
       .plausible = {{"above", {0.02}, "mass and spring known to 2 % each"},
                     {"below", {-0.02}, "mass and spring known to 2 % each"}},
       .forced_only = true,
       .build = detuning},
      {.name = "friction_lag",
       .meaning = "friction falls with speed, and follows the speed late",
       .parameters = {excess,
                      fall,
                      {.name = "lag",
                       .unit = "s",
                       .meaning = "time by which it is late",
                       .range = positive,
                       .start = 0.1,
                       .low = 0.003,
                       .high = 2.0}},
       .plausible = {{"2 ms", {0.3, 0.2, 2e-3}, "lags of some milliseconds, hess1990"},
                     {"5 ms", {0.3, 0.2, 5e-3}, "lags of some milliseconds, hess1990"}},
       .build = friction_lag},
      {.name = "hardening_spring",
       .meaning = "the spring stiffens with its elongation",
       .parameters = {cubic},
       .plausible = {{"6 %", {1e6}, "6 % stiffer at 10 mm"}, {"19 %", {3e6}, "19 % stiffer at 10 mm"}},
       .forced_only = true,
       .build = hardening_spring},
      {.name = "hardening_spring_detuned",
       .meaning = "the spring stiffens, and the drive is set to the resonance of large amplitudes",
       .parameters = {cubic, offset},
       .plausible = {{"",
                      {8.3e5, 0.1},
                      "5 % stiffer at 10 mm, driven 10 % above the resonance of small amplitudes"}},
       .forced_only = true,
       .build = hardening_spring_detuned},
      {.name = "lugre",
       .meaning = "bristles that bend, with a friction that falls over the first 10 mm/s",
       .parameters = {bristles, excess},
       .plausible = {{"no excess", {11.6e4, 0.0}, "the measured contact stiffness, liang2004identifying"},
                     {"excess", {11.6e4, 0.3}, "the same, with 30 % more friction at rest"}},
       .build = lugre},
      {.name = "position_dependence",
       .meaning = "Coulomb friction falls with the distance from the middle: F0 (1 - |x|/length)",
       .parameters = {{.name = "length",
                       .unit = "m",
                       .meaning = "distance at which it would vanish",
                       .range = positive,
                       .start = 2.5,
                       .low = 0.3,
                       .high = 1e3}},
       .plausible = {{"", {25e-3}, "a way worn in its middle"}},
       .build = position_dependence},
      {.name = "quadratic_drag",
       .meaning = "drag that goes with the square of speed, beside the damper",
       .parameters = {{.name = "drag",
                       .unit = "N.s^2/m^2",
                       .meaning = "force over the square of speed",
                       .range = {.low = 0.0},
                       .start = 0.1,
                       .low = 1e-5,
                       .high = 3.0}},
       .plausible = {{"", {5.0}, "a damper that has a sixth of its force from turbulence in mid range"}},
       .build = quadratic_drag},
      {.name = "rigid_and_compliant",
       .meaning = "two contacts in parallel, one rigid and one behind a spring",
       .parameters = {contact,
                      {.name = "share",
                       .unit = "1",
                       .meaning = "of the compliant contact in F0",
                       .range = {.low = 0.0, .high = 1.0},
                       .start = 0.5,
                       .low = 0.01,
                       .high = 0.99}},
       .plausible = {{"", {11.6e4, 0.5}, "half of the friction behind the measured stiffness"}},
       .build = rigid_and_compliant},
      {.name = "softening_spring",
       .meaning = "the spring softens with its elongation",
       .parameters = {cubic},
       .plausible = {{"6 %", {1e6}, "6 % softer at 10 mm"}},
       .forced_only = true,
       .build = softening_spring},
      {.name = "stribeck",
       .meaning = "friction falls with speed",
       .parameters = {excess, fall},
       .plausible = {{"10 mm/s", {0.3, 0.01}, "30 % more friction at rest, boundary lubrication"},
                     {"50 mm/s", {0.3, 0.05}, "the same, falling over a wider range"},
                     {"200 mm/s", {0.3, 0.2}, "the same, over half of the range of speeds"}},
       .build = stribeck},
      {.name = "viscous_power",
       .meaning = "the viscous force goes with a power of speed: a film that thins under shear",
       .parameters = {{.name = "exponent",
                       .unit = "1",
                       .meaning = "of the speed",
                       .range = positive,
                       .start = 0.6,
                       .low = 0.1,
                       .high = 3.0}},
       .plausible = {{"", {0.8}, "a grease of flow index 0.8"}},
       .build = viscous_power},
      {.name = "viscous_saturating",
       .meaning = "the viscous force levels off with speed: a film that thins under shear",
       .parameters = {{.name = "saturation_velocity",
                       .unit = "m/s",
                       .meaning = "speed at which the force is half of what it comes to",
                       .range = positive,
                       .start = 2.0,
                       .low = 0.05,
                       .high = 1e3}},
       .plausible = {{"", {0.7}, "a film of 0.1 mm that has lost half of its viscosity at 7000 1/s"}},
       .build = viscous_saturating},
      {.name = "warming_contact",
       .meaning = "Coulomb friction falls as the contact warms, over a minute",
       .parameters = {power},
       .plausible = {{"", {16.0}, "1 % of friction a kelvin, 6 K a watt"}},
       .build = warming_contact},
      {.name = "warming_film",
       .meaning = "viscosity falls as the film warms by its own heat, over a minute",
       .parameters = {power},
       .plausible = {{"", {4.0}, "4 % of viscosity a kelvin, 6 K a watt"}},
       .build = warming_film},
  };
}

}  // namespace

double natural_scale(const Rig& rig, std::string_view unit) {
  const double k = rig.oscillator.stiffness;
  const double X = rig.reference.amplitude;
  const double V = rig.reference.speed();
  const double force = k * rig.reference.Y;
  if (unit == "1") return 1.0;
  if (unit == "m") return X;
  if (unit == "m/s") return V;
  if (unit == "s") return 1.0 / rig.reference.frequency;
  if (unit == "N/m") return k;
  if (unit == "N/m^3") return k / (X * X);
  if (unit == "N.s^2/m^2") return force / (V * V);
  if (unit == "W") return force * V / 2.0;
  throw std::logic_error("no scale for the unit " + std::string(unit));
}

const std::vector<Mechanism>& mechanisms() {
  static const std::vector<Mechanism> list = table();
  return list;
}

const Mechanism* find_mechanism(std::string_view name) {
  const auto& list = mechanisms();
  const auto found = std::ranges::find(list, name, &Mechanism::name);
  return found == list.end() ? nullptr : &*found;
}

Model released(const Mechanism& mechanism, const Rig& rig, const RigFriction& friction,
               std::span<const double> parameters, double stiffness, double displacement) {
  Rig other = rig;
  other.oscillator.stiffness = stiffness;
  const auto build = mechanism.forced_only ? coulomb_viscous : mechanism.build;
  Model model = build(other, friction, parameters, rig.reference.Y);
  model.excitation = {};
  model.initial = {.position = displacement};
  return model;
}

}  // namespace dualdamp::sim
