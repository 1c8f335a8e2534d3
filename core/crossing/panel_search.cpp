#include "core/crossing/panel_search.hpp"

#include <array>
#include <limits>

namespace dualdamp::core {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int max_depth = 60;
/// Halley's method is tried if its first step from the expected crossing is below this part of 1/fastest(): it then
/// takes two steps.
constexpr double beside = 0.05;

/// A square of a slope between these is neither lost nor infinite.
constexpr double small_square = 1e-200;
constexpr double large_square = 1e200;

double halley_by_ratios(const Jet& j) {
  if (j.slope == 0.0) return 0.0;
  const double newton = j.value / j.slope;
  return newton / (1.0 - 0.5 * newton * (j.curvature / j.slope));
}

/// Halley's step to a root of the guard [s].
inline double halley(const Jet& j) {
  const double square = j.slope * j.slope;
  if (square > small_square && square < large_square) [[likely]]
    return 2.0 * j.value * j.slope / (2.0 * square - j.value * j.curvature);
  return halley_by_ratios(j);
}

/// Whether slope^2 > 4 error curvature: a function known to `error` is then monotone within the time in which it
/// changes by `error`.
bool is_steep(double slope, double error, double curvature) {
  const double square = slope * slope;
  if (square > small_square && square < large_square) [[likely]]
    return square > 4.0 * error * curvature;
  return std::abs(slope) > 4.0 * error * (curvature / std::abs(slope));
}

/// Quintic Hermite interpolant of a panel on t in [0, 1], in Bernstein form of degree six.
struct Bernstein {
  std::array<double, 7> b;

  Bernstein(const Jet& left, const Jet& right) {
    const double h = right.s - left.s;
    const double bend = 0.05 * h * h;
    const double left_rise = 0.2 * h * left.slope;
    const double right_rise = 0.2 * h * right.slope;
    // Degree five, elevated to six.
    const double b1 = left.value + left_rise;
    const double b2 = b1 + left_rise + bend * left.curvature;
    const double b4 = right.value - right_rise;
    const double b3 = b4 - right_rise + bend * right.curvature;
    b[0] = left.value;
    b[1] = left.value + (5.0 / 6.0) * left_rise;
    b[2] = b1 + (2.0 / 3.0) * (b2 - b1);
    b[3] = 0.5 * (b2 + b3);
    b[4] = b4 + (2.0 / 3.0) * (b3 - b4);
    b[5] = right.value - (5.0 / 6.0) * right_rise;
    b[6] = right.value;
  }

  /// Whether all coefficients exceed the allowed rounding, except those that a factored zero at an end makes
  /// exactly zero.
  [[nodiscard]] bool exceeds(double allowance, int left_zeros, int right_zeros) const {
    for (int i = left_zeros; i <= 6 - right_zeros; ++i) {
      if (!(b[static_cast<std::size_t>(i)] > allowance)) return false;
    }
    return true;
  }
};

/// The quintic Hermite interpolant of a panel in powers of t in [0, 1].
struct Interpolant {
  double c0, c1, c2, c3, c4, c5;

  Interpolant(const Jet& a, const Jet& b) : c0(a.value) {
    const double h = b.s - a.s;
    c1 = a.slope * h;
    c2 = 0.5 * a.curvature * h * h;
    const double rise = b.value - c0 - c1 - c2;
    const double turn = b.slope * h - c1 - 2.0 * c2;
    const double bend = 0.5 * b.curvature * h * h - c2;
    c3 = 10.0 * rise - 4.0 * turn + bend;
    c4 = -15.0 * rise + 7.0 * turn - 2.0 * bend;
    c5 = 6.0 * rise - 3.0 * turn + bend;
  }

  [[nodiscard]] double at(double t) const { return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))); }
  [[nodiscard]] double slope(double t) const {
    return c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)));
  }

  /// The root of an interpolant that starts positive and ends negative, from a guess: Newton's method with
  /// bisection as a safeguard. The root needs only two digits more than the interpolant itself has.
  [[nodiscard]] double root(double t) const {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 12; ++i) {
      const double value = at(t);
      (value > 0.0 ? low : high) = t;
      double next = t - value / slope(t);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double step = next - t;
      t = next;
      if (std::abs(step) < 1e-3) break;
    }
    return t;
  }
};

}  // namespace

