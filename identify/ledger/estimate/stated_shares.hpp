#pragma once
/// How a mass and a stiffness share a departure that only k/m shows, where uncertainties are stated.
///
/// Steady states and free vibrations tell by how much k/m is off, D = ln(k/m) - ln(k0/m0), not which of the two.
/// With independent normal errors of standard uncertainty u_m, u_k (relative) and u_w of the frequency, the most
/// probable errors are
///
///   ln m - ln m0 = -D u_m^2/S,  ln k - ln k0 = D u_k^2/S,  S = u_m^2 + u_k^2 + 4 u_w^2,
///
/// so that a constant without an uncertainty is exact beside one that has one. Beyond what the uncertainties allow,
/// a mass or a stiffness without one counts with `unstated_uncertainty`.

#include "identify/ledger/relaxation_tests.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify {

/// The largest relative error of k/m, of a gain or of both that the stated uncertainties allow.
[[nodiscard]] double allowed_error(const ConstantUncertainties& uncertainties, const KnownConstants& constants);

class StatedShares {
 public:
  StatedShares() = default;
  StatedShares(const KnownConstants& stated, const ConstantUncertainties& uncertainties);

  /// Do mass and stiffness explain this departure alike, and are uncertainties stated that share it out?
  [[nodiscard]] bool apply_to(const JointModel& model, const FoundDeparture& departure) const;

  /// Stated uncertainties, relative; 0: none.
  [[nodiscard]] double mass() const { return mass_; }
  [[nodiscard]] double stiffness() const { return stiffness_; }

  /// That of any stated number, relative; 0: none.
  [[nodiscard]] double relative(double ConstantUncertainties::* uncertainty) const {
    return relative_.*uncertainty;
  }
  /// The largest relative error of k/m, of a gain or of both that the uncertainties allow.
  [[nodiscard]] double allowed() const { return allowed_; }

  /// Is this relaxation the mass or the stiffness?
  [[nodiscard]] static bool is_shared(const Relaxation& relaxation);

  /// Mass and stiffness of a fit with one of them free, each with its share.
  [[nodiscard]] KnownConstants of(const KnownConstants& fitted) const;

  /// Is the departure of a fit within what the uncertainties allow?
  [[nodiscard]] bool allow(const KnownConstants& fitted) const;

 private:
  [[nodiscard]] double departure_of(const KnownConstants& fitted) const;

  KnownConstants stated_;
  ConstantUncertainties relative_;  ///< each as a share of its number
  double mass_ = 0.0, stiffness_ = 0.0, inertia_ = 0.0, allowed_ = 0.0;
};

/// A fit of a record that tells k/m alone, carried over to another mass and stiffness with this ratio.
[[nodiscard]] JointModel with_constants(JointModel model, const KnownConstants& constants);

/// Moves the relaxed model, and the change of F0 by the departure, to the shared constants.
void share_out(const JointModel& model, const StatedShares& shares, RelaxationTests& tests);

}  // namespace dualdamp::identify
