#include "tests/support/exponential_sum.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dualdamp::oracle {

namespace {

constexpr Real double_epsilon = 0x1p-52L;
/// Relative error of a term: 256 roundings of 2^-64 for the coefficient, the functions, products and sums; and 4 of
/// the argument z s.
constexpr Real term_error = 0x1p-56L;
constexpr Real argument_error = 0x1p-62L;
constexpr int taylor_terms = 30;
constexpr std::size_t max_nodes = 4;

/// 113 bits, because a divided difference loses some of them.
__extension__ using Quad = __float128;

struct QuadComplex {
  Quad re = 0;
  Quad im = 0;

  friend QuadComplex operator+(QuadComplex a, QuadComplex b) { return {a.re + b.re, a.im + b.im}; }
  /// Products of real numbers are frequent, and Quad is slow.
  friend QuadComplex operator*(QuadComplex a, QuadComplex b) {
    if (b.im == 0) return a * b.re;
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend QuadComplex operator*(QuadComplex a, Quad b) { return {a.re * b, a.im == 0 ? 0 : a.im * b}; }
};

using Row = std::array<QuadComplex, max_nodes>;
using Matrix = std::array<Row, max_nodes>;

/// Divided differences of z -> exp(z s) over the first 1, 2, ... nodes: the first row of exp(s A), A with the nodes
/// on its diagonal and ones above it (Opitz). exp(s A) is built from exp(h A), |z h| <= 1/16, by the binary digits
/// of s/h and a Taylor series for the rest. Entry (i, j) of every factor is at most t^(j-i)/(j-i)! max exp(Re z t),
/// and these bounds multiply like the matrices themselves: the relative error of the result against its bound is
/// below 32 roundings of Quad a product, doubled by each squaring: below 2^-60 for |z s| < 2^40.
class Chain {
 public:
  explicit Chain(const std::vector<LongComplex>& nodes) : count_(nodes.size()) {
    Real fastest = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      nodes_[i] = {static_cast<Quad>(nodes[i].real()), static_cast<Quad>(nodes[i].imag())};
      fastest = std::max(fastest, std::abs(nodes[i]));
    }
    exponent_ = fastest > 0 ? -4 - std::ilogb(fastest) - 1 : 0;
    Matrix first{};
    for (std::size_t i = 0; i < count_; ++i) first[i] = moved(unit(i), std::ldexp(Real(1), exponent_));
    powers_.push_back(first);
  }

  [[nodiscard]] std::vector<LongComplex> differences(Real s) {
    const auto whole = static_cast<std::uint64_t>(std::ldexp(s, -exponent_));
    Row row = moved(unit(0), s - std::ldexp(static_cast<Real>(whole), exponent_));
    for (std::size_t bit = 0; (whole >> bit) > 0; ++bit) {
      if (bit == powers_.size()) powers_.push_back(squared(powers_.back()));
      if ((whole >> bit) & 1U) row = times(row, powers_[bit]);
    }
    std::vector<LongComplex> result;
    for (std::size_t i = 0; i < count_; ++i) {
      result.emplace_back(static_cast<Real>(row[i].re), static_cast<Real>(row[i].im));
    }
    return result;
  }

 private:
  static Row unit(std::size_t i) {
    Row row{};
    row[i].re = 1;
    return row;
  }
  [[nodiscard]] Row times(const Row& row, const Matrix& matrix) const {
    Row result{};
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = i; j < count_; ++j) result[j] = result[j] + row[i] * matrix[i][j];
    }
    return result;
  }
  [[nodiscard]] Matrix squared(const Matrix& matrix) const {
    Matrix result{};
    for (std::size_t i = 0; i < count_; ++i) result[i] = times(matrix[i], matrix);
    return result;
  }
  /// row exp(s A), |z s| <= 1/16: 12 terms leave out less than 2^-60 of the bound.
  [[nodiscard]] Row moved(const Row& row, Real s) const {
    Row sum = row;
    Row term = row;
    for (int k = 1; k <= 12; ++k) {
      const Quad factor = static_cast<Quad>(s) / static_cast<Quad>(k);
      for (std::size_t j = count_; j-- > 0;) {
        QuadComplex next = term[j] * nodes_[j];
        if (j > 0) next = next + term[j - 1];
        term[j] = next * factor;
        sum[j] = sum[j] + term[j];
      }
    }
    return sum;
  }

  std::size_t count_;
  Row nodes_{};
  int exponent_ = 0;  ///< h is two to this
  std::vector<Matrix> powers_;
};

}  // namespace

struct ExponentialSum::Leaf {
  std::vector<int> elements;  ///< from the root of the chain to its end
  Chain chain;
};

