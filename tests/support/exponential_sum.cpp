#include "tests/support/exponential_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dualdamp::oracle {

namespace {

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
constexpr int max_nodes = 6;
constexpr int taylor_terms = 30;

using Matrix = std::array<std::array<LongComplex, max_nodes>, max_nodes>;

Matrix product(const Matrix& a, const Matrix& b, int n) {
  Matrix c{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    for (std::size_t j = i; j < static_cast<std::size_t>(n); ++j) {
      for (std::size_t k = i; k <= j; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

/// sinh(w)/w
LongComplex sinhc(LongComplex w) {
  if (std::abs(w) > Real(0.5)) return std::sinh(w) / w;
  LongComplex term = 1;
  LongComplex sum = 1;
  for (int k = 1; k < 14; ++k) {
    term *= w * w / Real(2 * k * (2 * k + 1));
    sum += term;
  }
  return sum;
}

/// Divided difference of exp(z s) by Opitz' matrix; two nodes in closed form.
LongComplex divided(const std::array<LongComplex, max_nodes>& nodes, int n, Real s) {
  if (s == 0) return n == 1 ? 1 : 0;
  if (n == 1) return std::exp(nodes[0] * s);
  if (n == 2) return s * std::exp((nodes[0] + nodes[1]) * (s / 2)) * sinhc((nodes[0] - nodes[1]) * (s / 2));
  Real norm = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) norm = std::max(norm, std::abs(nodes[i]) * s + s);
  const int squarings = static_cast<int>(std::ceil(std::log2(norm)));
  const Real h = std::ldexp(s, -squarings);
  Matrix a{};
  Matrix power{};
  Matrix sum{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    a[i][i] = nodes[i] * h;
    if (i + 1 < static_cast<std::size_t>(n)) a[i][i + 1] = h;
    power[i][i] = sum[i][i] = 1;
  }
  for (int k = 1; k < 24; ++k) {
    power = product(power, a, n);
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      for (std::size_t j = i; j < static_cast<std::size_t>(n); ++j) sum[i][j] += power[i][j] /= Real(k);
    }
  }
  for (int k = 0; k < squarings; ++k) sum = product(sum, sum, n);
  return sum[0][static_cast<std::size_t>(n - 1)];
}

}  // namespace

int ExponentialSum::add(LongComplex exponent, LongComplex coefficient, int parent) {
  Element element{exponent, parent};
  element.coefficients[0] = coefficient;
  elements_.push_back(element);
  return static_cast<int>(elements_.size()) - 1;
}

void ExponentialSum::finish(int zeros) {
  zeros_ = zeros;
  rate_ = 0;
  for (const Element& e : elements_) rate_ = std::max(rate_, std::abs(e.exponent));
  for (std::size_t order = 1; order < orders; ++order) {
    for (Element& e : elements_) e.coefficients[order] = e.exponent * e.coefficients[order - 1];
    for (const Element& e : elements_) {
      if (e.parent == no_parent) continue;
      elements_[static_cast<std::size_t>(e.parent)].coefficients[order] += e.coefficients[order - 1];
    }
  }
  std::vector<LongComplex> c;
  for (const Element& e : elements_) c.push_back(e.coefficients[0]);
  Real factorial = 1;
  for (int k = 0; k < taylor_terms; ++k) {
    Real sum = 0;
    for (std::size_t i = 0; i < c.size(); ++i) sum += elements_[i].parent == no_parent ? c[i].real() : Real(0);
    taylor_.push_back(k < zeros ? Real(0) : sum / factorial);
    factorial *= Real(k + 1);
    const std::vector<LongComplex> before = c;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] *= elements_[i].exponent;
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (elements_[i].parent != no_parent) c[static_cast<std::size_t>(elements_[i].parent)] += before[i];
    }
  }
}

