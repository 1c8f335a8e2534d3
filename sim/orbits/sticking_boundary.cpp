#include "sim/orbits/sticking_boundary.hpp"

#include <algorithm>
#include <cmath>

#include "sim/analytic/den_hartog.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

constexpr double precision = 1e-12;
constexpr int max_doublings = 60;

/// Force limits of all laws together at the start [N].
struct ForceLimits {
  double kinetic = 0.0;
  double holding = 0.0;
  bool coulomb = true;  ///< each law is Coulomb friction, the same in both directions
};

bool is_coulomb(const friction::Law& law, const friction::Memory& memory) {
  if (law.is_modal()) return false;
  const double kinetic = law.force(memory, {}, Direction::forward);
  return law.force(memory, {.x = 1.0, .v = 1.0}, Direction::forward) == kinetic &&
         law.force(memory, {.v = -1.0}, Direction::backward) == -kinetic &&
         law.force(memory, {}, Direction::none) == 0.0;
}

ForceLimits limits_of(const Model& model) {
  ForceLimits limits;
  for (const friction::Law& law : model.friction) {
    const friction::Memory memory = law.start({});
    limits.kinetic += law.force(memory, {}, Direction::forward);
    limits.holding += law.static_limit(memory, {});
    limits.coulomb = limits.coulomb && is_coulomb(law, memory);
  }
  return limits;
}

std::optional<double> den_hartogs(const Model& model, const ForceLimits& limits) {
  const Oscillator& o = model.oscillator;
  const bool his = o.loss_factor == 0.0 && limits.coulomb && limits.kinetic == limits.holding &&
                   o.damper_to == DamperTo::ground && model.excitation.type == ExcitationType::base_harmonic &&
                   model.excitation.harmonics.empty();
  if (!his) return std::nullopt;
  const double zeta = o.damping / (2.0 * std::sqrt(o.mass * o.stiffness));
  const double r = model.excitation.frequency / std::sqrt(o.stiffness / o.mass);
  return limits.kinetic / o.stiffness / analytic::non_sticking_boundary(analytic::den_hartog(zeta, r));
}

SteadyState at(Model& model, double amplitude) {
  model.excitation.amplitude = amplitude;
  return steady_state(model, {.full_account = false});
}

BoundaryPoint find(Model model, const ForceLimits& limits, double omega) {
  model.excitation.frequency = omega;
  BoundaryPoint point{.omega = omega};
  const bool base = model.excitation.type == ExcitationType::base_harmonic;
  // This drive is too weak to move the mass.
  double low = limits.holding / (base ? model.oscillator.stiffness : 1.0);
  double high = 2.0 * low;
  SteadyState state = at(model, high);
  for (int i = 0; i < max_doublings && state.outcome.ok() && !state.sticks.empty(); ++i) {
    low = high;
    high *= 2.0;
    state = at(model, high);
  }
  while (state.outcome.ok() && high - low > precision * high) {
    const double middle = 0.5 * (low + high);
    SteadyState trial = at(model, middle);
    (trial.outcome.ok() && trial.sticks.empty() ? high : low) = middle;
    if (!trial.outcome.ok() || trial.sticks.empty()) state = std::move(trial);
  }
  point.outcome = state.outcome;
  if (point.outcome.ok() && !state.sticks.empty())
    point.outcome = {core::OutcomeKind::no_steady_state, "the mass sticks at every amplitude"};
  point.amplitude = high;
  point.x = state.amplitude;
  if (point.outcome.ok()) point.closed_form = den_hartogs(model, limits);
  return point;
}

/// The model with a valid frequency and amplitude, in place of those that are set later.
Model driven(Model model) {
  model.excitation.frequency = 1.0;
  model.excitation.amplitude = 0.0;
  return model;
}

}  // namespace

std::vector<BoundaryPoint> sticking_boundary(const Model& model, std::span<const double> frequencies) {
  require_in(positive, "analysis.frequencies", frequencies, "rad/s");
  const ForceLimits limits = limits_of(valid_harmonic(driven(model), "sticking_boundary"));
  std::vector<BoundaryPoint> boundary;
  for (const double omega : frequencies) boundary.push_back(find(model, limits, omega));
  return boundary;
}

}  // namespace dualdamp::sim
