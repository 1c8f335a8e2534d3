#pragma once
/// How assumptions may fail in steady states: the drive that a motion needs, with one assumption relaxed.
///
/// A harmonic drive Y e^(i phi), phase counted from the fundamental of x, moves the mass by x. Coulomb and viscous
/// friction alone need exactly D(x) = (Y, phi) of Den Hartog's closed form, read backwards. A further force whose
/// fundamental is k e(x, w) adds e to D, to first order in its harmonics. So every relaxation is D with a
/// coefficient g: a force g e, another frequency ratio, a gain or a lag. x-Y pairs are of a base that moves by Y,
/// so the spring stretches by x - y: near resonance y is in quadrature, and a cubic spring changes the damping that
/// seems to be there as well as the stiffness.
///
/// Lengths in units of the largest output, frequencies over wn. Source: denhartog1931; the fundamentals of the
/// forces as in harmonic_balance.

#include <complex>
#include <span>
#include <string_view>
#include <vector>

#include "identify/assumption.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Coulomb and viscous friction: zeta and x_f.
struct PlainFriction {
  double zeta = 0.0;
  double x_f = 0.0;
};

/// D of plain friction. It does not check whether the motion sticks.
[[nodiscard]] std::complex<double> plain_drive(const PlainFriction& friction, double x, double r);

/// The steady state that a term is evaluated at.
struct SteadyPoint {
  double Y = 0.0;
  double x = 0.0;
  double phase = 0.0;  ///< of x behind y [rad]; NaN: not measured
  double r = 1.0;      ///< w/wn
  int sweep = 0;
  int number = 0;
};

/// The states of a record; lengths are divided by `unit`, frequencies by wn.
[[nodiscard]] std::vector<SteadyPoint> points_of(const std::vector<Pair>& states, const KnownConstants& constants,
                                                 double unit);

/// Where a fit begins: the best of a grid in zeta and x_f.
[[nodiscard]] PlainFriction first_guess(const std::vector<SteadyPoint>& points);

/// Where fits with a relaxation begin: at the plain fit. If that ended with hardly any damping or without friction,
/// far from all other fits, they begin with half of the drive of the largest gain viscous, and half Coulomb.
[[nodiscard]] PlainFriction start_beside(const PlainFriction& plain, const std::vector<SteadyPoint>& points);

struct AmplitudeTerm {
  Assumption assumption;
  std::string_view test;
  bool several_frequencies;  ///< needed: at one frequency it equals another term, or has no effect
  std::complex<double> (*drive)(const PlainFriction& friction, double x, double r, double g);
  int sign = 0;  ///< of g in such a departure; 0: either
  Freed freed = Freed::effect;
};

/// The terms, by assumption.
[[nodiscard]] std::span<const AmplitudeTerm> amplitude_terms();

/// input_levels.hpp, of these states.
[[nodiscard]] std::string lacks_levels(const std::vector<SteadyPoint>& points);

/// Leaves out the states that stick at this friction, each with a sentence. Returns whether there are any.
bool drop_sticking(std::vector<SteadyPoint>& points, const PlainFriction& friction,
                   std::vector<std::string>& left_out);

}  // namespace dualdamp::identify
