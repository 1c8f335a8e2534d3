#pragma once
/// Energy account of a motion [J]: input = friction + viscous + stored, up to the defect.

namespace dualdamp::sim {

struct Energy {
  double input = 0.0;     ///< work of the moving base on spring and damper, and of the external force on the mass
  double friction = 0.0;  ///< work done against the friction laws
  double viscous = 0.0;   ///< work dissipated by the damper
  double stored = 0.0;    ///< change of m v^2/2 + spring_energy(y - x)
  double defect = 0.0;    ///< input - friction - viscous - stored; only rounding if the motion is right
};

}  // namespace dualdamp::sim
