#include "tests/support/random_guards.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace dualdamp::test {

namespace {

using oracle::ExponentialSum;
using oracle::LongComplex;
using oracle::Real;
using Complex = std::complex<double>;

/// Draws the elements in the form of sim/linear_mode: own motion, constant, ramp, harmonics, decays, with chains
/// where exponents meet.
class BasisDraw {
 public:
  BasisDraw(Random& random, GuardCase& c) : random_(random), c_(c) {}

  void run() {
    own_motion();
    const int constant = add(0.0);
    const bool floating = c_.kind == OwnMotion::free_mass;
    const bool both = floating && random_.chance(0.5);
    if (floating) meet(constant, both);
    if (random_.chance(0.2)) {
      const int ramp = add(0.0, constant);
      if (floating) meet(ramp, both);
    }
    harmonics();
    if (random_.chance(0.3)) decays();
  }

 private:
  int add(Complex exponent, int parent = ExponentialSum::no_parent) {
    c_.elements.push_back({exponent, parent});
    return static_cast<int>(c_.elements.size()) - 1;
  }

  /// The source of a force beside one of the oscillator's own exponents, or both.
  void meet(int source, bool both) {
    const int first = add(first_, source);
    if (both) add(second_, first);
  }

  /// Damped contacts: their own decays are mostly much faster than the oscillator, and may meet it or each other.
  void decays() {
    const double fastest = random_.logarithmic(1.0, 1e6);
    for (int i = 1 + random_.pick(random_.chance(0.5) ? 2 : 12); i > 0; --i) {
      switch (random_.pick(4)) {
        case 0:
          add(-c_.rate * fastest * (1.0 + random_.logarithmic(1e-6, 1.0)));
          break;
        case 1:
          if (first_.imag() == 0.0 && first_.real() < 0.0) {
            meet(add(first_ * (1.0 + random_.sign() * random_.logarithmic(1e-16, 1e-2))), false);
            break;
          }
          [[fallthrough]];
        default:
          add(-c_.rate * random_.logarithmic(1e2, 1e6));
      }
    }
  }

  void own_motion() {
    const double w = c_.rate;
    bool chain = false;
    switch (c_.kind) {
      case OwnMotion::underdamped:
      case OwnMotion::negative_damping: {
        const double ratio = random_.logarithmic(1e-6, 0.99);
        const double decay = c_.kind == OwnMotion::underdamped ? -ratio * w : std::min(ratio, 0.9) * w;
        first_ = {decay, std::sqrt((w - decay) * (w + decay))};
        second_ = std::conj(first_);
        add(first_);
        return;
      }
      case OwnMotion::undamped_resonance:
        first_ = {random_.chance(0.5) ? 0.0 : -w * random_.logarithmic(1e-16, 1e-2), w};
        second_ = std::conj(first_);
        add(first_);
        return;
      case OwnMotion::near_critical: {
        const double apart = w * random_.logarithmic(1e-16, 1e-2);
        const bool conjugate = random_.chance(0.5);
        first_ = conjugate ? Complex(-w, apart) : Complex(-w + apart);
        second_ = conjugate ? std::conj(first_) : Complex(-w - apart);
        chain = true;
        break;
      }
      case OwnMotion::overdamped: {
        const double spread = random_.logarithmic(1.02, 1e4);
        first_ = -w / std::sqrt(spread);
        second_ = -w * std::sqrt(spread);
        break;
      }
      case OwnMotion::negative_stiffness:
        first_ = w * random_.logarithmic(0.1, 1.0);
        second_ = -w;
        break;
      default:
        first_ = 0.0;
        second_ = random_.chance(0.3) ? 0.0 : -w;
        chain = true;
    }
    const int first = add(first_);
    add(second_, chain ? first : ExponentialSum::no_parent);
  }

  void harmonics() {
    const bool resonant = c_.kind == OwnMotion::undamped_resonance;
    const int orders = random_.chance(0.5) ? 1 : 1 + random_.pick(8);
    const int meets = 1 + random_.pick(orders);
    double drive = c_.rate * random_.logarithmic(0.1, 3.0);
    if (resonant) drive = c_.rate * (1.0 + random_.sign() * random_.logarithmic(1e-16, 1e-2)) / meets;
    for (int order = 1; order <= orders; ++order) {
      if (order != meets && random_.chance(0.3)) continue;
      const int source = add({0.0, order * drive});
      if (resonant && order == meets) meet(source, random_.chance(0.3));
    }
  }

