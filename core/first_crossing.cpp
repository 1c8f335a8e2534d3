#include "core/first_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dualdamp::core {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double graze = 16.0 * epsilon;
constexpr int max_depth = 60;
/// Near a known zero the guard is its Taylor series: 0.5^18/18! of its scale is left out.
constexpr double taylor_angle = 0.5;
constexpr int taylor_terms = 18;
/// How far beside the expected crossing Halley's method is worth a trial: it then takes two steps.
constexpr double beside = 0.05;
/// A guard that has decayed to this has no zero any more.
constexpr double vanished = 1e-280;

/// A guard's value and first two derivatives at one time.
struct Jet {
  double s = 0.0;
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
  int zeros = 0;  ///< known order of the zero here
};

/// A touched point, where the certificate hands over: the guard counts as positive on both sides of it.
Jet handed_over(const Jet& touched) { return {touched.s, 0.0, 0.0, std::max(touched.curvature, 0.0), 2}; }

/// Halley's step to a root of the guard [s].
double halley(const Jet& j) { return 2.0 * j.value * j.slope / (2.0 * j.slope * j.slope - j.value * j.curvature); }

/// Quintic Hermite interpolant of a panel on t in [0, 1], in Bernstein form of degree six.
struct Bernstein {
  std::array<double, 7> b;

  Bernstein(const Jet& left, const Jet& right) {
    const double h = right.s - left.s;
    const double bend = 0.05 * h * h;
    const double left_rise = 0.2 * h * left.slope;
    const double right_rise = 0.2 * h * right.slope;
    // Degree five, raised to six.
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

  /// Whether all coefficients exceed a rounding allowance but those that a factored zero at an end makes exactly
  /// zero.
  [[nodiscard]] bool exceeds(double allowance, int left_zeros, int right_zeros) const {
    for (int i = left_zeros; i <= 6 - right_zeros; ++i) {
      if (!(b[static_cast<std::size_t>(i)] > allowance)) return false;
    }
    return true;
  }
};

/// The search for one guard within one outer panel.
class PanelSearch {
 public:
  /// `earlier`: grazings of earlier searches, at the begin of the list.
  PanelSearch(const ExponentialBasis& basis, const Guard& guard, int index, std::vector<Grazing>& grazings,
              std::ptrdiff_t earlier, SearchCount& count)
      : basis_(basis), guard_(guard), index_(index), grazings_(grazings), earlier_(earlier), count_(count) {}

  /// The jet from values of the basis; close to a known zero from the Taylor series that has it exactly.
  [[nodiscard]] Jet jet(double s, const ExponentialBasis::Values& values) {
    Jet j;
    take_jet(s, values, j);
    return j;
  }

  [[nodiscard]] Jet jet(double s) {
    ExponentialBasis::Values values;
    if (!near_start(s)) basis_.evaluate(s, values);
    return jet(s, values);
  }

  [[nodiscard]] Jet start_jet() const {
    Jet start{0.0, at_start(basis_, guard_.value), at_start(basis_, guard_.slope),
              at_start(basis_, guard_.curvature), guard_.known_zeros};
    if (start.zeros > 0) start.value = 0.0;
    if (start.zeros > 1) start.slope = 0.0;
    if (start.zeros > 2) start.curvature = 0.0;
    return start;
  }

  /// Rounding allowance of the value at s: 16 eps of the amplitudes and what the phases lose, less where a known
  /// zero is factored out.
  [[nodiscard]] double slack(double s) const { return slack(s, amplitude_); }
  [[nodiscard]] double slack(double s, double amplitude) const {
    double allowance = (graze + epsilon * basis_.turning() * s) * amplitude;
    const double angle = s * basis_.fastest();
    for (int i = 0; i < guard_.known_zeros && angle < taylor_angle; ++i) allowance *= angle;
    return allowance;
  }

