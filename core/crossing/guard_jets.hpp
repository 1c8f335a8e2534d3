#pragma once
/// A guard during one search: its value and first two derivatives at a time, and how much of the value is rounding.
///
/// Rounding of g at s is taken as (16 eps + eps max|Im z| s) times the sum of the guard's amplitudes |c_k E_k(s)|;
/// the second part comes from the angles z s. With n known zeros and s < T/2, T = 1/max|z|, it is the rounding at T
/// times (s/T)^n.
/// Close to a known zero at s = 0 the derivatives come from the Taylor series, which has that zero exactly.

#include <array>
#include <limits>

#include "core/crossing/guard.hpp"

namespace dualdamp::core {

/// A guard's value and first two derivatives at one time.
struct Jet {
  double s = 0.0;
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
  int zeros = 0;  ///< known order of the zero here
};

class GuardJets {
 public:
  GuardJets(const ExponentialBasis& basis, const Guard& guard) : basis_(basis), guard_(guard) {}

  /// The jet at s, from the values of the basis there.
  [[nodiscard]] Jet at(double s, const ExponentialBasis::Values& values) {
    Jet j;
    take(s, values, j);
    return j;
  }
  [[nodiscard]] Jet at(double s) {
    ExponentialBasis::Values values;
    if (!near_start(s)) basis_.evaluate(s, values);
    return at(s, values);
  }
  /// The jet at s, written in place: copying a jet that was just written stalls the processor.
  void take(double s, const ExponentialBasis::Values& values, Jet& j);
  /// The jet at s = 0, with the known zeros.
  [[nodiscard]] Jet at_begin() const;

  /// Allowed rounding of the value at s for amplitudes whose sum is `amplitude`.
  [[nodiscard]] double slack(double s, double amplitude) const {
    double allowance = (guard_rounding + std::numeric_limits<double>::epsilon() * basis_.turning() * s) * amplitude;
    const double angle = s * basis_.fastest();
    for (int i = 0; i < guard_.known_zeros && angle < taylor_angle; ++i) allowance *= angle;
    return allowance;
  }
  /// slack() for the sum of amplitudes at s: the rounding of the guard's value there. It decides what is a grazing.
  /// Costs an evaluation of the basis.
  [[nodiscard]] double rounding(double s) const;

  /// Whether s is so near a known zero that the Taylor series is used.
  [[nodiscard]] bool near_start(double s) const {
    return guard_.known_zeros > 0 && s * basis_.fastest() < taylor_angle;
  }

  [[nodiscard]] const ExponentialBasis& basis() const { return basis_; }
  [[nodiscard]] const Guard& guard() const { return guard_; }

 private:
  /// Up to this angle fastest() s the guard is its Taylor series near a known zero; the rest of the series is
  /// 0.5^18/18! of the guard's scale.
  static constexpr double taylor_angle = 0.5;
  static constexpr int taylor_terms = 18;

  void take_from_taylor_series(Jet& j);
  void take_with_growth(const ExponentialBasis::Values& values, Jet& j);

  const ExponentialBasis& basis_;
  const Guard& guard_;
  std::array<double, taylor_terms> taylor_;
  bool has_taylor_ = false;
};

inline void GuardJets::take(double s, const ExponentialBasis::Values& values, Jet& j) {
  j.s = s;
  j.zeros = 0;
  if (near_start(s)) return take_from_taylor_series(j);
  if (basis_.grows()) return take_with_growth(values, j);
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis_.size()); ++k) {
    value += guard_.value.re[k] * values.re[k] - guard_.value.im[k] * values.im[k];
    slope += guard_.slope.re[k] * values.re[k] - guard_.slope.im[k] * values.im[k];
    curvature += guard_.curvature.re[k] * values.re[k] - guard_.curvature.im[k] * values.im[k];
  }
  j.value = value;
  j.slope = slope;
  j.curvature = curvature;
}

inline Jet GuardJets::at_begin() const {
  Jet begin{0.0, at_start(basis_, guard_.value), at_start(basis_, guard_.slope), at_start(basis_, guard_.curvature),
            guard_.known_zeros};
  if (begin.zeros > 0) begin.value = 0.0;
  if (begin.zeros > 1) begin.slope = 0.0;
  if (begin.zeros > 2) begin.curvature = 0.0;
  return begin;
}

}  // namespace dualdamp::core
