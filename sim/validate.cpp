#include "sim/validate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numbers.hpp"
#include "friction_models/modifiers/modifiers.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::sim {

namespace {

using core::Diagnostic;
using friction::Range;

constexpr int max_order = 1000;
constexpr Range any{};
constexpr Range phases{.low = -friction::largest_phase, .high = friction::largest_phase};
constexpr Range tolerances{.low = least_tolerance, .high = 1e-3};

std::string with_unit(double value, std::string_view unit) {
  constexpr int digits = 6;
  const std::string number = core::format_number(value, digits);
  return unit.empty() || unit == "1" ? number : number + " " + std::string(unit);
}

Diagnostic out_of_range(std::string_view path, std::string_view why, const Range& range, double value,
                        std::string_view unit) {
  return {.message = "'" + std::string(path) + "' is out of range" + std::string(why),
          .allowed = range.describe(unit),
          .found = with_unit(value, unit)};
}

Diagnostic too_many(std::string_view path, std::size_t most, std::size_t found) {
  return {.message = "'" + std::string(path) + "' has too many items",
          .allowed = "1 to " + std::to_string(most) + " items",
          .found = std::to_string(found)};
}

bool lies_in(const Range& range, double value) { return std::isfinite(value) && range.contains(value); }

/// Collects the problems of one model.
class Check {
 public:
  explicit Check(core::Coordinate coordinate) : coordinate_(coordinate) {}

  /// `unit`: for a displacement.
  void in(const Range& range, std::string_view path, double value, std::string_view unit,
          std::string_view why = {}) {
    if (!lies_in(range, value)) [[unlikely]]
      problems_.push_back(out_of_range(path, why, range, value, core::unit_for(coordinate_, unit)));
  }

  void oscillator(const Oscillator& o) {
    in(friction::positive, "system.mass", o.mass, "kg");
    in(friction::positive, "system.stiffness", o.stiffness, "N/m", ": a motion needs a spring");
    in(any, "system.damping", o.damping, "N.s/m");
    in(any, "system.cubic_stiffness", o.cubic_stiffness, "N/m^3");
    in(friction::not_negative, "system.gravity_stiffness", o.gravity_stiffness, "N.m");
    in(friction::not_negative, "system.loss_factor", o.loss_factor, "1");
  }

  void excitation(const Excitation& e) {
    const std::string_view unit = e.unit();
    if (e.is_harmonic()) {
      in(friction::not_negative, "excitation.amplitude", e.amplitude, unit);
      in(friction::positive, "excitation.frequency", e.frequency, "rad/s");
      in(phases, "excitation.phase", e.phase, "rad");
      in(any, "excitation.offset", e.offset, "N");
      if (e.harmonics.size() > static_cast<std::size_t>(max_harmonics))
        problems_.push_back(too_many("excitation.harmonics", max_harmonics, e.harmonics.size()));
      for (const Harmonic& harmonic : e.harmonics) this->harmonic(harmonic, unit);
    } else if (e.is_noise()) {
      in(friction::not_negative, "excitation.intensity", e.noise.intensity, e.moves_base() ? "m^2.s" : "N^2.s");
      in(friction::positive, "excitation.bandwidth", e.noise.bandwidth, "rad/s");
    } else if (e.is_chirp()) {
      in(friction::not_negative, "excitation.amplitude", e.amplitude, unit);
      in(phases, "excitation.phase", e.phase, "rad");
      in(friction::positive, "excitation.from", e.chirp.from, "rad/s");
      in(friction::positive, "excitation.to", e.chirp.to, "rad/s");
      in(friction::positive, "excitation.duration", e.chirp.duration, "s");
    } else if (e.is_sampled()) {
      if (e.samples == nullptr) problems_.push_back({.message = "a sampled excitation has no samples"});
    } else if (e.is_ramp()) {
      in(any, e.moves_base() ? "excitation.velocity" : "excitation.rate", e.slope, e.moves_base() ? "m/s" : "N/s");
    }
  }