  /// The same from the amplitudes at s alone, which decides what is a contact; costs an evaluation.
  [[nodiscard]] double rounding(double s) const {
    ExponentialBasis::Values values;
    const bool factored = guard_.known_zeros > 0 && s * basis_.fastest() < taylor_angle;
    const double there = factored && basis_.fastest() > 0.0 ? 1.0 / basis_.fastest() : s;
    basis_.evaluate(there, values);
    return slack(s, bound(basis_, guard_.value, values, there, 0.0));
  }
  /// Whether a jet's value is rounding.
  [[nodiscard]] bool touches(const Jet& j) const {
    return std::abs(j.value) <= slack(j.s) && std::abs(j.value) <= rounding(j.s);
  }

  /// Bounds for the panel [a, a + h] from the values of the basis at a.
  void bound_panel(double a, double h, const ExponentialBasis::Values& values) {
    if (basis_.even()) {
      sixth_ = guard_.sixth_bound;
      curvature_ = guard_.curvature_bound;
      amplitude_ = guard_.amplitude;
      return;
    }
    bound_locally(a, h, values);
  }

  /// Bounds for [a, b] alone: where elements decay they are smaller than the panel's.
  void narrow(double a, double b) {
    ExponentialBasis::Values values;
    basis_.evaluate(a, values);
    bound_locally(a, b - a, values);
  }

  /// False when the panel leaves the range of double precision.
  [[nodiscard]] bool finite(const Jet& end) const {
    return std::isfinite(sixth_ + std::abs(end.value) + std::abs(end.slope) + std::abs(end.curvature));
  }

  /// Whether the guard does not clearly stand out of rounding.
  [[nodiscard]] bool in_contact(double s) { return std::abs(jet(s).value) <= 1.5 * rounding(s); }
  /// Whether contacts with zero at s < t are one.
  [[nodiscard]] bool same_contact(double s, double t) {
    return in_contact(0.5 * (s + t)) && in_contact(s + 0.25 * (t - s)) && in_contact(s + 0.75 * (t - s));
  }
  void record_grazing(double s) {
    if (rounding(s) <= graze * vanished) return;
    const auto nearest = nearest_grazing(s);
    if (nearest != grazings_.end() && same_contact(std::min(nearest->s, s), std::max(nearest->s, s))) return;
    grazings_.push_back({index_, s});
  }
  /// A contact that lasts until the search ends at a crossing is no grazing: it is part of that crossing, or the
  /// next search's.
  void drop_contact(double end) {
    for (auto last = nearest_grazing(end); last != grazings_.end() && same_contact(last->s, end);
         last = nearest_grazing(end)) {
      grazings_.erase(last);
    }
  }
  /// First root in (a, b), or a negative number.
  [[nodiscard]] double first_root(const Jet& a, const Jet& b, int depth = 0);
  /// The same in (0, horizon), where it lies beside the one that the basis expects; else a negative number.
  [[nodiscard]] double expected_root(double horizon);
  /// The elements at the root last returned.
  void values_at(double root, ExponentialBasis::Values& values) const {
    if (root == polished_) {
      copy(basis_, root_values_, values);
    } else {
      basis_.evaluate(root, values);
    }
  }

 private:
  static constexpr double none = -1.0;

