#pragma once
/// Closed-form motion of one mode:  m x'' + C x' + K x = f(s),
///     f(s) = sum_n polynomial_n s^n/n! + sum_i transient_i exp(-decay_i s) + Re sum_j phasor_j exp(i w_j s)  [N].
///
/// C [N.s/m] and K [N/m] may have any sign or be zero. The basis of exponentials is laid out once for (m, C, K, w);
/// each interval then only solves for coefficients.
///
/// Close exponents: an exponent of f may lie close to one of the oscillator's own (resonance with little damping,
/// vanishing stiffness), or the oscillator's two may lie close to each other (critical damping). The solution is
/// then a sum of divided differences over these exponents, so that nothing cancels. Exponents far from each other
/// are never on one chain: the derivatives of the chain would cancel, and their bounds would be useless.
///
/// Brief modes: if the mode is used for times that are short beside the oscillator's own times, no exponents are
/// far from each other. All are then on one chain, whose elements are the responses to powers of time.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "core/crossing/exponential_basis.hpp"

namespace dualdamp::sim {

/// The right-hand side of a mode, relative to the start of the interval.
struct ModeForcing {
  std::array<double, 4> polynomial{};    ///< derivatives [N/s^n]; zero beyond the degree of the mode
  std::vector<core::Complex> phasors{};  ///< N, one for each frequency of the mode, or none
  std::vector<double> transients{};      ///< N, one for each decay of the mode, or none
};

class LinearMode {
 public:
  /// What determines a mode besides m, C, K and the frequencies.
  struct Layout {
    int degree = 0;         ///< the highest power of s in the forcing, 0 to 3
    bool is_brief = false;  ///< only for times up to 1/(|C|/m + sqrt(|K|/m)), and without frequencies
    std::vector<double> decays = {};

    friend auto operator<=>(const Layout&, const Layout&) = default;
  };
  LinearMode(double mass, double damping, double stiffness, std::span<const double> frequencies, Layout layout);

  [[nodiscard]] const core::ExponentialBasis& basis() const { return basis_; }
  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] int degree() const { return layout_.degree; }
  [[nodiscard]] double damping() const { return damping_; }
  [[nodiscard]] double stiffness() const { return stiffness_; }
  [[nodiscard]] const std::vector<double>& decays() const { return layout_.decays; }

  /// The element exp(i w_j s) of frequency j.
  [[nodiscard]] int harmonic_element(std::size_t j) const { return harmonics_[j].source; }

  /// x(s) with x(0) = x0, x'(0) = v0.
  void solve(const ModeForcing& forcing, double x0, double v0, core::ModeFunction& x) const;
  /// f(s) itself.
  void represent(const ModeForcing& forcing, core::ModeFunction& f) const;
  /// d(x, v)(s) / d(x, v)(0), from the elements' values at s.
  [[nodiscard]] Eigen::Matrix2d propagator(const core::ExponentialBasis::Values& values) const;
  /// (x, v)(s) from rest at zero under a unit constant force (`source` = 0) or a unit of transient `source` - 1.
  [[nodiscard]] Eigen::Vector2d response(std::size_t source, const core::ExponentialBasis::Values& values) const;

 private:
  /// The oscillator's own exponents to which an exponent of the forcing lies close.
  enum class Near { none, first, second, both };

  /// The particular solution for a forcing exp(z s): `gain` times one element.
  struct Driven {
    int source = 0;  ///< the element exp(z s) or s^n/n! of the forcing
    int target = 0;  ///< element of the particular solution: `source`, or a divided difference over `near` too
    core::Complex gain;
    Near near = Near::none;
  };

  /// The two elements of the own motion.
  enum class OwnForm {
    oscillating,  ///< underdamped: one complex exponential
    decaying,     ///< overdamped, or a negative stiffness: two real exponentials
    chain,        ///< two nearly equal exponents: exponential and divided difference
  };

  void build_own_motion();
  void build_powers();
  [[nodiscard]] double expected_reversal(std::span<const double> frequencies) const;
  [[nodiscard]] bool close(core::Complex z, core::Complex own, double slow) const;
  [[nodiscard]] Near near_own(core::Complex z, double slow) const;
  Driven drive(core::Complex z, int source, double slow);

  core::ExponentialBasis basis_;
  double mass_;
  double damping_;
  double stiffness_;
  Layout layout_;
  double fastest_drive_ = 0.0;  ///< rad/s
  core::Complex first_;         ///< the oscillator's own exponents
  core::Complex second_;
  OwnForm own_form_ = OwnForm::oscillating;
  double inverse_gap_ = 0.0;    ///< 1/Im first_ or 1/(first_ - second_); unused for a chain [s]
  int own_first_ = 0;           ///< exp(first_ s)
  int own_second_ = -1;         ///< exp(second_ s), or the divided difference; unused if oscillating
  std::vector<Driven> powers_;  ///< s^n/n!
  std::vector<Driven> harmonics_;
  std::vector<Driven> transients_;
};

}  // namespace dualdamp::sim
