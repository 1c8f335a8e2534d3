#include "sim/orbits/structural_damping.hpp"

#include "sim/validate.hpp"

namespace dualdamp::sim {

Model with_viscous_equivalent(Model model) {
  valid_harmonic(model, "structural damping");
  Oscillator& o = model.oscillator;
  const Excitation& drive = model.excitation;
  require(drive.harmonics.empty(), "structural damping (system.loss_factor) needs a drive of one frequency",
          "an excitation without harmonics");
  const bool two_dampers = drive.moves_base() && o.damper_to == DamperTo::ground && o.damping != 0.0;
  require(!two_dampers, "structural damping (system.loss_factor) acts between mass and base, the damper to ground",
          "damper_to: base, or damping 0");
  if (drive.moves_base()) o.damper_to = DamperTo::base;
  o.damping += o.loss_factor * o.stiffness / drive.frequency;
  o.loss_factor = 0.0;
  return model;
}

}  // namespace dualdamp::sim