  [[nodiscard]] bool near_start(double s) const {
    return guard_.known_zeros > 0 && s * basis_.fastest() < taylor_angle;
  }
  void bound_locally(double a, double h, const ExponentialBasis::Values& values) {
    if (basis_.even()) {
      sixth_ = curvature_ = amplitude_ = 0.0;
      for (int k = 0; k < basis_.size(); ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double modulus =
            modulus_bound(guard_.value.re[i], guard_.value.im[i]) * modulus_bound(values.re[i], values.im[i]);
        const double square = basis_.square(k);
        amplitude_ += modulus;
        curvature_ += modulus * square;
        sixth_ += modulus * square * square * square;
      }
      return;
    }
    sixth_ = bound(basis_, guard_.sixth, values, a, h);
    curvature_ = bound(basis_, guard_.curvature, values, a, h);
    // Beside a known zero amplitudes count as far as its scale reaches: chains have not grown yet at s = 0.
    const double reach = near_start(a) && basis_.fastest() > 0.0 ? 1.0 / basis_.fastest() - a : 0.0;
    amplitude_ = bound(basis_, guard_.value, values, a, std::max(h, reach));
  }
  /// Of this guard and this search; the end of the list when there is none.
  [[nodiscard]] std::vector<Grazing>::iterator nearest_grazing(double s) const {
    auto nearest = grazings_.end();
    for (auto it = grazings_.begin() + earlier_; it != grazings_.end(); ++it) {
      if (it->guard != index_) continue;
      if (nearest == grazings_.end() || std::abs(it->s - s) < std::abs(nearest->s - s)) nearest = it;
    }
    return nearest;
  }
  [[nodiscard]] double sign_change(double low, double high);
  void take_jet(double s, const ExponentialBasis::Values& values, Jet& j);
  void take_taylor_jet(Jet& j);
  /// What the remainder takes from the middle coefficient of L on a panel of width h.
  [[nodiscard]] double remainder(double h) const {
    const double cube = h * h * h;
    return sixth_ * cube * cube / 14400.0;
  }
  /// Rounding of the coefficients of L.
  [[nodiscard]] double allowance(const Jet& a, const Jet& b) const {
    return a.zeros > 0 ? 0.0625 * slack(b.s) : std::max(slack(a.s), slack(b.s));
  }
  [[nodiscard]] bool positive_between(const Jet& a, const Jet& b) const;
  [[nodiscard]] bool flat(const Jet& a, const Jet& b) const;
  [[nodiscard]] double accept_root(const Jet& a, const Jet& b);
  [[nodiscard]] bool is_first_crossing(const Jet& a, Jet& root) const;
  Jet polish(double s);
  void polish(Jet& j);
  [[nodiscard]] Jet minimum(const Jet& a, const Jet& b);
  [[nodiscard]] Jet split_point(const Jet& a, const Jet& b);
  [[nodiscard]] double split(const Jet& a, const Jet& b, int depth);

