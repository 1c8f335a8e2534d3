#pragma once
/// An interval's motion as functions on one basis of exponentials, and integrals of their products.
///
/// With f = Re sum c_j exp(z_j s) and g = Re sum d_k exp(z_k s)
///
///     int_0^T f g ds = 1/2 Re sum_jk [ c_j d_k I(z_j + z_k) + c_j conj(d_k) I(z_j + conj(z_k)) ],
///     I(z) = (e^{zT} - 1)/z,
///
/// where e^{zT} is a product of known values: those of the elements at the end. Chains of two exponents are covered
/// too: their integrals are divided differences of exp with a node at zero. The error is a few roundings of the
/// product of both sums of amplitudes. Cost: some ten flops for a pair of elements, no exponential function.

#include <array>

#include "core/crossing/exponential_basis.hpp"

namespace dualdamp::sim {

struct ClosedForm {
  /// Most elements of a basis; with more elements a quadrature is cheaper.
  static constexpr std::size_t largest = 12;

  const core::ExponentialBasis* basis = nullptr;  ///< with chains of at most two elements
  double duration = 0.0;                          ///< s
  core::ExponentialBasis::Values end;             ///< elements at the end of the interval
  core::ModeFunction x;                           ///< m
  core::ModeFunction v;                           ///< m/s
  core::ModeFunction a;                           ///< m/s^2
  core::ModeFunction y;                           ///< base [m]
  core::ModeFunction y_rate;                      ///< m/s
  core::ModeFunction force;                       ///< of friction [N]; 0 in a stick, where it does no work
  core::ModeFunction external;                    ///< N

  [[nodiscard]] static bool covers(const core::ExponentialBasis& basis);
  [[nodiscard]] double at_end(const core::ModeFunction& f) const { return core::evaluate(*basis, f, end); }
  /// An upper bound of the sum of the moduli of the terms of f at both ends of the interval: f is rounded as it.
  [[nodiscard]] double terms(const core::ModeFunction& f) const;
};

/// int f exp(-i omega s) ds over the whole interval.
[[nodiscard]] core::Complex integral_against_turn(const ClosedForm& form, const core::ModeFunction& f,
                                                  double omega);

/// int f g ds over the whole interval.
class ClosedIntegrals {
 public:
  explicit ClosedIntegrals(const ClosedForm& form);

  [[nodiscard]] double product(const core::ModeFunction& f, const core::ModeFunction& g) const;

 private:
  [[nodiscard]] double product_with_growth(const core::ModeFunction& f, const core::ModeFunction& g) const;

  static std::size_t pair(std::size_t j, std::size_t k) { return j * ClosedForm::largest + k; }
  [[nodiscard]] core::Complex end(std::size_t k) const { return {form_.end.re[k], form_.end.im[k]}; }

  [[nodiscard]] bool is_chain(std::size_t k) const {
    return form_.basis->parent(static_cast<int>(k)) != core::ExponentialBasis::no_parent;
  }
  void set_with_chain(std::size_t j, std::size_t k);

  const ClosedForm& form_;
  std::size_t size_;
  std::array<core::Complex, ClosedForm::largest * ClosedForm::largest> plain_;      ///< int E_j E_k, j <= k
  std::array<core::Complex, ClosedForm::largest * ClosedForm::largest> conjugate_;  ///< int E_j conj(E_k), j <= k
};

}  // namespace dualdamp::sim
