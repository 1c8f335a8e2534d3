#pragma once
/// Whether two motions of one model can move apart.
///
/// Let e be the difference of two motions under one drive, with a linear spring k > 0, damping c >= 0 and a
/// friction force F(v, t) that never falls as v grows, also in its jump at v = 0 (static = kinetic). Then
///
///   d/dt (m e'^2 + k e^2)/2 = -c e'^2 - (F(v1) - F(v2)) (v1 - v2) <= 0.
///
/// So motions never move apart, and an orbit that attracts its neighbours attracts every motion. With c > 0 two
/// orbits have e' = 0, and k e is the constant difference of their friction forces: zero, unless both masses
/// stick for ever. So there is at most one orbit on which the mass moves, whatever its Floquet multipliers are.

#include "sim/model.hpp"

namespace dualdamp::sim {

enum class Motions {
  may_part,      ///< several orbits may attract
  never_part,    ///< an orbit that attracts is the only one
  meet_sliding,  ///< an orbit on which the mass moves is the only one
};

/// The force of a law that is not affine is tested on a grid of speeds and times.
[[nodiscard]] Motions motions_of(const Model& model);

}  // namespace dualdamp::sim
