#include "core/crossing/first_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/crossing/grazing.hpp"
#include "core/crossing/panel_search.hpp"

namespace dualdamp::core {

namespace {

/// Panels widen where the fast elements have died out: the remainder stays below 1e-3 of the amplitudes at a.
/// Without chains and growth the bound of the sixth derivative does not depend on the width, so one step gives the
/// width.
double panel_width(const ExponentialBasis& basis, std::span<const Guard> guards,
                   const ExponentialBasis::Values& values, double a, double longest) {
  if (basis.even()) return basis.fastest() > 0.0 ? basis.panel() : std::numeric_limits<double>::infinity();
  if (longest <= basis.panel()) return basis.panel();
  ElementNumbers here;
  bound_elements(basis, values, a, 0.0, here);
  const bool varies = basis.has_chains() || basis.grows();
  ElementNumbers ahead;
  if (varies) bound_elements(basis, values, a, longest, ahead);
  const ElementNumbers* bounds = varies ? &ahead : &here;
  double width = longest;
  for (const Guard& guard : guards) {
    const double allowed = 14.4 * bound(basis, guard.value, here);
    // The width that the bound over the present width allows; narrower panels have smaller bounds.
    const auto allows = [&] {
      return std::cbrt(std::sqrt(allowed / bound(basis, guard.sixth, *bounds))) / basis.fastest();
    };
    for (double widest = allows(); width > basis.panel() && width > widest; widest = allows()) {
      width = std::max({widest, 0.125 * width, basis.panel()});
      if (!varies) break;
      bound_elements(basis, values, a, width, ahead);
    }
  }
  return std::max(width, basis.panel());
}

/// Panels meet where the sign of every guard is clear of rounding. If it is not at the inner end b, moves b and
/// evaluates the basis there.
double clear_panel_end(const ExponentialBasis& basis, std::span<const Guard> guards, double a, double b,
                       const ExponentialBasis::Values*& values, ExponentialBasis::Values& room) {
  for (int attempt = 0; attempt < 4; ++attempt) {
    bool decided = true;
    for (const Guard& guard : guards) {
      const double value = std::abs(evaluate(basis, guard.value, *values));
      decided = decided && (value >= guard_rounding * guard.amplitude ||
                            value >= guard_rounding * bound(basis, guard.value, *values, b, 0.0));
    }
    const double nearer = a + 0.77 * (b - a);
    if (decided || nearer == a) break;
    b = nearer;
    basis.evaluate(b, room);
    values = &room;
  }
  return b;
}

/// Tries whether a lone guard that starts at zero crosses where the basis expects it: one panel from the start to
/// the root, no transcendental function.
inline bool crosses_as_expected(const ExponentialBasis& basis, const Guard& guard, double horizon,
                                Crossing& crossing, SearchGrazings& grazings, SearchCount& count) {
  if (basis.expected() == 0.0 || basis.expected() >= horizon || guard.known_zeros == 0) return false;
  PanelSearch search(basis, guard, 0, grazings, count);
  const double root = search.expected_root(horizon);
  if (root < 0.0) return false;
  ++count.panels;
  crossing.found = true;
  crossing.guard = 0;
  crossing.s = root;
  search.values_at(root, crossing.values);
  return true;
}

/// A panel [a, b] with the values of the basis at both ends.
struct Panel {
  double a = 0.0;
  double b = 0.0;
  const ExponentialBasis::Values* at_a = nullptr;
  const ExponentialBasis::Values* at_b = nullptr;
  bool is_last = false;  ///< b is the horizon
};

/// A time later than a, beyond the rounding of both.
double later_than(double a) { return a + 4.0 * std::numeric_limits<double>::epsilon() * a; }

/// The panel that begins at a. A panel narrower than the rounding of time, such as beside bounds that have left the
/// range of double precision, would not advance. `room` holds the values at its end unless the basis has them
/// ready.
Panel next_panel(const ExponentialBasis& basis, std::span<const Guard> guards, double a, double horizon,
                 const ExponentialBasis::Values& at_a, ExponentialBasis::Values& room) {
  const double width = panel_width(basis, guards, at_a, a, horizon - a);
  const bool advances = a + width > a;
  Panel panel{.a = a, .b = std::min(advances ? a + width : later_than(a), horizon), .at_a = &at_a, .at_b = &room};
  if (!(width == basis.panel() && panel.b < horizon && advances) || basis.has_chains()) {
    basis.evaluate(panel.b, room);
  } else if (a == 0.0) {
    panel.at_b = &basis.over_panel();
  } else {
    basis.step_panel(at_a, room);
  }
  if (panel.b < horizon) panel.b = clear_panel_end(basis, guards, a, panel.b, panel.at_b, room);
  panel.is_last = panel.b == horizon;
  return panel;
}

enum class PanelResult { none, crossing, not_finite, too_long };

/// The first root of one guard on the panel; `root` is negative where there is none.
PanelResult search_guard(PanelSearch& search, const Panel& panel, double& root) {
  search.bound_panel(panel.a, panel.b - panel.a, *panel.at_a);
  Jet begin = panel.a == 0.0 ? search.jets().at_begin() : search.jets().at(panel.a, *panel.at_a);
  if (panel.a > 0.0 && search.is_rounding(begin)) begin = as_grazing(begin);
  Jet end = search.jets().at(panel.b, *panel.at_b);
  if (!search.finite(end)) return PanelResult::not_finite;
  const bool touched = search.is_rounding(end);
  if (touched && !panel.is_last) end = as_grazing(end);
  if (touched && panel.is_last) {
    end.value = 0.0;  // a zero at the horizon belongs to the next search
    end.zeros = 1;
  }
  root = search.first_root(begin, end);
  if (search.is_too_long()) return PanelResult::too_long;
  if (root < 0.0 && touched && !panel.is_last) search.record_grazing(panel.b);
  return root < 0.0 ? PanelResult::none : PanelResult::crossing;
}

/// The first crossing of any guard on the panel.
PanelResult search_panel(const ExponentialBasis& basis, std::span<const Guard> guards, const Panel& panel,
                         Crossing& crossing, SearchGrazings& grazings, SearchCount& count) {
  ++count.panels;
  PanelResult result = PanelResult::none;
  for (std::size_t g = 0; g < guards.size(); ++g) {
    if (guards[g].amplitude == 0.0) continue;  // a guard that is identically zero never crosses
    PanelSearch search(basis, guards[g], static_cast<int>(g), grazings, count);
    double root = 0.0;
    const PanelResult of_guard = search_guard(search, panel, root);
    if (of_guard == PanelResult::not_finite || of_guard == PanelResult::too_long) return of_guard;
    if (of_guard == PanelResult::none || (crossing.found && root >= crossing.s)) continue;
    result = of_guard;
    crossing.found = true;
    crossing.guard = static_cast<int>(g);
    crossing.s = root;
    search.values_at(root, crossing.values);
  }
  return result;
}

/// Removes grazings after the crossing that ends the search, and those that still last there.
void drop_unfinished(const ExponentialBasis& basis, std::span<const Guard> guards, const Crossing& crossing,
                     SearchGrazings& grazings) {
  grazings.drop_after(crossing.s);
  for (int g = 0; !grazings.empty() && g < static_cast<int>(guards.size()); ++g) {
    GuardJets jets(basis, guards[static_cast<std::size_t>(g)]);
    if (g == crossing.guard || is_within_rounding(jets, crossing.s)) grazings.drop_unfinished(jets, g, crossing.s);
  }
}

/// Number of panels searched before a wider stretch is tried.
constexpr long fewest_panels = 64;

/// The guard's constant less the largest moduli of all its other elements: a lower bound of the guard where the
/// bounds hold.
double least(const ExponentialBasis& basis, const Guard& guard, const ElementNumbers& bounds) {
  double constant = 0.0;
  double moduli = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    if (basis.exponent(k) != 0.0 || basis.parent(k) != ExponentialBasis::no_parent) continue;
    const auto i = static_cast<std::size_t>(k);
    constant += guard.value.re[i];
    moduli += std::abs(guard.value.re[i]);
  }
  return constant + moduli - bound(basis, guard.value, bounds);
}

/// A time from a on, at least fewest_panels long, in which no guard comes near zero; 0 if the bounds show none. So
/// the search passes a guard that turns a million times far from zero in a few steps.
double quiet_stretch(const ExponentialBasis& basis, std::span<const Guard> guards,
                     const ExponentialBasis::Values& values, double a, double horizon) {
  ElementNumbers bounds;
  for (double width = horizon - a; width > static_cast<double>(fewest_panels) * basis.panel(); width *= 0.5) {
    bound_elements(basis, values, a, width, bounds);
    // The rounding of zero grows with time, as in GuardJets. A tangency within it must be reported.
    const double rounding = guard_rounding + std::numeric_limits<double>::epsilon() * basis.turning() * (a + width);
    if (std::ranges::all_of(
            guards, [&](const Guard& guard) { return least(basis, guard, bounds) > rounding * guard.amplitude; }))
      return width;
  }
  return 0.0;
}

/// Outside this range a guard is searched multiplied by a power of two.
constexpr double smallest_amplitude = 0x1p-200;
constexpr double largest_amplitude = 0x1p200;

bool needs_scaling(const Guard& guard) {
  return (guard.amplitude > largest_amplitude && std::isfinite(guard.amplitude)) ||
         (guard.amplitude < smallest_amplitude && guard.amplitude > 0.0);
}

/// The guards, scaled to amplitudes near 1 if they need it: the zeros stay the same.
[[gnu::noinline]] std::vector<Guard> scaled(const ExponentialBasis& basis, std::span<const Guard> guards) {
  std::vector<Guard> list(guards.begin(), guards.end());
  for (Guard& guard : list) {
    if (!needs_scaling(guard)) continue;
    // In two steps, because the factor for a denormal amplitude would overflow.
    const int half = -std::ilogb(guard.amplitude) / 2;
    assign(basis, std::ldexp(1.0, half), guard.value, guard.value);
    assign(basis, std::ldexp(1.0, half), guard.value, guard.value);
    prepare(basis, guard);
  }
  return list;
}

[[gnu::noinline]] SearchEnd search_panels(const ExponentialBasis& basis, std::span<const Guard> guards,
                                          double horizon, Crossing& crossing, SearchGrazings& grazings,
                                          SearchCount& count) {
  std::array<ExponentialBasis::Values, 2> ends;
  if (!basis.even()) basis.start(ends[0]);
  const ExponentialBasis::Values* left = &ends[0];
  constexpr long split = 16;  // a split takes as long as this many panels
  const auto cost = [&] { return count.panels + split * count.splits; };
  const long last = cost() + most_panels;
  long next_try = count.panels + fewest_panels;
  double a = 0.0;
  while (a < horizon) {
    if (cost() > last) return SearchEnd::too_long;
    if (count.panels >= next_try) {
      const double quiet = quiet_stretch(basis, guards, *left, a, horizon);
      next_try = count.panels + (quiet > 0.0 ? 1 : fewest_panels);
      if (quiet > 0.0) {
        ++count.panels;
        a = quiet == horizon - a ? horizon : a + quiet;
        ExponentialBasis::Values& room = ends[left == &ends[0] ? 1 : 0];
        basis.evaluate(a, room);
        left = &room;
        continue;
      }
    }
    const Panel panel = next_panel(basis, guards, a, horizon, *left, ends[left == &ends[0] ? 1 : 0]);
    const PanelResult result = search_panel(basis, guards, panel, crossing, grazings, count);
    if (result == PanelResult::not_finite) return SearchEnd::left_range;
    if (result == PanelResult::too_long) return SearchEnd::too_long;
    if (result == PanelResult::crossing) {
      drop_unfinished(basis, guards, crossing, grazings);
      grazings.finish(count);
      return SearchEnd::crossing;
    }
    left = panel.at_b;
    a = panel.b;
  }
  if (a == 0.0) {
    basis.start(crossing.values);
  } else {
    copy(basis, *left, crossing.values);
  }
  grazings.finish(count);
  return SearchEnd::horizon;
}

}  // namespace

SearchEnd first_crossing(const ExponentialBasis& basis, std::span<const Guard> guards, double horizon,
                         Crossing& crossing, std::vector<Grazing>& all_grazings, SearchCount& count) {
  for (const Guard& guard : guards) {
    if (needs_scaling(guard)) [[unlikely]]
      return first_crossing(basis, scaled(basis, guards), horizon, crossing, all_grazings, count);
  }
  ++count.searches;
  crossing.found = false;
  crossing.guard = -1;
  crossing.s = horizon;
  SearchGrazings grazings(all_grazings);
  if (guards.size() == 1 && crosses_as_expected(basis, guards[0], horizon, crossing, grazings, count))
    return SearchEnd::crossing;
  return search_panels(basis, guards, horizon, crossing, grazings, count);
}

}  // namespace dualdamp::core