  Random& random_;
  GuardCase& c_;
  Complex first_;
  Complex second_;
};

/// f^(order)(s) = target
struct Condition {
  double s = 0.0;
  int order = 0;
  double target = 0.0;
};

/// Changes the coefficients of one guard, as few of them as there are conditions, so that it meets them: Gaussian
/// elimination with complete pivoting. False when the elements do not suffice.
class Imposing {
 public:
  Imposing(const GuardCase& c, GuardCase::Row& row, const std::vector<Condition>& conditions) : row_(row) {
    const ExponentialSum f = reference(c, row);
    for (const Condition& condition : conditions) {
      std::vector<Real> line;
      Real value = 0;
      const std::vector<LongComplex> columns = f.columns(static_cast<Real>(condition.s), condition.order);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (c.elements[k].unused) {
          line.insert(line.end(), 2, Real(0));
          continue;
        }
        line.push_back(columns[k].real());
        line.push_back(c.elements[k].exponent.imag() == 0.0 ? Real(0) : -columns[k].imag());
        value += (LongComplex(row.coefficients[k]) * columns[k]).real();
      }
      const Real largest = std::abs(
          *std::max_element(line.begin(), line.end(), [](Real a, Real b) { return std::abs(a) < std::abs(b); }));
      if (largest == 0) continue;
      for (Real& entry : line) entry /= largest;
      lines_.push_back(line);
      missing_.push_back((static_cast<Real>(condition.target) - value) / largest);
    }
  }

  [[nodiscard]] bool solve() {
    for (std::size_t step = 0; step < lines_.size(); ++step) {
      if (!eliminate(step)) return false;
    }
    for (std::size_t step = lines_.size(); step-- > 0;) {
      Real rest = missing_[step];
      for (std::size_t later = step + 1; later < lines_.size(); ++later) {
        rest -= lines_[step][pivots_[later]] * changes_[later];
      }
      changes_[step] = rest / lines_[step][pivots_[step]];
      Complex& coefficient = row_.coefficients[pivots_[step] / 2];
      const auto change = static_cast<double>(changes_[step]);
      coefficient += pivots_[step] % 2 == 0 ? Complex(change, 0.0) : Complex(0.0, change);
    }
    return true;
  }

 private:
  bool eliminate(std::size_t step) {
    std::size_t best_line = step;
    std::size_t best = 0;
    for (std::size_t i = step; i < lines_.size(); ++i) {
      for (std::size_t j = 0; j < lines_[i].size(); ++j) {
        if (std::abs(lines_[i][j]) > std::abs(lines_[best_line][best])) {
          best_line = i;
          best = j;
        }
      }
    }
    if (std::abs(lines_[best_line][best]) < 1e-6L) return false;
    std::swap(lines_[step], lines_[best_line]);
    std::swap(missing_[step], missing_[best_line]);
    for (std::size_t i = step + 1; i < lines_.size(); ++i) {
      const Real factor = lines_[i][best] / lines_[step][best];
      for (std::size_t j = 0; j < lines_[i].size(); ++j) lines_[i][j] -= factor * lines_[step][j];
      lines_[i][best] = 0;
      missing_[i] -= factor * missing_[step];
    }
    pivots_.push_back(best);
    changes_.push_back(0);
    return true;
  }

  GuardCase::Row& row_;
  std::vector<std::vector<Real>> lines_;
  std::vector<Real> missing_;
  std::vector<std::size_t> pivots_;
  std::vector<Real> changes_;
};

/// Draws one guard on the elements of the case.
class GuardDraw {
 public:
  GuardDraw(Random& random, const GuardCase& c) : random_(random), c_(c) {}

  /// `special`: place where a special event is planted.
  GuardCase::Row run(double special) {
    for (;;) {
      GuardCase::Row row = coefficients();
      row.zeros = random_.chance(0.35) ? 1 + random_.pick(3) : 0;
      std::vector<Condition> conditions;
      for (int order = 0; order < row.zeros; ++order) conditions.push_back({0, order, 0});
      conditions.push_back({0, row.zeros, random_.uniform(0.1, 1.0) * std::pow(c_.rate, row.zeros)});
      plant(special, conditions);
      // Twice: the first time coefficients may cancel.
      if (!Imposing(c_, row, conditions).solve() || !Imposing(c_, row, conditions).solve()) continue;
      clear_remnants(row);
      // The order of the zero is known only if the next derivative is larger than the rounding of the fastest
      // element.
      if (reference(c_, row).level(0) < 100) continue;
      const double scale = random_.chance(0.5) ? 1.0 : random_.logarithmic(1e-9, 1e9);
      for (Complex& c : row.coefficients) c *= scale;
      return row;
    }
  }

 private:
  GuardCase::Row coefficients() {
    GuardCase::Row row;
    for (const GuardCase::Element& e : c_.elements) {
      Complex coefficient = random_.phasor(1e-3, 1.0);
      if (random_.chance(0.3) || e.unused) coefficient = 0.0;
      if (e.exponent.imag() == 0.0) coefficient = coefficient.real();
      // Elements of a chain grow like powers of time.
      for (int p = e.parent; p >= 0; p = c_.elements[static_cast<std::size_t>(p)].parent) {
        coefficient *= c_.rate * random_.logarithmic(1e-2, 1.0);
      }
      row.coefficients.push_back(coefficient);
    }
    return row;
  }