  void model(const Model& model) {
    oscillator(model.oscillator);
    excitation(model.excitation);
    jumps(model);
    if (model.friction.size() > max_laws)
      problems_.push_back(too_many("system.friction", max_laws, model.friction.size()));
    in(any, "initial.position", model.initial.position, "m");
    in(any, "initial.velocity", model.initial.velocity, "m/s");
    in(tolerances, "numerics.tolerance", model.solver.tolerance, "1");
  }

  std::vector<Diagnostic> take() { return std::move(problems_); }

 private:
  /// If the base jumps, a damper between base and mass would exert an infinite force.
  void jumps(const Model& model) {
    const Excitation& e = model.excitation;
    if (!e.is_sampled() || e.samples == nullptr || !e.samples->jumps()) return;
    if (!e.moves_base() || model.oscillator.damper_to != DamperTo::base || model.oscillator.damping == 0.0) return;
    const std::string jump = e.samples->interpolation() == Interpolation::step
                                 ? "a base that moves in steps"
                                 : "a base motion that repeats and does not end where it began";
    problems_.push_back({.message = jump + " makes an infinite force in a damper to the base",
                         .allowed = "a base motion without jumps, or damper_to: ground"});
  }

  void harmonic(const Harmonic& harmonic, std::string_view unit) {
    in({.low = 2, .high = max_order}, "excitation.harmonics.order", harmonic.order, "");
    in(friction::not_negative, "excitation.harmonics.amplitude", harmonic.amplitude, unit);
    in(phases, "excitation.harmonics.phase", harmonic.phase, "rad");
  }

  core::Coordinate coordinate_;
  std::vector<Diagnostic> problems_;
};

std::string type_of(const Excitation& e) {
  switch (e.type) {
    case ExcitationType::none:
      return "no excitation";
    case ExcitationType::base_harmonic:
      return "excitation type 'base_harmonic'";
    case ExcitationType::force_harmonic:
      return "excitation type 'force_harmonic'";
    case ExcitationType::base_ramp:
      return "excitation type 'base_ramp'";
    case ExcitationType::force_ramp:
      return "excitation type 'force_ramp'";
    case ExcitationType::base_noise:
      return "excitation type 'base_noise'";
    case ExcitationType::force_noise:
      return "excitation type 'force_noise'";
    case ExcitationType::base_chirp:
      return "excitation type 'base_chirp'";
    case ExcitationType::force_chirp:
      return "excitation type 'force_chirp'";
    case ExcitationType::base_samples:
      return "excitation type 'base_samples'";
    case ExcitationType::force_samples:
      return "excitation type 'force_samples'";
  }
  return "this excitation";
}

}  // namespace

std::vector<Diagnostic> validate(const Model& model) {
  Check check(model.oscillator.coordinate);
  check.model(model);
  return check.take();
}

const Model& valid(const Model& model) {
  std::vector<Diagnostic> problems = validate(model);
  if (!problems.empty()) throw core::InputError(std::move(problems));
  return model;
}

const Model& valid_harmonic(const Model& model, std::string_view analysis) {
  if (!model.excitation.is_harmonic()) [[unlikely]]
    refuse(std::string(analysis) + " does not work with " + type_of(model.excitation),
           "base_harmonic, force_harmonic");
  return valid(model);
}

const Model& valid_free(const Model& model, std::string_view analysis) {
  if (model.excitation.type != ExcitationType::none) [[unlikely]]
    refuse(std::string(analysis) + " does not work with " + type_of(model.excitation), "none");
  return valid(model);
}

void require_in(const Range& range, std::string_view path, double value, std::string_view unit) {
  if (!lies_in(range, value)) [[unlikely]]
    throw core::InputError(out_of_range(path, {}, range, value, unit));
}

void require_in(const Range& range, std::string_view path, std::span<const double> values, std::string_view unit) {
  for (const double value : values) require_in(range, path, value, unit);
}

void refuse(std::string_view message, std::string_view allowed) {
  core::refuse({}, std::string(message), std::string(allowed));
}

void require(bool holds, std::string_view message, std::string_view allowed) {
  if (!holds) [[unlikely]]
    refuse(message, allowed);
}

}  // namespace dualdamp::sim