  const ExponentialBasis& basis_;
  const Guard& guard_;
  int index_;
  std::vector<Grazing>& grazings_;
  std::ptrdiff_t earlier_;
  SearchCount& count_;
  double sixth_ = 0.0;
  double curvature_ = 0.0;
  double amplitude_ = 0.0;
  std::array<double, taylor_terms> taylor_;
  bool has_taylor_ = false;
  double polished_ = -1.0;
  ExponentialBasis::Values root_values_;
};

/// In place: the processor waits when a jet just written is copied as a whole.
inline void PanelSearch::take_jet(double s, const ExponentialBasis::Values& values, Jet& j) {
  j.s = s;
  j.zeros = 0;
  if (near_start(s)) return take_taylor_jet(j);
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

void PanelSearch::take_taylor_jet(Jet& j) {
  if (!has_taylor_) {
    has_taylor_ = true;
    ModeFunction derivative = guard_.value;
    double factorial = 1.0;
    for (int k = 0; k < taylor_terms; ++k) {
      taylor_[static_cast<std::size_t>(k)] =
          k < guard_.known_zeros ? 0.0 : at_start(basis_, derivative) / factorial;
      factorial *= k + 1;
      const ModeFunction previous = derivative;
      differentiate(basis_, previous, derivative);
    }
  }
  j.value = j.slope = j.curvature = 0.0;
  for (std::size_t k = taylor_terms; k-- > 0;) {
    j.curvature = j.curvature * j.s + 2.0 * j.slope;
    j.slope = j.slope * j.s + j.value;
    j.value = j.value * j.s + taylor_[k];
  }
}

/// Halley's iteration from a good guess; the basis is evaluated once and then shifted. Leaves the elements' values
/// at the result in root_values_. `polished_` tells where it has converged.
Jet PanelSearch::polish(double s) {
  basis_.evaluate(s, root_values_);
  Jet j;
  take_jet(s, root_values_, j);
  polish(j);
  return j;
}

/// The same from a jet and root_values_ there.
void PanelSearch::polish(Jet& j) {
  double s = j.s;
  for (int i = 0; i < 8; ++i) {
    const double step = halley(j);
    const double size = std::abs(step);
    polished_ = s;
    if (!(size > 2.0 * epsilon * s)) return;
    if (!(s - step >= 0.0)) break;
    // Convergence is cubic on the guard's own scales: behind so small a step nothing is left to correct.
    const bool last = size * basis_.fastest() < 5e-6 && size * std::abs(j.curvature) < 5e-6 * std::abs(j.slope) &&
                      basis_.fastest() > 0.0;
    s -= step;
    if (!basis_.shift(-step, root_values_)) basis_.evaluate(s, root_values_);
    take_jet(s, root_values_, j);
    polished_ = s;
    if (last) return;
  }
  polished_ = none;
}

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

  /// The root of an interpolant that starts positive and ends negative, from a guess: Newton with bisection as a
  /// safeguard. Two more digits than the interpolant itself has are enough.
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

/// The root of g near that of the interpolant, when g is certified positive before it.
double PanelSearch::accept_root(const Jet& a, const Jet& b) {
  const double width = b.s - a.s;
  // Seen from the far end, where the guard is negative.
  const double guess = 1.0 - halley(b) / width;
  Jet root = polish(a.s + width * Interpolant(a, b).root(guess > 0.0 && guess <= 1.0 ? guess : 1.0));
  return root.s <= b.s && is_first_crossing(a, root) ? root.s : none;
}

/// Whether g, polished at `root`, changes its sign there for the first time behind a.
bool PanelSearch::is_first_crossing(const Jet& a, Jet& root) const {
  if (polished_ != root.s || !(root.s > a.s) || !(root.slope < 0.0)) return false;
  // Monotone as far as rounding of the value reaches: g does change its sign there.
  const double reach = slack(root.s);
  if (!(std::abs(root.value) <= reach) || !(root.slope * root.slope > 4.0 * reach * curvature_)) return false;
  root.zeros = 1;
  return positive_between(a, root);
}

double PanelSearch::expected_root(double horizon) {
  bound_panel(0.0, horizon, basis_.at_expected());
  copy(basis_, basis_.at_expected(), root_values_);
  Jet root;
  take_jet(basis_.expected(), root_values_, root);
  if (!(std::abs(halley(root)) * basis_.fastest() < beside)) return none;
  polish(root);
  // The horizon lies behind the contact, so that the crossing is not the next search's.
  if (!((root.s - horizon) * root.slope > 4.0 * slack(root.s))) return none;
  return is_first_crossing(start_jet(), root) ? root.s : none;
}

/// Whether L shows that g has no zero between the ends but the known ones.
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
  Jet j = jet(s);
  for (int i = 0; i < 60; ++i) {
    (j.slope < 0.0 ? low : high) = s;
    double next = s - j.slope / j.curvature;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = next - s;
    s = next;
    j = jet(s);
    if (std::abs(step) <= 4.0 * epsilon * s) break;
  }
  return j;
}

/// Where the value turns negative between low and high, by bisection: for contacts too flat for Newton.
double PanelSearch::sign_change(double low, double high) {
  for (int i = 0; i < 60 && high - low > 2.0 * epsilon * high; ++i) {
    const double s = 0.5 * (low + high);
    (jet(s).value > 0.0 ? low : high) = s;
  }
  return high;
}

/// A point inside (a, b) whose value is decided beyond rounding, where there is one.
Jet PanelSearch::split_point(const Jet& a, const Jet& b) {
  Jet j;
  if (b.value > 0.0 && a.slope < 0.0 && b.slope > 0.0) {
    j = minimum(a, b);
    // A minimum well above zero beside an end would leave the panel as it was.
    const double margin = j.value > 0.0 && !touches(j) ? 0.05 * (b.s - a.s) : 0.0;
    if (j.s > a.s + margin && j.s < b.s - margin) return j;
  }
  for (const double part : {0.5, 0.43, 0.61}) {
    j = jet(a.s + part * (b.s - a.s));
    if (!touches(j)) break;
  }
  return j;
}

double PanelSearch::split(const Jet& a, const Jet& b, int depth) {
  ++count_.splits;
  Jet middle = split_point(a, b);
  if (touches(middle)) {
    record_grazing(middle.s);
    middle = handed_over(middle);
  }
  if (!(middle.s > a.s && middle.s < b.s)) return b.value < 0.0 ? b.s : none;
  narrow(a.s, middle.s);
  const double left = first_root(a, middle, depth + 1);
  if (left >= 0.0 || middle.value < 0.0) return left;
  narrow(middle.s, b.s);
  return first_root(middle, b, depth + 1);
}

/// Whether g stays within rounding of zero.
bool PanelSearch::flat(const Jet& a, const Jet& b) const {
  const double widest = std::max(slack(a.s), slack(b.s));
  const double rest = remainder(b.s - a.s);
  const Bernstein hermite(a, b);
  return std::all_of(hermite.b.begin(), hermite.b.end(),
                     [=](double coefficient) { return std::abs(coefficient) + rest <= 1.1 * widest; });
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
    // Nowhere on the panel does the guard stand out of rounding: a flat crossing, or one flat contact.
    if (crosses) return sign_change(a.s, b.s);
    const Jet middle = jet(0.5 * (a.s + b.s));
    if (a.zeros == 0 && touches(middle)) record_grazing(middle.s);
    return none;
  }
  return split(a, b, depth);
}

