#pragma once
/// What a departure comes to: what could be known of it, and what it costs.
///
/// The noise-free readings d of the departed motion are compared with those of Coulomb + viscous friction, f(zeta,
/// F0), that the laboratory would compute with the constants it believes in:
///
///   distance^2 = min over zeta, F0 of sum_i ((d_i - f_i(zeta, F0))/sigma_i)^2,
///   harm = largest relative difference between the zeta and F0 of that minimum and the truth.
///
/// Readings are all that a record holds and that has noise: amplitudes and phases of pairs, extremes, samples of x,
/// v and a; a mass that has come to rest has further extremes where it sticks. The response to a random drive is
/// none of them: a distance takes some 27 motions, and one of 2,000 s takes a second. sigma_i is the standard
/// deviation of a reading, that of resolution and of Y (by dx/dY) included. So harm is what a perfect fit would be
/// wrong by, and no test has more power than
///
///   attainable power = Phi(distance - 1.645),
///
/// that of the likelihood-ratio test at 5 % which knows the departure and the noise (Neyman and Pearson).
///
/// Cramer-Rao: the relative standard deviation of zeta and F0 that the best unbiased estimator has which knows the
/// law and its severity: (J^T J)^-1 with J = d(d_i/sigma_i)/d(ln c, ln F0).
///
/// A number that does not exist is NaN: without noise there is no distance, and harm is that of equal weights.

#include <array>

#include "bench/motions.hpp"

namespace dualdamp::bench {

struct Consequence {
  double distance = not_stated;
  double harm_zeta = not_stated;  ///< relative, with its sign; NaN where the departure leaves no zeta
  double harm_F0 = not_stated;
  double attainable_power = not_stated;
  double cramer_rao_zeta = not_stated;  ///< relative
  double cramer_rao_F0 = not_stated;

  /// Of harm_zeta and harm_F0 the larger modulus; NaN where there is neither.
  [[nodiscard]] double harm() const;
};

/// A departure as it is made, and as the laboratory reads it.
struct DepartedRig {
  Departure departure{};
  double severity = 0.0;
  ReferenceMotion reference{};
};

/// The motions of a departed rig, and those of rigs with a little more c, a little more F0: all that the bound of
/// Cramer and Rao takes. They serve all sensors.
struct DepartedMotions {
  Motions here;
  std::array<Motions, 2> beside;
  UnmeasuredAmplitudes unmeasured{};
};

[[nodiscard]] DepartedMotions departed_motions(const MotionMaker& maker, const DepartedRig& departed,
                                               const Truth& truth, const Laboratory& laboratory);

/// `laboratory`: what it believes, and its sensors as they are; `nominal`: as it believes them to be.
[[nodiscard]] Consequence consequence_of(const MotionMaker& maker, const DepartedRig& departed, const TrueRig& rig,
                                         const DepartedMotions& motions, const Laboratory& laboratory,
                                         const identify::Sensors& nominal);

}  // namespace dualdamp::bench