ExponentialSum::ExponentialSum() = default;
ExponentialSum::ExponentialSum(ExponentialSum&&) noexcept = default;
ExponentialSum::~ExponentialSum() = default;

int ExponentialSum::add(LongComplex exponent, LongComplex coefficient, int parent) {
  Element element{exponent, parent};
  element.coefficients[0] = coefficient;
  element.sizes[0] = std::abs(coefficient);
  elements_.push_back(element);
  if (parent != no_parent) elements_[static_cast<std::size_t>(parent)].leaf = false;
  return static_cast<int>(elements_.size()) - 1;
}

void ExponentialSum::finish(int zeros) {
  zeros_ = zeros;
  for (const Element& e : elements_) {
    rate_ = std::max(rate_, std::abs(e.exponent));
    turning_ = std::max({turning_, std::abs(e.exponent.imag()), e.exponent.real()});
  }
  for (std::size_t order = 1; order <= highest; ++order) {
    for (Element& e : elements_) {
      e.coefficients[order] = e.exponent * e.coefficients[order - 1];
      e.sizes[order] = std::abs(e.exponent) * e.sizes[order - 1];
    }
    for (const Element& e : elements_) {
      if (e.parent == no_parent) continue;
      Element& parent = elements_[static_cast<std::size_t>(e.parent)];
      parent.coefficients[order] += e.coefficients[order - 1];
      parent.sizes[order] += e.sizes[order - 1];
    }
  }
  for (Element& e : elements_)
    e.silent = std::all_of(e.sizes.begin(), e.sizes.end(), [](Real x) { return x == 0; });
  find_leaves();
  if (zeros_ == 0) return;
  edge_ = rate_ > 0 ? Real(0.5) / rate_ : std::numeric_limits<Real>::infinity();
  expand();
}

void ExponentialSum::find_leaves() {
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (!elements_[k].leaf || elements_[k].parent == no_parent) continue;
    std::vector<int> path;
    for (int i = static_cast<int>(k); i != no_parent; i = elements_[static_cast<std::size_t>(i)].parent) {
      path.push_back(i);
    }
    std::reverse(path.begin(), path.end());
    std::vector<LongComplex> nodes;
    for (const int i : path) nodes.push_back(elements_[static_cast<std::size_t>(i)].exponent);
    leaves_.push_back({path, Chain(nodes)});
  }
}

/// Taylor coefficients at s = 0.
void ExponentialSum::expand() {
  std::vector<LongComplex> c;
  std::vector<Real> sizes;
  for (const Element& e : elements_) {
    c.push_back(e.coefficients[0]);
    sizes.push_back(e.sizes[0]);
  }
  Real factorial = 1;
  for (int k = 0; k < taylor_terms; ++k) {
    Real sum = 0;
    Real size = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (elements_[i].parent != no_parent) continue;
      sum += c[i].real();
      size += sizes[i];
    }
    taylor_.push_back(k < zeros_ ? Real(0) : sum / factorial);
    taylor_sizes_.push_back(size / factorial);
    factorial *= Real(k + 1);
    const std::vector<LongComplex> before = c;
    const std::vector<Real> sizes_before = sizes;
    for (std::size_t i = 0; i < c.size(); ++i) {
      c[i] *= elements_[i].exponent;
      sizes[i] *= std::abs(elements_[i].exponent);
    }
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (elements_[i].parent == no_parent) continue;
      c[static_cast<std::size_t>(elements_[i].parent)] += before[i];
      sizes[static_cast<std::size_t>(elements_[i].parent)] += sizes_before[i];
    }
  }
}

const std::vector<LongComplex>& ExponentialSum::values(Real s) const {
  std::vector<LongComplex>& result = last_values_;
  if (s == last_s_ && !result.empty()) return result;
  last_s_ = s;
  result.assign(elements_.size(), 0);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& e = elements_[k];
    if (e.parent != no_parent) continue;
    const Real size = std::exp(e.exponent.real() * s);
    const Real angle = e.exponent.imag() * s;
    result[k] = {size * std::cos(angle), size * std::sin(angle)};
  }
  for (Leaf& leaf : leaves_) {
    const std::vector<LongComplex> differences = leaf.chain.differences(s);
    for (std::size_t i = 1; i < leaf.elements.size(); ++i) {
      result[static_cast<std::size_t>(leaf.elements[i])] = differences[i];
    }
  }
  return result;
}

std::vector<LongComplex> ExponentialSum::columns(Real s, int order) const {
  std::vector<LongComplex> derivative = values(s);
  for (int i = 0; i < order; ++i) {
    // Children come after their parents.
    for (std::size_t k = derivative.size(); k-- > 0;) {
      derivative[k] *= elements_[k].exponent;
      if (elements_[k].parent != no_parent)
        derivative[k] += derivative[static_cast<std::size_t>(elements_[k].parent)];
    }
  }
  return derivative;
}

