#pragma once
/// Fits one mechanism to the estimates of straight lines through parts of x-Y data.
///
/// The engines repeat the test: steady states at the input levels, then the least-squares line of
/// `resonance_least_squares` through the lower parts of them. Unknowns are F0, c, the mechanism's parameters and,
/// where the levels are not known, the first of them and their spacing:
///
///   chi2 = sum over parts of ((zeta - zeta_i)/std)^2 + ((F0 - F0_i)/std)^2
///
/// A weak pull towards the start of a search, which is not part of chi2, holds parameters that do not change the
/// numbers. Levenberg-Marquardt (`identify/statistics/least_squares.hpp`) with derivatives by differences, within
/// bounds, among motions that never stick, since sticks show in the record of a test. Cost: some hundred tests of
/// as many steady states as there are levels.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bench/departure_names.hpp"
#include "bench/mechanisms.hpp"
#include "core/outcome.hpp"
#include "identify/record.hpp"
#include "sim/orbits/steady_state_near.hpp"

namespace dualdamp::bench {

/// Input and output amplitudes [m].
struct Levels {
  std::vector<double> Y;
  std::vector<double> x;
};

/// The estimate from one part of the data.
struct PartReading {
  double zeta = 0.0;
  double F0 = 0.0;  ///< N
};

/// The lines through the lower parts of the levels, as `resonance_least_squares` draws them through pairs that do
/// not stick. Nothing where one of them does not rise.
[[nodiscard]] std::optional<std::vector<PartReading>> read_parts(const Levels& levels, const MechanismStudy& study,
                                                                 const identify::KnownConstants& constants);

/// zeta of the smallest part over that of the largest, less 1.
[[nodiscard]] double bend_of(const std::vector<PartReading>& readings);

/// Levels that reproduce the estimates of the study, with all outputs free. Nothing where no such levels are found
/// to a standard error of each number.
[[nodiscard]] std::optional<Levels> reconstruct(const MechanismStudy& study,
                                                const identify::KnownConstants& constants);

/// Output amplitudes of the mechanism at the input amplitudes Y; nothing where one has no steady state. `near`:
/// orbits of a test that differs little, near which the search begins; may be empty.
struct Response {
  std::vector<double> x;  ///< m
  bool sticks = false;    ///< at one of them at least
  std::vector<sim::SteadyState> orbits;
};
[[nodiscard]] std::optional<Response> response(const Departure& mechanism, const Apparatus& apparatus,
                                               const RigFriction& friction, std::span<const double> values,
                                               const std::vector<double>& Y,
                                               const std::vector<sim::KnownOrbit>& near = {});

struct MechanismFit {
  core::Outcome outcome;
  RigFriction friction;
  std::vector<double> values;  ///< of the mechanism's parameters, SI
  std::vector<bool> at_bound;  ///< of each of them: the search ended at a bound
  Levels levels;
  std::vector<PartReading> readings;
  double chi2 = 0.0;
  Eigen::VectorXd unknowns;  ///< for `refine`
};

/// Fits one mechanism. The study, the apparatus and the mechanism must outlive it.
class MechanismSearch {
 public:
  /// `near`: levels at which searches begin, or the known levels.
  MechanismSearch(const Departure& mechanism, const MechanismStudy& study, const Apparatus& apparatus, Levels near);

  /// Number of starts of the search for the mechanism's parameters.
  [[nodiscard]] std::size_t starts() const;
  /// A rough fit from one start.
  [[nodiscard]] MechanismFit begin(std::size_t start) const;
  /// The fine fit from a rough one.
  [[nodiscard]] MechanismFit refine(const MechanismFit& rough) const;

  /// Number of unknowns of the fit, and of the estimates that it must reproduce.
  [[nodiscard]] std::size_t unknowns() const { return static_cast<std::size_t>(first_parameter()) + parameters(); }
  [[nodiscard]] std::size_t numbers() const { return 2 * study_.estimates.size(); }

 private:
  struct Point {
    RigFriction friction;
    std::vector<double> values;
    std::vector<double> Y;
  };

  /// The last test that was computed without known orbits; the orbits for its derivatives are sought near its
  /// orbits.
  struct LastTest {
    Eigen::VectorXd p{};
    std::vector<sim::KnownOrbit> near{};
  };

  // The unknowns are numbers of order one: F0 and c over those of the study, first level and spacing over those of
  // `near_`, and the parameters over their scales, as logarithms where they cannot vanish.
  [[nodiscard]] bool levels_are_free() const { return study_.amplitudes.empty(); }
  [[nodiscard]] Eigen::Index first_parameter() const { return levels_are_free() ? 4 : 2; }
  [[nodiscard]] std::size_t parameters() const { return mechanism_.parameters.size(); }
  [[nodiscard]] Point point(const Eigen::VectorXd& p) const;
  [[nodiscard]] std::optional<Response> outputs(const Eigen::VectorXd& p, LastTest& last) const;
  [[nodiscard]] Eigen::VectorXd bounds(bool high) const;
  [[nodiscard]] Eigen::VectorXd start(std::size_t number) const;
  /// Residuals that pull p towards the first start.
  [[nodiscard]] Eigen::VectorXd pull(const Eigen::VectorXd& p) const;
  [[nodiscard]] MechanismFit fit(const Eigen::VectorXd& start, double tolerance) const;

  const Departure& mechanism_;
  const MechanismStudy& study_;
  const Apparatus& apparatus_;
  Levels near_;
};

}  // namespace dualdamp::bench
