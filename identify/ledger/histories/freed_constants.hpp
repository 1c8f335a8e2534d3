#pragma once
/// Fits of histories with the mass, the stiffness, the zero of x or its delay unknown, beside the fit with all as
/// stated.

#include <Eigen/Core>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "identify/ledger/histories/history_relaxations.hpp"
#include "identify/methods/histories/forward_fit.hpp"

namespace dualdamp::identify {

/// A fit with one constant unknown.
struct FreedFit {
  Eigen::VectorXd p;    ///< in the layout of the fit as stated
  double change = 0.0;  ///< of the constant; of the mean zero over the length of the layout; of the delay [s]
  double missed = 0.0;  ///< share of the motion, as below
};

/// Each fit is made once, when it is asked for.
class FreedConstants {
 public:
  using Kind = FreedPart::Kind;
  using By = SampledOscillator::By;

  /// All are references: they outlive this.
  FreedConstants(const Record& record, const KnownConstants& constants, ForwardFit& stated)
      : record_(record), constants_(constants), stated_(stated) {}

  /// The fit with this part unknown; null if there is none. The zero and the delay of x have one in driven
  /// histories of which the fit as stated misses much: else steps lead from there.
  [[nodiscard]] const FreedFit* with(const FreedPart& part);

  /// The one that comes much nearer to the motion than the fit as stated, which misses a good part of it; else
  /// null.
  [[nodiscard]] const FreedFit* much_nearer();

  /// Why the fits tell nothing: they miss the motion, whatever of these is unknown. Empty otherwise.
  [[nodiscard]] std::string fault();

 private:
  [[nodiscard]] const FreedFit* best(std::initializer_list<Kind> kinds);
  [[nodiscard]] double missed_as_stated();
  [[nodiscard]] std::optional<FreedFit> with_constant(By by);
  [[nodiscard]] std::optional<FreedFit> with_zero();
  [[nodiscard]] std::optional<FreedFit> with_delay();
  [[nodiscard]] std::optional<FreedFit> fitted(const Record& record, const KnownConstants& constants);

  const Record& record_;
  const KnownConstants& constants_;
  ForwardFit& stated_;
  std::optional<double> missed_;  ///< by the fit as stated
  std::map<std::pair<Kind, By>, std::optional<FreedFit>> found_;
};

}  // namespace dualdamp::identify