/// sum of the bounds of |c_k^(order)| max |E_k| over [a, b]; of a chain |E_k| <= s^n/n! max exp(Re z s).
Real ExponentialSum::bound(Real a, Real b, int order) const {
  Real sum = 0;
  for (const Element& e : elements_) {
    const Real size = e.sizes[static_cast<std::size_t>(order)];
    if (size == 0) continue;
    Real growth = e.exponent.real();
    Real power = 1;
    int n = 0;
    for (int p = e.parent; p != no_parent; p = elements_[static_cast<std::size_t>(p)].parent) {
      growth = std::max(growth, elements_[static_cast<std::size_t>(p)].exponent.real());
      power *= b / Real(++n);
    }
    sum += size * power * std::exp(growth * (growth > 0 ? b : a));
  }
  return sum;
}

ExponentialSum::Known ExponentialSum::known(Real s) const {
  Known result;
  const std::vector<LongComplex>& e = values(s);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const Element& element = elements_[k];
    if (element.silent) continue;
    const Real modulus = std::abs(e[k]) * (term_error + argument_error * std::abs(element.exponent) * s);
    for (std::size_t order = 0; order < orders; ++order) {
      result.jet[order] += (element.coefficients[order] * e[k]).real();
      result.error[order] += element.sizes[order] * modulus;
    }
  }
  if (leaves_.empty()) return result;
  for (std::size_t order = 0; order < orders; ++order) {
    result.error[order] += 0x1p-60L * bound(s, s, static_cast<int>(order));
  }
  return result;
}

ExponentialSum::Known ExponentialSum::quotient(Real s) const {
  Known result;
  const auto zeros = static_cast<std::size_t>(zeros_);
  for (std::size_t order = 0; order < orders; ++order) {
    Real power = 1;
    for (std::size_t k = order; k + zeros < taylor_.size(); ++k) {
      for (std::size_t i = 0; i < order; ++i) power *= Real(k - i);
      result.jet[order] += taylor_[k + zeros] * power;
      // Left out beyond thirty terms: less than 1/2^20/25! of the first.
      result.error[order] += term_error * taylor_sizes_[k + zeros] * power;
      for (std::size_t i = 0; i < order; ++i) power /= Real(k - i);
      power *= s;
    }
  }
  return result;
}

ExponentialSum::Jet ExponentialSum::jet(Real s) const {
  if (!near_start(s)) return known(s).jet;
  // (s^n q)^(k) = sum binomial(k, j) (s^n)^(j) q^(k-j)
  const Jet q = quotient(s).jet;
  Jet result{};
  for (int k = 0; k < orders; ++k) {
    Real factor = 1;  // binomial(k, j) times the falling factorial of n
    for (int j = 0; j <= std::min(k, zeros_); ++j) {
      result[static_cast<std::size_t>(k)] += factor * std::pow(s, zeros_ - j) * q[static_cast<std::size_t>(k - j)];
      factor *= Real((k - j) * (zeros_ - j)) / Real(j + 1);
    }
  }
  return result;
}

/// The denominator of a level; near the start divided by s^zeros.
Real ExponentialSum::unit(Real s) const {
  Real sum = 0;
  if (zeros_ > 0 && rate_ == 0) {
    for (std::size_t k = taylor_sizes_.size(); k-- > static_cast<std::size_t>(zeros_);) {
      sum = sum * s + taylor_sizes_[k];
    }
    return 16 * double_epsilon * sum;
  }
  const bool factored = near_start(s);
  const std::vector<LongComplex>& e = values(factored ? 1 / rate_ : s);
  for (std::size_t k = 0; k < elements_.size(); ++k) sum += elements_[k].sizes[0] * std::abs(e[k]);
  sum *= double_epsilon * (16 + turning_ * s);
  return factored ? sum * std::pow(rate_, zeros_) : sum;
}

Real ExponentialSum::rounding(Real s) const { return near_start(s) ? unit(s) * std::pow(s, zeros_) : unit(s); }

Real ExponentialSum::level(Real s) const { return (near_start(s) ? quotient(s) : known(s)).jet[0] / unit(s); }

/// Walks the cells from left to right.
class ExponentialSum::Scan {
 public:
  explicit Scan(const ExponentialSum& f) : f_(f) {}

  Account account;

  void begin(Real horizon) {
    // At the edge the part that was subtracted for the known zeros is added again: a few hundredths of a level.
    const Real edge = std::min(f_.edge_, horizon);
    factored_ = f_.zeros_ > 0;
    if (factored_) scan(0, edge, 0);
    factored_ = false;
    if (edge < horizon) scan(f_.zeros_ > 0 ? edge * (1 + 0x1p-60L) : 0, horizon, 0);
  }