void start_values(const ExponentialBasis& basis, ExponentialBasis::Values& values) {
  for (int k = 0; k < basis.size(); ++k) {
    values.re[static_cast<std::size_t>(k)] = basis.parent(k) == ExponentialBasis::no_parent ? 1.0 : 0.0;
    values.im[static_cast<std::size_t>(k)] = 0.0;
  }
}

/// Panels may widen where the fast elements have died out: the remainder stays below 1e-3 of the amplitude.
double panel_width(const ExponentialBasis& basis, std::span<const Guard> guards,
                   const ExponentialBasis::Values& values, double a) {
  double width = basis.panel();
  if (basis.even()) return basis.fastest() > 0.0 ? width : std::numeric_limits<double>::infinity();
  for (int doubling = 0; doubling < 60; ++doubling) {
    const double wider = 2.0 * width;
    const double wider2 = wider * wider;
    for (const Guard& guard : guards) {
      const double remainder = bound(basis, guard.sixth, values, a, wider) * wider2 * wider2 * wider2 / 14400.0;
      if (remainder > 1e-3 * guard.amplitude) return width;
    }
    width = wider;
  }
  return width;
}

/// Panels meet where every guard is decided beyond rounding; moves an undecided inner end b and evaluates there.
double clear_panel_end(const ExponentialBasis& basis, std::span<const Guard> guards, double a, double b,
                       const ExponentialBasis::Values*& values, ExponentialBasis::Values& room) {
  for (int attempt = 0; attempt < 4; ++attempt) {
    bool decided = true;
    for (const Guard& guard : guards) {
      const double value = std::abs(evaluate(basis, guard.value, *values));
      decided = decided &&
                (value >= graze * guard.amplitude || value >= graze * bound(basis, guard.value, *values, b, 0.0));
    }
    if (decided) break;
    b = a + 0.77 * (b - a);
    basis.evaluate(b, room);
    values = &room;
  }
  return b;
}

