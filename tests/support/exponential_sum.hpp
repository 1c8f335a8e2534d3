#pragma once
/// An independent, slower search for the sign changes of  f(s) = Re sum c_k E_k(s)  in long double (64-bit
/// mantissa).
///
/// On a cell of half width r about m,  |f - T3(m)| <= M4 r^4/24  with T3 the cubic Taylor polynomial and M4 a bound
/// of the fourth derivative from the moduli. A cell is without a zero when |f(m)| exceeds all that the other terms
/// can do, monotone when |f'(m)| does; any other cell is halved. Long double rounds 2048 times finer than double,
/// so that dips which double precision takes for a contact are still told apart here.

#include <array>
#include <complex>
#include <vector>

namespace dualdamp::oracle {

using Real = long double;
using LongComplex = std::complex<Real>;

class ExponentialSum {
 public:
  static constexpr int no_parent = -1;
  /// f, f', f'', f''', f''''
  using Jet = std::array<Real, 5>;

  /// Appends c E, E = exp(z s) or a divided difference on top of `parent`; returns its index.
  int add(LongComplex exponent, LongComplex coefficient, int parent = no_parent);
  /// Call once after the last add(). f and its derivatives up to order zeros - 1 vanish at s = 0; what rounding
  /// left of them there is taken out.
  void finish(int zeros = 0);

  [[nodiscard]] Jet jet(Real s) const;
  [[nodiscard]] Real at(Real s) const { return jet(s)[0]; }
  /// sum |c_k|
  [[nodiscard]] Real amplitude() const;
  /// sum |c_k| max |E_k(s)|, of a chain by its bound s^n/n! exp(Re z s): double precision knows f to a few eps of
  /// it.
  [[nodiscard]] Real size(Real s) const { return bound(s, s, 0); }
  /// The largest |z_k|.
  [[nodiscard]] Real rate() const { return rate_; }
  [[nodiscard]] int known_zeros() const { return zeros_; }

  /// A minimum near zero: f there, of either sign.
  struct Touch {
    Real s = 0;
    Real value = 0;
  };
  struct Finding {
    bool crossed = false;
    Real s = 0;                    ///< the crossing from + to -
    std::vector<Touch> touches{};  ///< minima before it with |f| <= shallow
    long cells = 0;
  };
  /// The first crossing in (0, horizon) behind which f falls below -shallow; shallower dips are touches.
  [[nodiscard]] Finding first_crossing(Real horizon, Real shallow) const;

 private:
  class Search;
  static constexpr int orders = 8;
  struct Element {
    LongComplex exponent;
    int parent = no_parent;
    std::array<LongComplex, orders> coefficients{};  ///< of f, f', f'', ...
  };

  [[nodiscard]] LongComplex value(const Element& element, Real s) const;
  [[nodiscard]] Real bound(Real a, Real b, int order) const;
  [[nodiscard]] bool near_start(Real s) const { return zeros_ > 0 && rate_ * s <= Real(0.5); }
  /// Derivatives of f/s^zeros near the start.
  [[nodiscard]] Jet quotient(Real s) const;

  std::vector<Element> elements_;
  std::vector<Real> taylor_;  ///< f^(k)(0)/k!
  Real rate_ = 0;
  int zeros_ = 0;
};

}  // namespace dualdamp::oracle
