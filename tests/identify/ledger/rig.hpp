#pragma once
/// A rig of the tests' own, to measure how often the ledger of assumptions is right: a mass with dry friction,
/// integrated by Runge and Kutta's method with small fixed steps and bisection at reversals. It shares no code with
/// the engines or with the models that are fitted.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify::testing {

/// The rig and its departures from the assumptions. All departures zero: as assumed.
struct Rig {
  double m = 1.0;     ///< kg
  double k = 1000.0;  ///< N/m
  double zeta = 0.05;
  double F0 = 1.0;  ///< N

  bool on_base = false;       ///< the drive moves the far end of the spring by drive/k; false: a force on the mass
  double cubic = 0.0;         ///< spring k z (1 + cubic (z/L)^2) of the elongation z
  double second_mass = 0.0;   ///< share of m that rides on a spring of its own
  double second_ratio = 4.3;  ///< its natural frequency over the first
  double drag = 0.0;          ///< c v (1 + drag |v|/V)
  double saturation = 0.0;    ///< c v/(1 + saturation |v|/V)
  double stribeck = 0.0;      ///< F0 (1 + stribeck exp(-10 |v|/V))
  double compliance = 0.0;    ///< deflection of the contact before it slides, over L
  double lugre = 0.0;         ///< deflection of the bristles before they slide, over L
  double asymmetry = 0.0;     ///< c v (1 + asymmetry sgn v)
  double play = 0.0;          ///< distance without friction after a reversal, over L
  double drift = 0.0;         ///< F0 (1 + drift (share of the record - 1/2))

  double L = 0.01;  ///< length and speed that the departures are relative to
  double V = 0.1;

  [[nodiscard]] double omega() const;
  [[nodiscard]] bool has_rigid_contact() const;
  [[nodiscard]] double x_f() const { return F0 / k; }
};

/// Drive k y + f [N] at a time [s].
using Drive = std::function<double(double)>;

/// Motion at `rate` from rest, or from `x0`; the first `settle` seconds are not returned.
struct Motion {
  std::vector<double> x, v, a, drive;
};
[[nodiscard]] Motion motion_of(const Rig& rig, const Drive& drive, double duration, double rate, double x0 = 0.0,
                               double settle = 0.0);

/// Steady state under k Y sin(omega t): amplitude, fundamental and its lag.
struct Steady {
  double x = 0.0;
  double phase = 0.0;
};
[[nodiscard]] Steady steady_state(const Rig& rig, double Y, double omega);

}  // namespace dualdamp::identify::testing
