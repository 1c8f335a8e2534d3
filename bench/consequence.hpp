#pragma once
/// The consequence of a departure: how well it can be detected, and what error it causes.
///
/// The noise-free readings d of the departed motion are compared with those of Coulomb + viscous friction, f(zeta,
/// F0), that the laboratory would compute with the constants it believes in:
///
///   distance^2 = min over zeta, F0 of sum_i ((d_i - f_i(zeta, F0))/sigma_i)^2,
///   harm = largest relative difference between the zeta and F0 of that minimum and the truth.
///
/// Readings are all data of a record that have noise: amplitudes and phases of pairs, extremes, samples of x, v and
/// a. Where the mass has come to rest, the remaining extremes are its position. The response to a random drive is
/// not among the readings: a distance takes some 27 motions, and one motion of 2,000 s takes a second. sigma_i is
/// the standard deviation of a reading, including that of the resolution and of Y (by dx/dY). So harm is the error
/// of a perfect fit, and no test has more power than
///
///   attainable power = Phi(distance - 1.645),
///
/// the power of the likelihood-ratio test at 5 % that knows the departure and the noise (Neyman and Pearson).
///
/// Cramer-Rao: the relative standard deviation of zeta and F0 of the best unbiased estimator that knows the law and
/// its severity: (J^T J)^-1 with J = d(d_i/sigma_i)/d(ln c, ln F0).
///
/// A number that does not exist is NaN. Without noise there is no distance, and harm is computed with equal
/// weights.

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

  /// The larger modulus of harm_zeta and harm_F0; NaN where there is neither.
  [[nodiscard]] double harm() const;
};

/// A departure, its severity and the reference motion.
struct DepartedRig {
  CaseDeparture departure{};
  double severity = 0.0;
  ReferenceMotion reference{};
};

/// The motions of a departed rig, and those of the rigs with a slightly larger c and with a slightly larger F0, for
/// the bound of Cramer and Rao. They serve all sensors.
struct DepartedMotions {
  Motions here;
  std::array<Motions, 2> beside;
  UnmeasuredAmplitudes unmeasured{};
};

[[nodiscard]] DepartedMotions departed_motions(const MotionMaker& maker, const DepartedRig& departed,
                                               const Truth& truth, const Laboratory& laboratory);

/// `laboratory`: the constants that it believes in, and its true sensors; `nominal`: the sensors that it believes
/// to have.
[[nodiscard]] Consequence consequence_of(const MotionMaker& maker, const DepartedRig& departed, const TrueRig& rig,
                                         const DepartedMotions& motions, const Laboratory& laboratory,
                                         const identify::Sensors& nominal);

}  // namespace dualdamp::bench