  /// The remainder of a cancelled coefficient would only count where all other terms have underflowed.
  static void clear_remnants(GuardCase::Row& row) {
    for (Complex& c : row.coefficients) {
      if (std::abs(c) < 1e-100) c = 0.0;
    }
  }

  void plant(double s, std::vector<Condition>& conditions) {
    const double w = c_.rate;
    const double bend = random_.uniform(0.05, 1.0) * w * w;
    const int what = random_.pick(20);
    if (what < 3) return;
    if (what < 5) {  // a crossing
      conditions.push_back({s, 0, 0});
    } else if (what < 18) {  // a minimum below zero, above it, or on it
      double depth = 0.0;
      if (what < 15) {
        const double gap = 2.0 * std::numbers::pi / w * random_.logarithmic(what < 13 ? 1e-7 : 1e-10, 1.0);
        depth = bend * gap * gap / 8.0;
        if (what % 3 == 0) depth = -depth;
      }
      conditions.insert(conditions.end(), {{s, 0, -depth}, {s, 1, 0}, {s, 2, bend}});
    } else {  // a crossing of order three, a contact of order four
      conditions.insert(conditions.end(), {{s, 0, 0}, {s, 1, 0}, {s, 2, 0}});
      conditions.push_back({s, 3, what == 18 ? -bend * w : 0.0});
      if (what == 19) conditions.push_back({s, 4, bend * w * w});
    }
  }

  Random& random_;
  const GuardCase& c_;
};

/// Largest rate of growth of an element of a guard.
double growth(const GuardCase& c) {
  double fastest = 0.0;
  for (const GuardCase::Element& e : c.elements) {
    if (!e.unused) fastest = std::max(fastest, e.exponent.real());
  }
  return fastest;
}

/// A sticking mass: its free motion does not enter the guards and may grow without bound.
void leave_own_motion_unused(GuardCase& c) {
  for (GuardCase::Element& e : c.elements) {
    const bool own =
        e.exponent.real() > 0.0 || (e.parent >= 0 && c.elements[static_cast<std::size_t>(e.parent)].unused);
    e.unused = e.unused || own;
  }
}

double turning(const GuardCase& c) {
  double fastest = c.rate;
  for (const GuardCase::Element& e : c.elements) fastest = std::max(fastest, std::abs(e.exponent.imag()));
  return fastest;
}

}  // namespace

std::string_view name(OwnMotion kind) {
  static constexpr std::array<std::string_view, static_cast<std::size_t>(OwnMotion::count)> names = {
      "underdamped",        "overdamped",       "near critical", "undamped resonance",
      "negative stiffness", "negative damping", "free mass"};
  return names[static_cast<std::size_t>(kind)];
}

GuardCase random_guards(Random& random) {
  GuardCase c;
  c.kind = static_cast<OwnMotion>(random.pick(static_cast<int>(OwnMotion::count)));
  c.rate = random.logarithmic(1e-3, 1e3);
  BasisDraw(random, c).run();
  const bool grows = growth(c) > 0.0;
  if (grows && random.chance(0.3)) leave_own_motion_unused(c);
  const bool unused = grows && growth(c) == 0.0;
  c.horizon = random.logarithmic(0.3, unused ? 3000.0 : grows ? 300.0 : 60.0) / turning(c);
  // Place where a special event is planted; sometimes at the start or near the horizon.
  double special = c.horizon * random.uniform(0.05, 0.95);
  if (random.chance(0.2)) special = c.horizon * random.logarithmic(1e-9, 1.0);
  if (random.chance(0.1)) {
    special = c.horizon;
    if (random.chance(0.7)) special *= 1.0 + random.sign() * random.logarithmic(1e-15, 1e-2);
  }
  for (int i = random.chance(0.3) ? 2 + random.pick(2) : 1; i > 0; --i) {
    c.guards.push_back(GuardDraw(random, c).run(special));
    special *= 1.0 + random.sign() * random.logarithmic(1e-16, 1e-1);
  }
  return c;
}

ExponentialSum reference(const GuardCase& c, const GuardCase::Row& guard) {
  ExponentialSum f;
  for (std::size_t k = 0; k < c.elements.size(); ++k) {
    f.add(LongComplex(c.elements[k].exponent), LongComplex(guard.coefficients[k]), c.elements[k].parent);
  }
  f.finish(guard.zeros);
  return f;
}

std::string describe(const GuardCase& c) {
  std::string text = fmt::format("{}, rate {:.17g}, horizon {:.17g}\n", name(c.kind), c.rate, c.horizon);
  for (const GuardCase::Element& e : c.elements) {
    text += fmt::format("  {{{{{:.17g}, {:.17g}}}, {}}},\n", e.exponent.real(), e.exponent.imag(), e.parent);
  }
  for (const GuardCase::Row& row : c.guards) {
    text += fmt::format("  guard with {} known zeros:", row.zeros);
    for (const Complex& z : row.coefficients) text += fmt::format(" {{{:.17g}, {:.17g}}}", z.real(), z.imag());
    text += "\n";
  }
  return text;
}

}  // namespace dualdamp::test