 private:
  [[nodiscard]] Known at(Real s) const { return factored_ ? f_.quotient(s) : f_.known(s); }
  void scan(Real a, Real b, int depth);
  void note(Real s) {
    if (!account.knots.empty() && account.knots.back().s == s) return;
    account.knots.push_back({s, at(s).jet[0] / f_.unit(s)});
  }
  [[nodiscard]] Real fifth(Real a, Real b) const;
  void note_extremum(Real a, Real b);

  const ExponentialSum& f_;
  bool factored_ = false;  ///< the cells are of f/s^zeros
};

/// Bound of the fifth derivative; (f/s^n)^(5) = 5!/(5+n)! f^(5+n) at places between 0 and s.
Real ExponentialSum::Scan::fifth(Real a, Real b) const {
  if (!factored_) return f_.bound(a, b, orders);
  Real result = f_.bound(0, b, orders + f_.zeros_);
  for (int i = 1; i <= f_.zeros_; ++i) result /= Real(orders + i);
  return result;
}

void ExponentialSum::Scan::scan(Real a, Real b, int depth) {
  ++account.cells;
  const Real m = (a + b) / 2;
  const Real r = (b - a) / 2;
  const Known k = at(m);
  const Jet& j = k.jet;
  const Jet& e = k.error;
  const Real rest = fifth(a, b) * r * r * r / 6;  // of f''
  const Real value_move =
      r * (std::abs(j[1]) + r / 2 * (std::abs(j[2]) + r / 3 * (std::abs(j[3]) + r / 4 * std::abs(j[4])))) +
      rest * r * r / 20 + e[0] + r * (e[1] + r * (e[2] + r * (e[3] + r * e[4])));
  const Real slope_move = r * (std::abs(j[2]) + r / 2 * (std::abs(j[3]) + r / 3 * std::abs(j[4]))) + rest * r / 4 +
                          e[1] + r * (e[2] + r * (e[3] + r * e[4]));
  const Real bend_move = r * (std::abs(j[3]) + r / 2 * std::abs(j[4])) + rest + e[2] + r * (e[3] + r * e[4]);
  // The unit of levels varies over the cell: at most by the growth of the terms' moduli, taken from their bound.
  const Real largest_unit = factored_ ? f_.unit(b) : double_epsilon * (16 + f_.turning_ * b) * f_.bound(a, b, 0);
  if (std::abs(j[0]) - value_move > clear * largest_unit) {
    account.knots.push_back({m, j[0] / f_.unit(m)});
  } else if (std::abs(j[1]) > slope_move || value_move <= f_.unit(m) / 64) {
    note(a);
    note(b);
  } else if (std::abs(j[2]) > bend_move) {
    note(a);
    note_extremum(a, b);
    note(b);
  } else if (depth < 80) {
    scan(a, m, depth + 1);
    scan(m, b, depth + 1);
  } else {
    account.complete = false;
  }
}

/// The root of f' on a cell where f'' has one sign, if there is one, by Newton's method with bisection.
void ExponentialSum::Scan::note_extremum(Real a, Real b) {
  const Real first = at(a).jet[1];
  if (first * at(b).jet[1] >= 0) return;
  Real low = a;
  Real high = b;
  Real s = (a + b) / 2;
  for (int i = 0; i < 100; ++i) {
    const Jet j = at(s).jet;
    ((j[1] > 0) == (first > 0) ? low : high) = s;
    Real next = s - j[1] / j[2];
    if (!(next > low && next < high)) next = (low + high) / 2;
    const Real step = std::abs(next - s);
    s = next;
    if (step <= 0x1p-58L * s) break;
  }
  if (s > a && s < b) note(s);
}

ExponentialSum::Account ExponentialSum::account(Real horizon) const {
  Scan scan(*this);
  scan.begin(horizon);
  return scan.account;
}

Real ExponentialSum::root(const Knot& left, const Knot& right) const {
  Real low = left.s;
  Real high = right.s;
  Real s = (low + high) / 2;
  for (int i = 0; i < 200 && high - low > 0x1p-62L * high; ++i) {
    const Jet j = jet(s);
    ((j[0] > 0) == (left.level > 0) ? low : high) = s;
    Real next = s - j[0] / j[1];
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - s) <= 0x1p-63L * s) break;
    s = next;
  }
  return s;
}

std::optional<Real> ExponentialSum::first_crossing(Real horizon) const {
  const std::vector<Knot> knots = account(horizon).knots;
  std::size_t positive = 0;  // the last knot above zero
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i].level > 0) positive = i;
    if (knots[i].level < -4) return root(knots[positive], knots[positive + 1]);
  }
  return std::nullopt;
}

}  // namespace dualdamp::oracle