/// Tries a lone guard that starts at zero where the basis expects its next crossing: one panel from the start to
/// the root, no transcendental function.
bool crosses_as_expected(const ExponentialBasis& basis, const Guard& guard, double horizon, Crossing& crossing,
                         std::vector<Grazing>& grazings, SearchCount& count) {
  if (basis.expected() == 0.0 || basis.expected() >= horizon || guard.known_zeros == 0) return false;
  PanelSearch search(basis, guard, 0, grazings, static_cast<std::ptrdiff_t>(grazings.size()), count);
  const double root = search.expected_root(horizon);
  if (root < 0.0) return false;
  ++count.panels;
  crossing.found = true;
  crossing.guard = 0;
  crossing.s = root;
  search.values_at(root, crossing.values);
  return true;
}

/// Grazings behind the crossing that ends the search, and contacts that are not over there.
void drop_unfinished(const ExponentialBasis& basis, std::span<const Guard> guards, const Crossing& crossing,
                     std::vector<Grazing>& grazings, std::ptrdiff_t earlier, SearchCount& count) {
  const auto late = [&](const Grazing& grazing) { return grazing.s > crossing.s; };
  grazings.erase(std::remove_if(grazings.begin() + earlier, grazings.end(), late), grazings.end());
  for (int g = 0; std::ssize(grazings) > earlier && g < static_cast<int>(guards.size()); ++g) {
    PanelSearch search(basis, guards[static_cast<std::size_t>(g)], g, grazings, earlier, count);
    if (g == crossing.guard || search.in_contact(crossing.s)) search.drop_contact(crossing.s);
  }
}

/// Those of this search, in order of time.
void finish_grazings(std::vector<Grazing>& grazings, std::ptrdiff_t earlier, SearchCount& count) {
  count.grazings += static_cast<long>(grazings.size()) - earlier;
  std::sort(grazings.begin() + earlier, grazings.end(),
            [](const Grazing& a, const Grazing& b) { return a.s < b.s; });
}

}  // namespace

void prepare(const ExponentialBasis& basis, Guard& guard) {
  differentiate(basis, guard.value, guard.slope);
  prepare_with_slope(basis, guard);
}

void prepare_with_slope(const ExponentialBasis& basis, Guard& guard) {
  differentiate(basis, guard.slope, guard.curvature);
  guard.amplitude = guard.curvature_bound = guard.sixth_bound = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (guard.value.re[i] == 0.0 && guard.value.im[i] == 0.0) continue;
    const double modulus = std::sqrt(guard.value.re[i] * guard.value.re[i] + guard.value.im[i] * guard.value.im[i]);
    const double square = basis.square(k);
    guard.amplitude += modulus;
    guard.curvature_bound += modulus * square;
    guard.sixth_bound += modulus * square * square * square;
  }
  if (basis.even()) return;
  ModeFunction third;
  ModeFunction fourth;
  differentiate(basis, guard.curvature, third);
  differentiate(basis, third, fourth);
  differentiate(basis, fourth, third);
  differentiate(basis, third, guard.sixth);
}

