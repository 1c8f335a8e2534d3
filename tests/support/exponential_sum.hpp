#pragma once
/// An independent account of the signs of  f(s) = Re sum c_k E_k(s)  on an interval, proved by bounds in extended
/// precision. It shares no code with the library.
///
/// On a cell of half width r about m the Taylor polynomial of degree four, the bound of the fifth derivative from
/// the moduli and a bound of all rounding errors enclose f, f' and f''. If f stays away from zero, the cell is
/// done. If f is monotone, the cell is cut at its ends; if f is convex or concave, it is cut at its extremum.
/// Otherwise it is halved, until f varies by less than a 64th of a rounding on it. Every root and every extremum
/// near zero lies in such a cell, so none is missed.
///
/// Precision. Plain exponentials in long double (64 bits): each term of f errs by less than 256 roundings and 4 |z
/// s| more, which are added to the enclosures. Divided differences in 113 bits. The rounding of double precision,
/// in which the search under test works, is 2048 times coarser.

#include <array>
#include <complex>
#include <optional>
#include <vector>

namespace dualdamp::oracle {

using Real = long double;
using LongComplex = std::complex<Real>;

/// A point of the account. Levels are values in units of the rounding that the search allows itself:
/// f / ((16 eps + eps max|Im z| s) sum |c_k E_k(s)|), eps of double. With n known zeros at s = 0 the denominator
/// for s <= T/2, T = 1/max|z|, is that at T times (s/T)^n; for polynomials, without such a T, their terms of order
/// n and above.
struct Knot {
  Real s = 0;
  Real level = 0;
};

class ExponentialSum {
 public:
  ExponentialSum();
  ExponentialSum(ExponentialSum&&) noexcept;
  ~ExponentialSum();

  static constexpr int no_parent = -1;
  static constexpr int orders = 5;
  /// f, f', f'', f''', f''''
  using Jet = std::array<Real, orders>;

  /// Levels beyond this are clear of zero.
  static constexpr Real clear = 8;

  /// Appends c E, E = exp(z s) or a divided difference on top of `parent`; returns its index.
  int add(LongComplex exponent, LongComplex coefficient, int parent = no_parent);
  /// Call once after the last add(). f and its derivatives up to order zeros - 1 vanish at s = 0; the rounding
  /// errors in them are subtracted while (fastest |z|) s <= 1/2.
  void finish(int zeros = 0);

  [[nodiscard]] Jet jet(Real s) const;
  [[nodiscard]] Real at(Real s) const { return jet(s)[0]; }
  [[nodiscard]] Real level(Real s) const;
  /// E_k^(order)(s) of all elements: the derivative of f^(order)(s) by c_k.
  [[nodiscard]] std::vector<LongComplex> columns(Real s, int order) const;
  /// The denominator of a level.
  [[nodiscard]] Real rounding(Real s) const;
  /// The largest |z_k|.
  [[nodiscard]] Real rate() const { return rate_; }

  struct Account {
    /// From 0 to the horizon. Between neighbours the level is between theirs, within a 64th, or it is beyond
    /// `clear` like theirs.
    std::vector<Knot> knots{};
    long cells = 0;
    bool complete = true;  ///< false when a cell could not be decided
  };
  [[nodiscard]] Account account(Real horizon) const;
  /// The root between two neighbours of opposite signs.
  [[nodiscard]] Real root(const Knot& left, const Knot& right) const;
  /// The first root behind which the level falls below -4: a crossing that is certain.
  [[nodiscard]] std::optional<Real> first_crossing(Real horizon) const;

 private:
  class Scan;
  static constexpr int highest = 8;  ///< derivatives held: `orders` and three known zeros
  struct Element {
    LongComplex exponent;
    int parent = no_parent;
    bool leaf = true;
    bool silent = false;                                  ///< in f and all its derivatives
    std::array<LongComplex, highest + 1> coefficients{};  ///< of f, f', f'', ...
    std::array<Real, highest + 1> sizes{};                ///< bounds of their moduli and of those of their terms
  };
  /// Derivatives and bounds of their errors.
  struct Known {
    Jet jet{};
    Jet error{};
  };

  struct Leaf;

  void find_leaves();
  void expand();
  /// E_k(s), until the next call.
  [[nodiscard]] const std::vector<LongComplex>& values(Real s) const;
  [[nodiscard]] Real bound(Real a, Real b, int order) const;
  [[nodiscard]] bool near_start(Real s) const { return s <= edge_; }
  [[nodiscard]] Known known(Real s) const;
  /// Of f/s^zeros, near the start.
  [[nodiscard]] Known quotient(Real s) const;
  [[nodiscard]] Real unit(Real s) const;

  std::vector<Element> elements_;
  mutable std::vector<Leaf> leaves_;  ///< the chains and the powers they have needed so far
  mutable Real last_s_ = 0;           ///< value, slope and unit are often needed at the same place
  mutable std::vector<LongComplex> last_values_;
  std::vector<Real> taylor_;        ///< f^(k)(0)/k!
  std::vector<Real> taylor_sizes_;  ///< bounds of the sums of their terms' moduli
  Real rate_ = 0;
  Real turning_ = 0;
  int zeros_ = 0;
  Real edge_ = -1;  ///< up to this s the known zeros are factored out
};

}  // namespace dualdamp::oracle