/// Computes the bounds for [a, b] alone: if elements decay, they are smaller than those of the whole panel.
void PanelSearch::narrow(double a, double b) {
  ExponentialBasis::Values values;
  basis_.evaluate(a, values);
  bound_locally(a, b - a, values);
}

void PanelSearch::bound_locally(double a, double h, const ExponentialBasis::Values& values) {
  if (basis_.even()) {
    sixth_ = curvature_ = amplitude_ = 0.0;
    for (int k = 0; k < basis_.size(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double modulus =
          modulus_bound(guard_.value.re[i], guard_.value.im[i]) * modulus_bound(values.re[i], values.im[i]);
      const double square = basis_.relative_square(k);
      amplitude_ += modulus;
      curvature_ += modulus * basis_.square(k);
      sixth_ += modulus * square * square * square;
    }
    return;
  }
  ElementNumbers bounds;
  bound_elements(basis_, values, a, h, bounds);
  sixth_ = bound(basis_, guard_.sixth, bounds);
  curvature_ = bound(basis_, guard_.curvature, bounds);
  // Near a known zero the amplitudes up to 1/fastest() count: at s = 0 chains have not grown yet.
  const double reach = jets_.near_start(a) && basis_.fastest() > 0.0 ? 1.0 / basis_.fastest() - a : 0.0;
  amplitude_ = reach > h ? bound(basis_, guard_.value, values, a, reach) : bound(basis_, guard_.value, bounds);
}

/// Halley's iteration from a good guess; the basis is evaluated once and then shifted. Afterwards root_values_ are
/// the elements at the result, and polished_ is the time at which the iteration has converged, or `none`.
Jet PanelSearch::polish(double s) {
  basis_.evaluate(s, root_values_);
  Jet j;
  jets_.take(s, root_values_, j);
  polish(j);
  return j;
}

/// Halley's iteration from a jet near the root, for which root_values_ hold the elements.
void PanelSearch::polish(Jet& j) {
  double s = j.s;
  for (int i = 0; i < 8; ++i) {
    const double step = halley(j);
    const double size = std::abs(step);
    polished_ = s;
    if (!(size > 2.0 * epsilon * s)) return;
    if (!(s - step >= 0.0)) break;
    // Convergence is cubic on the guard's own scales: after such a small step the error is below rounding.
    const bool last = size * basis_.fastest() < 5e-6 && size * std::abs(j.curvature) < 5e-6 * std::abs(j.slope) &&
                      basis_.fastest() > 0.0;
    s -= step;
    if (!basis_.shift(-step, root_values_)) basis_.evaluate(s, root_values_);
    jets_.take(s, root_values_, j);
    polished_ = s;
    if (last) return;
  }
  polished_ = none;
}

/// The root of g near that of the interpolant, if g is certified positive before it; else `none`.
double PanelSearch::accept_root(const Jet& a, const Jet& b) {
  const double width = b.s - a.s;
  // Halley's step from the far end, where the guard is negative.
  const double guess = 1.0 - halley(b) / width;
  Jet root = polish(a.s + width * Interpolant(a, b).root(guess > 0.0 && guess <= 1.0 ? guess : 1.0));
  return root.s <= b.s && is_first_crossing(a, root) ? root.s : none;
}

/// Whether g, polished at `root`, changes its sign there for the first time after a.
bool PanelSearch::is_first_crossing(const Jet& a, Jet& root) const {
  if (polished_ != root.s || !(root.s > a.s) || !(root.slope < 0.0)) return false;
  // g is monotone where it is within rounding of zero: so its sign does change.
  const double reach = slack(root.s);
  if (!(std::abs(root.value) <= reach) || !is_steep(root.slope, reach, curvature_)) return false;
  root.zeros = 1;
  return positive_between(a, root);
}

double PanelSearch::expected_root(double horizon) {
  bound_panel(0.0, horizon, basis_.at_expected());
  copy(basis_, basis_.at_expected(), root_values_);
  Jet root;
  jets_.take(basis_.expected(), root_values_, root);
  if (!(std::abs(halley(root)) * basis_.fastest() < beside)) return none;
  polish(root);
  // The horizon must be clear of the rounding of the crossing; else the crossing belongs to the next search.
  if (!((root.s - horizon) * root.slope > 4.0 * slack(root.s))) return none;
  return is_first_crossing(jets_.at_begin(), root) ? root.s : none;
}

/// Whether L shows that g has no zero between the ends except the known ones.
bool PanelSearch::positive_between(const Jet& a, const Jet& b) const {
  Bernstein low(a, b);
  low.b[3] -= remainder(b.s - a.s);
  return low.exceeds(allowance(a, b), a.zeros, b.zeros);
}

/// The minimum between slopes of opposite sign, by Newton on g' with bisection as a safeguard.
Jet PanelSearch::minimum(const Jet& a, const Jet& b) {
  double low = a.s;
  double high = b.s;
  double s = a.s + (b.s - a.s) * a.slope / (a.slope - b.slope);
  Jet j = jets_.at(s);
  for (int i = 0; i < 60; ++i) {
    (j.slope < 0.0 ? low : high) = s;
    double next = s - j.slope / j.curvature;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = next - s;
    s = next;
    j = jets_.at(s);
    if (std::abs(step) <= 4.0 * epsilon * s) break;
  }
  return j;
}

/// The time between low and high at which the value becomes negative, by bisection: for a crossing that is too flat
/// for Newton's method.
double PanelSearch::sign_change(double low, double high) {
  for (int i = 0; i < 60 && high - low > 2.0 * epsilon * high; ++i) {
    const double s = 0.5 * (low + high);
    (jets_.at(s).value > 0.0 ? low : high) = s;
  }
  return high;
}

/// A point inside (a, b) whose value is clear of rounding, if there is one.
Jet PanelSearch::split_point(const Jet& a, const Jet& b) {
  Jet j;
  if (b.value > 0.0 && a.slope < 0.0 && b.slope > 0.0) {
    j = minimum(a, b);
    // A split at a minimum well above zero close to an end would leave nearly the same panel.
    const double margin = j.value > 0.0 && !is_rounding(j) ? 0.05 * (b.s - a.s) : 0.0;
    if (j.s > a.s + margin && j.s < b.s - margin) return j;
  }
  for (const double part : {0.5, 0.43, 0.61}) {
    j = jets_.at(a.s + part * (b.s - a.s));
    if (!is_rounding(j)) break;
  }
  return j;
}

double PanelSearch::split(const Jet& a, const Jet& b, int depth) {
  ++count_.splits;
  if (is_too_long()) return none;
  Jet middle = split_point(a, b);
  if (is_rounding(middle)) {
    record_grazing(middle.s);
    middle = as_grazing(middle);
  }
  if (!(middle.s > a.s && middle.s < b.s)) return b.value < 0.0 ? b.s : none;
  narrow(a.s, middle.s);
  const double left = first_root(a, middle, depth + 1);
  if (left >= 0.0 || middle.value < 0.0) return left;
  narrow(middle.s, b.s);
  return first_root(middle, b, depth + 1);
}

/// Whether g stays within rounding of zero on the whole panel.
bool PanelSearch::flat(const Jet& a, const Jet& b) const {
  const double widest = std::max(slack(a.s), slack(b.s));
  const double left_out = remainder(b.s - a.s);
  const Bernstein hermite(a, b);
  return std::all_of(hermite.b.begin(), hermite.b.end(),
                     [=](double coefficient) { return std::abs(coefficient) + left_out <= 1.1 * widest; });
}

double PanelSearch::first_root(const Jet& a, const Jet& b, int depth) {
  const bool crosses = b.zeros == 0 && b.value < 0.0;
  if (crosses) {
    const double root = accept_root(a, b);
    if (root >= 0.0) return root;
  } else if (positive_between(a, b)) {
    return none;
  }
  if (depth == 0) {
    const double coarse = amplitude_;
    narrow(a.s, b.s);
    if (amplitude_ < vanished) return none;
    if (amplitude_ < 0.5 * coarse) return first_root(a, b, depth);
  } else if (amplitude_ < vanished) {
    return none;
  }
  if (depth >= max_depth || b.s - a.s <= 4.0 * epsilon * b.s || flat(a, b)) {
    // The guard is within rounding of zero on the whole panel: a flat crossing, or one flat grazing.
    if (crosses) return sign_change(a.s, b.s);
    const Jet middle = jets_.at(0.5 * (a.s + b.s));
    if (a.zeros == 0 && is_rounding(middle)) record_grazing(middle.s);
    return none;
  }
  return split(a, b, depth);
}

}  // namespace dualdamp::core