void first_crossing(const ExponentialBasis& basis, std::span<const Guard> guards, double horizon,
                    Crossing& crossing, std::vector<Grazing>& grazings, SearchCount& count) {
  ++count.searches;
  crossing.found = false;
  crossing.guard = -1;
  crossing.s = horizon;
  const auto earlier = static_cast<std::ptrdiff_t>(grazings.size());
  if (guards.size() == 1 && crosses_as_expected(basis, guards[0], horizon, crossing, grazings, count)) return;
  std::array<ExponentialBasis::Values, 2> ends;
  if (!basis.even()) start_values(basis, ends[0]);
  const ExponentialBasis::Values* left = &ends[0];
  double a = 0.0;
  while (a < horizon) {
    ++count.panels;
    ExponentialBasis::Values& room = ends[left == &ends[0] ? 1 : 0];
    const ExponentialBasis::Values* right = &room;
    const double width = panel_width(basis, guards, *left, a);
    double b = std::min(a + width, horizon);
    if (!(width == basis.panel() && b < horizon) || basis.has_chains()) {
      basis.evaluate(b, room);
    } else if (a == 0.0) {
      right = &basis.over_panel();
    } else {
      basis.step_panel(*left, room);
    }
    if (b < horizon) b = clear_panel_end(basis, guards, a, b, right, room);
    double first = -1.0;
    for (std::size_t g = 0; g < guards.size(); ++g) {
      if (guards[g].amplitude == 0.0) continue;  // identically zero never crosses
      PanelSearch search(basis, guards[g], static_cast<int>(g), grazings, earlier, count);
      search.bound_panel(a, b - a, *left);
      Jet begin = a == 0.0 ? search.start_jet() : search.jet(a, *left);
      if (a > 0.0 && search.touches(begin)) begin = handed_over(begin);
      Jet end = search.jet(b, *right);
      if (!search.finite(end)) {
        // The motion runs away: nothing can be certified, and the values must not look like those of a motion.
        crossing.values.re.fill(std::numeric_limits<double>::infinity());
        crossing.values.im.fill(0.0);
        return;
      }
      const bool touched = search.touches(end);
      if (touched && b < horizon) end = handed_over(end);
      if (touched && b == horizon) {
        end.value = 0.0;  // reached at the horizon: left to the next search
        end.zeros = 1;
      }
      const double root = search.first_root(begin, end);
      if (root < 0.0 && touched && b < horizon) search.record_grazing(b);
      if (root >= 0.0 && (first < 0.0 || root < first)) {
        first = root;
        crossing.guard = static_cast<int>(g);
        search.values_at(root, crossing.values);
      }
    }
    if (first >= 0.0) {
      crossing.found = true;
      crossing.s = first;
      drop_unfinished(basis, guards, crossing, grazings, earlier, count);
      finish_grazings(grazings, earlier, count);
      return;
    }
    left = right;
    a = b;
  }
  if (a == 0.0) {
    start_values(basis, crossing.values);
  } else {
    copy(basis, *left, crossing.values);
  }
  finish_grazings(grazings, earlier, count);
}

namespace {

/// Whether a Taylor coefficient stands out of rounding.
bool stands_out(const ExponentialBasis& basis, const ModeFunction& f, double value, double tolerance) {
  double sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k)
    sum += std::abs(f.re[k]) + std::abs(f.im[k]);
  return std::abs(value) > graze * sum + tolerance;
}

/// How fast a tolerance grows from one derivative to the next.
double rate(const ExponentialBasis& basis) { return basis.fastest() > 0.0 ? basis.fastest() : 1.0; }

}  // namespace

Germ germ(const ExponentialBasis& basis, const Guard& guard, double tolerance, int from) {
  constexpr int examined = 4;
  ModeFunction third;
  const std::array<const ModeFunction*, examined> derivatives = {&guard.value, &guard.slope, &guard.curvature,
                                                                 &third};
  for (int order = 0; order < from; ++order) tolerance *= rate(basis);
  for (int order = from; order < examined; ++order) {
    const ModeFunction& f = *derivatives[static_cast<std::size_t>(order)];
    if (order == examined - 1) differentiate(basis, guard.curvature, third);
    const double value = at_start(basis, f);
    if (stands_out(basis, f, value, tolerance)) return {value > 0.0 ? 1 : -1, order};
    tolerance *= rate(basis);
  }
  return {0, examined};
}

Germ germ(const ExponentialBasis& basis, const ModeFunction& f, double tolerance) {
  Guard guard;
  guard.value = f;
  prepare(basis, guard);
  return germ(basis, guard, tolerance);
}

}  // namespace dualdamp::core