LongComplex ExponentialSum::value(const Element& element, Real s) const {
  std::array<LongComplex, max_nodes> nodes;
  int n = 0;
  for (const Element* e = &element;; e = &elements_[static_cast<std::size_t>(e->parent)]) {
    nodes[static_cast<std::size_t>(n++)] = e->exponent;
    if (e->parent == no_parent) break;
  }
  return divided(nodes, n, s);
}

ExponentialSum::Jet ExponentialSum::jet(Real s) const {
  Jet jet{};
  if (near_start(s)) {
    for (std::size_t order = 0; order < jet.size(); ++order) {
      Real power = 1;
      for (std::size_t k = order; k < taylor_.size(); ++k) {
        Real falling = 1;
        for (std::size_t i = 0; i < order; ++i) falling *= static_cast<Real>(k - i);
        jet[order] += falling * taylor_[k] * power;
        power *= s;
      }
    }
    return jet;
  }
  for (const Element& e : elements_) {
    const LongComplex v = value(e, s);
    for (std::size_t order = 0; order < jet.size(); ++order) jet[order] += (e.coefficients[order] * v).real();
  }
  return jet;
}

ExponentialSum::Jet ExponentialSum::quotient(Real s) const {
  Jet jet{};
  for (std::size_t order = 0; order < jet.size(); ++order) {
    Real power = 1;
    for (std::size_t k = order; k + static_cast<std::size_t>(zeros_) < taylor_.size(); ++k) {
      Real falling = 1;
      for (std::size_t i = 0; i < order; ++i) falling *= static_cast<Real>(k - i);
      jet[order] += falling * taylor_[k + static_cast<std::size_t>(zeros_)] * power;
      power *= s;
    }
  }
  return jet;
}

Real ExponentialSum::amplitude() const {
  Real sum = 0;
  for (const Element& e : elements_) sum += std::abs(e.coefficients[0]);
  return sum;
}

Real ExponentialSum::bound(Real a, Real b, int order) const {
  Real sum = 0;
  for (const Element& e : elements_) {
    Real growth = e.exponent.real();
    Real power = 1;
    int n = 0;
    for (int p = e.parent; p != no_parent; p = elements_[static_cast<std::size_t>(p)].parent) {
      growth = std::max(growth, elements_[static_cast<std::size_t>(p)].exponent.real());
      power *= b / Real(++n);
    }
    sum +=
        std::abs(e.coefficients[static_cast<std::size_t>(order)]) * power * std::exp(growth * (growth > 0 ? b : a));
  }
  return sum;
}

/// Walks the cells from left to right and keeps the story of the signs.
class ExponentialSum::Search {
 public:
  Search(const ExponentialSum& f, Real shallow) : f_(f), shallow_(shallow) {}

  Finding finding;

  void scan(Real a, Real b);
  void end(Real s) {
    if (below_) close_dip(s);
  }

 private:
  struct Cell {
    bool without_zero = false;
    bool monotone = false;
    Real least = 0;  ///< lower bound of |f| when without zero
    Real value = 0;
  };
  [[nodiscard]] Cell classify(Real a, Real b) const;
  void sample(Real value) {
    if (below_ && value < -shallow_) cross();
  }
  void cross() {
    finding.crossed = true;
    finding.s = start_;
  }
  void root(Real a, Real b);
  void close_dip(Real s);
  void touch(Real a, Real b);
  [[nodiscard]] Real minimum(Real a, Real b) const;

  const ExponentialSum& f_;
  Real shallow_;
  bool below_ = false;
  Real start_ = 0;  ///< where the present dip began
};

