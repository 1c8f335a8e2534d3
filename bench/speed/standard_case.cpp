#include "bench/speed/standard_case.hpp"

#include <stdexcept>

#include "friction_models/laws/coulomb.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench::speed {

sim::Model model_of(const StandardCase& work) {
  sim::Model model;
  model.oscillator = {.mass = work.mass, .stiffness = work.stiffness, .damping = work.damping};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = work.base_amplitude, .frequency = work.frequency};
  model.friction.emplace_back(friction::Coulomb(work.friction, work.friction));
  model.initial = {work.start_position, work.start_velocity};
  return model;
}

StandardCase standard_case() {
  StandardCase work;
  const sim::SteadyState orbit = sim::steady_state(model_of(work));
  if (!orbit.outcome.ok())
    throw std::runtime_error("the standard case has no steady state: " + orbit.outcome.reason);
  work.start_position = orbit.start.x;
  work.start_velocity = orbit.start.v;
  return work;
}

double IntervalField::direction_after(double x, double t) const {
  const double force = pull(x, t);
  if (std::abs(force) <= friction) throw std::logic_error("the standard case does not stick");
  return std::copysign(1.0, force);
}

}  // namespace dualdamp::bench::speed
