#pragma once
/// Energy account of a motion [J]: input = friction + viscous + stored, up to the defect.

namespace dualdamp::sim {

struct Energy {
  double input = 0.0;     ///< work of the base motion and of the external force
  double friction = 0.0;  ///< work dissipated by the friction laws
  double viscous = 0.0;   ///< work dissipated by the damper
  double stored = 0.0;    ///< change of m v^2/2 + k x^2/2 (and of what laws store)
  double defect = 0.0;    ///< input - friction - viscous - stored
};

}  // namespace dualdamp::sim