ExponentialSum::Search::Cell ExponentialSum::Search::classify(Real a, Real b) const {
  const Real m = (a + b) / 2;
  const Real r = (b - a) / 2;
  const bool quotient = f_.near_start(b);
  const Jet j = quotient ? f_.quotient(m) : f_.jet(m);
  Real fourth = f_.bound(a, b, quotient ? 4 + f_.zeros_ : 4);
  if (quotient) {
    for (int i = 0; i < f_.zeros_; ++i) fourth /= Real(5 + i);
  }
  const Real noise = 4 * epsilon * f_.bound(m, m, quotient ? f_.zeros_ : 0);
  const Real move = std::abs(j[1]) * r + std::abs(j[2]) * r * r / 2 + std::abs(j[3]) * r * r * r / 6 +
                    fourth * r * r * r * r / 24 + noise;
  Cell cell;
  cell.value = j[0];
  cell.least = std::abs(j[0]) - move;
  cell.without_zero = cell.least > 0;
  cell.monotone = std::abs(j[1]) > std::abs(j[2]) * r + std::abs(j[3]) * r * r / 2 + fourth * r * r * r / 6;
  return cell;
}

void ExponentialSum::Search::scan(Real a, Real b) {
  if (finding.crossed) return;
  ++finding.cells;
  if (f_.near_start(a) && !f_.near_start(b)) {
    const Real edge = Real(0.5) / f_.rate_;
    if (edge > a * (1 + 8 * epsilon)) {
      scan(a, edge * (1 - 2 * epsilon));
      scan(edge * (1 + 2 * epsilon), b);
      return;
    }
  }
  const Cell cell = classify(a, b);
  const bool factored = f_.near_start(b);
  if (cell.without_zero) {
    sample(factored ? -1 * Real(cell.value < 0) * 2 * shallow_ : cell.value);
    if (!factored && !below_ && cell.least <= shallow_ && !cell.monotone) touch(a, b);
  } else if (cell.monotone) {
    root(a, b);
  } else if (b - a <= 16 * epsilon * b) {
    if (!below_) finding.touches.push_back({(a + b) / 2, 0});
  } else {
    scan(a, (a + b) / 2);
    scan((a + b) / 2, b);
  }
}

void ExponentialSum::Search::root(Real a, Real b) {
  const bool quotient = f_.near_start(b);
  const auto jet = [&](Real s) { return quotient ? f_.quotient(s) : f_.jet(s); };
  const Real first = jet(a)[0];
  const Real last = jet(b)[0];
  sample(first);
  if (first * last >= 0 || finding.crossed) return;
  Real low = a;
  Real high = b;
  Real s = (a + b) / 2;
  for (int i = 0; i < 200 && high - low > 2 * epsilon * high; ++i) {
    const Jet j = jet(s);
    ((j[0] > 0) == (first > 0) ? low : high) = s;
    Real next = s - j[0] / j[1];
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - s) <= epsilon * s) break;
    s = next;
  }
  if (first > 0) {
    below_ = true;
    start_ = s;
    sample(f_.at(b));
  } else if (below_) {
    close_dip(s);
  }
}

/// The dip from start_ to s was not seen to be deep at the samples: look at its bottom.
void ExponentialSum::Search::close_dip(Real s) {
  below_ = false;
  const Real bottom = minimum(start_, s);
  const Real value = std::min(f_.at(bottom), f_.at(s));
  if (value < -shallow_) {
    cross();
  } else {
    finding.touches.push_back({bottom, value});
  }
}

void ExponentialSum::Search::touch(Real a, Real b) {
  if (f_.jet(a)[1] >= 0 || f_.jet(b)[1] < 0) return;
  const Real s = minimum(a, b);
  const Real value = f_.at(s);
  if (value <= shallow_) finding.touches.push_back({s, value});
}

Real ExponentialSum::Search::minimum(Real a, Real b) const {
  Real low = a;
  Real high = b;
  while (high - low > 4 * epsilon * high) {
    const Real m = (low + high) / 2;
    if (m <= low || m >= high) break;
    (f_.jet(m)[1] < 0 ? low : high) = m;
  }
  return (low + high) / 2;
}

ExponentialSum::Finding ExponentialSum::first_crossing(Real horizon, Real shallow) const {
  Search search(*this, shallow);
  search.scan(0, horizon);
  if (!search.finding.crossed) search.end(horizon);
  return search.finding;
}

}  // namespace dualdamp::oracle
