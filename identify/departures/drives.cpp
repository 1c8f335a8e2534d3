#include <array>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "identify/departures/groups.hpp"

namespace dualdamp::identify::departures {

namespace {

/// Fourier coefficients of tanh(a cos t)/tanh(a) of order 1, 3, 5, ... They fall by exp(-2 asinh(pi/2a)) from one
/// to the next, and the trapezoidal rule errs by those of order 2 * points and above.
std::array<double, 8> clipped_cosine(double a) {
  constexpr int points = 256;
  std::array<double, 8> coefficients{};
  for (int i = 0; i < points; ++i) {
    const double angle = core::two_pi * i / points;
    const double y = std::tanh(a * std::cos(angle)) / std::tanh(a);
    for (std::size_t j = 0; j < coefficients.size(); ++j)
      coefficients[j] += 2.0 / points * y * std::cos(static_cast<double>(2 * j + 1) * angle);
  }
  return coefficients;
}

sim::Model base_clipping(const RigBase& base, DepartureValues p) {
  const double Y = base.model.excitation.amplitude;
  sim::Model model = with_coulomb(base);
  const std::array<double, 8> shares = clipped_cosine(Y / p[0]);
  model.excitation.amplitude = shares[0] * Y;
  for (std::size_t j = 1; j < shares.size(); ++j) {
    const double share = shares[j];
    // Amplitudes must be positive: the sign goes into the phase.
    model.excitation.harmonics.push_back({.order = static_cast<int>(2 * j + 1),
                                          .amplitude = std::abs(share) * Y,
                                          .phase = share < 0.0 ? std::numbers::pi : 0.0});
  }
  return model;
}

sim::Model base_distortion(const RigBase& base, DepartureValues p) {
  sim::Model model = with_coulomb(base);
  model.excitation.harmonics = {{.order = 3, .amplitude = p[0], .phase = 0.0}};
  return model;
}

/// A spring of the force k x + k3 x^3, driven at a frequency other than stated.
sim::Model spring_and_drive(const RigBase& base, double k3, double offset) {
  sim::Model model = with_coulomb(base);
  model.oscillator.cubic_stiffness = k3;
  model.excitation.frequency *= 1.0 + offset;
  return model;
}

sim::Model cubic_spring(const RigBase& base, DepartureValues p) { return spring_and_drive(base, p[0], 0.0); }

sim::Model softening_spring(const RigBase& base, DepartureValues p) { return spring_and_drive(base, -p[0], 0.0); }

sim::Model hardening_spring_detuned(const RigBase& base, DepartureValues p) {
  return spring_and_drive(base, p[0], p[1]);
}

sim::Model detuning(const RigBase& base, DepartureValues p) {
  return spring_and_drive(base, base.model.oscillator.cubic_stiffness, p[0]);
}

/// A spring and a damper of its own carry part of the mass. The second mode lies at about four times the natural
/// frequency, between the odd harmonics of friction: close to one of them, rigs would differ by chance.
sim::Model second_mode(const RigBase& base, DepartureValues p) {
  constexpr double frequency = 4.0;       // over the natural one
  constexpr double damping_ratio = 0.02;  // of the rider on a base that is held
  const double whole = base.model.oscillator.mass;
  const double rider = p[0] * whole;
  const double held = frequency * sim::natural_frequency(base.model.oscillator) * std::sqrt(1.0 - p[0]);
  RigBase parted = base;
  parted.model.oscillator.mass = whole - rider;
  parted.model = with_law(
      parted.model, "attached_mass",
      {{"mass", rider}, {"stiffness", rider * held * held}, {"damping", 2.0 * damping_ratio * rider * held}});
  return with_coulomb(parted);
}

constexpr DepartureParameter cubic_parameter = {.name = "cubic_stiffness",
                                                .unit = "N/m^3",
                                                .meaning = "k3 of the spring, as a positive number",
                                                .range = positive,
                                                .start = 0.05,
                                                .low = 1e-4,
                                                .high = 0.5};
constexpr DepartureParameter offset_parameter = {.name = "offset",
                                                 .unit = "1",
                                                 .meaning = "forcing frequency over the stated one, less 1",
                                                 .range = {.low = -0.5, .high = 1.0},
                                                 .start = 0.02,
                                                 .low = -0.15,
                                                 .high = 0.15};

std::vector<Departure> drives() {
  return {
      {.name = "base_clipping",
       .meaning =
           "the exciter nears the end of its stroke: y = Y tanh(a cos wt)/tanh(a), a = Y/stroke, read by its peak",
       .parameters = {{.name = "stroke",
                       .unit = "m",
                       .meaning = "amplitude at which the base's motion begins to flatten",
                       .range = positive,
                       .start = 0.6,
                       .low = 0.1,
                       .high = 100.0}},
       .build = base_clipping,
       .plausible = {{"", {10e-3}, "an exciter whose third harmonic is 3 % near the end of its stroke"}},
       .forced_only = true},
      {.name = "base_distortion",
       .meaning = "the base moves with a third harmonic",
       .parameters = {{.name = "third_harmonic",
                       .unit = "m",
                       .meaning = "its amplitude, the same at all inputs",
                       .range = not_negative}},
       .build = base_distortion,
       .severity = "third harmonic of the base over its fundamental in the middle of the range",
       .largest = 1.0,
       .values_at = [](const RigBase& base, double s) { return std::vector{s * base.reference.Y}; },
       .forced_only = true},
      {.name = "detuned_below",
       .meaning = "the drive is slower than stated",
       .parameters = {offset_parameter},
       .build = detuning,
       .severity = "1 less the forcing frequency over the stated one",
       .largest = 0.5,
       .values_at = [](const RigBase&, double s) { return std::vector{-s}; },
       .forced_only = true,
       .twin_of = "detuning"},
      {.name = "detuning",
       .meaning = "the drive is not at the resonance that the method assumes",
       .parameters = {offset_parameter},
       .build = detuning,
       .severity = "forcing frequency over the stated one, less 1",
       .largest = 1.0,
       .values_at = [](const RigBase&, double s) { return std::vector{s}; },
       .plausible = {{"above", {0.02}, "mass and spring known to 2 % each"},
                     {"below", {-0.02}, "mass and spring known to 2 % each"}},
       .forced_only = true,
       .largest_below = 0.5,
       .spring_limit = 0.01},
  };
}

/// The cubic spring that at the amplitude X has the force s k X.
std::vector<double> cubic_at(const RigBase& base, double s) {
  const double X = base.reference.amplitude;
  return {s * base.model.oscillator.stiffness / (X * X)};
}

std::vector<Departure> springs() {
  return {
      {.name = "cubic_spring",
       .meaning = "the spring stiffens with its elongation",
       .parameters = {cubic_parameter},
       .build = cubic_spring,
       .severity = "hardening k3 X^2 over the stiffness k",
       .largest = 10.0,
       .values_at = cubic_at,
       .forced_only = true,
       .largest_below = 0.3,
       .spring_limit = 0.1},
      {.name = "hardening_spring",
       .meaning = "the spring stiffens with its elongation",
       .parameters = {cubic_parameter},
       .build = cubic_spring,
       .plausible = {{"6 %", {1e6}, "6 % stiffer at 10 mm"}, {"19 %", {3e6}, "19 % stiffer at 10 mm"}},
       .forced_only = true},
      {.name = "hardening_spring_detuned",
       .meaning = "the spring stiffens, and the drive is set to the resonance of large amplitudes",
       .parameters = {cubic_parameter, offset_parameter},
       .build = hardening_spring_detuned,
       .plausible = {{"",
                      {8.3e5, 0.1},
                      "5 % stiffer at 10 mm, driven 10 % above the resonance of small amplitudes"}},
       .forced_only = true},
      {.name = "second_mode",
       .meaning =
           "the structure has a second mode, four times as fast: a spring of its own carries part of the mass",
       .parameters = {{.name = "share",
                       .unit = "1",
                       .meaning = "of the mass that a spring and damper of its own carry",
                       .range = {.low = 0.0, .high = 1.0, .low_open = true, .high_open = true}}},
       .build = second_mode,
       .severity =
           "share of the mass that a spring of its own carries, with 2 % of critical damping, the second mode at "
           "about four times the natural frequency",
       .largest = 0.5,
       .values_at = [](const RigBase&, double s) { return std::vector{s}; },
       // It takes as long as a bristle law, and at one frequency its inertia acts on the readings as another
       // stiffness does, which `detuning` covers.
       .outside_library = true},
      {.name = "softening_spring",
       .meaning = "the spring softens with its elongation",
       .parameters = {cubic_parameter},
       .build = softening_spring,
       .severity = "softening -k3 X^2 over the stiffness k",
       .largest = 0.3,
       .values_at = cubic_at,
       .plausible = {{"6 %", {1e6}, "6 % softer at 10 mm"}},
       .forced_only = true,
       .twin_of = "cubic_spring"},
  };
}

}  // namespace

std::vector<Departure> drive_departures() {
  return joined({of_family(Family::drive, drives()), of_family(Family::spring, springs())});
}

}  // namespace dualdamp::identify::departures
