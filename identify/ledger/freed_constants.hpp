#pragma once
/// Fits of histories with the mass or the stiffness unknown, beside the fit with both as stated.

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "identify/methods/histories/forward_fit.hpp"

namespace dualdamp::identify {

/// A fit with one constant unknown.
struct FreedFit {
  Eigen::VectorXd p;    ///< in the layout of the fit as stated
  double change = 0.0;  ///< of the constant
  double missed = 0.0;  ///< share of the motion, as below
};

/// Each fit is made once, when it is asked for.
class FreedConstants {
 public:
  using By = SampledOscillator::By;

  /// All are references: they outlive this.
  FreedConstants(const Record& record, const KnownConstants& constants, ForwardFit& stated)
      : record_(record), constants_(constants), stated_(stated) {}

  /// The fit with this constant unknown; null if there is none.
  [[nodiscard]] const FreedFit* with(By by);

  /// The one that comes much nearer to the motion than the fit as stated, which misses a good part of it; else
  /// null.
  [[nodiscard]] const FreedFit* much_nearer();

  /// Why the fits tell nothing: they miss the motion, whatever the mass and the stiffness. Empty otherwise.
  [[nodiscard]] std::string fault();

 private:
  [[nodiscard]] const FreedFit* best();

  const Record& record_;
  const KnownConstants& constants_;
  ForwardFit& stated_;
  std::map<By, std::optional<FreedFit>> found_;
};

}  // namespace dualdamp::identify
