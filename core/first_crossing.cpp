#include "core/first_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/grazing.hpp"
#include "core/panel_search.hpp"

namespace dualdamp::core {

namespace {

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
      decided = decided && (value >= guard_rounding * guard.amplitude ||
                            value >= guard_rounding * bound(basis, guard.value, *values, b, 0.0));
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
                         SearchGrazings& grazings, SearchCount& count) {
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

/// The panel that begins at a; `room` takes the values at its end where the basis has none ready.
Panel next_panel(const ExponentialBasis& basis, std::span<const Guard> guards, double a, double horizon,
                 const ExponentialBasis::Values& at_a, ExponentialBasis::Values& room) {
  const double width = panel_width(basis, guards, at_a, a);
  Panel panel{.a = a, .b = std::min(a + width, horizon), .at_a = &at_a, .at_b = &room};
  if (!(width == basis.panel() && panel.b < horizon) || basis.has_chains()) {
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

enum class PanelResult { none, crossing, not_finite };

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
    end.value = 0.0;  // reached at the horizon: left to the next search
    end.zeros = 1;
  }
  root = search.first_root(begin, end);
  if (root < 0.0 && touched && !panel.is_last) search.record_grazing(panel.b);
  return root < 0.0 ? PanelResult::none : PanelResult::crossing;
}

/// The first crossing of any guard on the panel.
PanelResult search_panel(const ExponentialBasis& basis, std::span<const Guard> guards, const Panel& panel,
                         Crossing& crossing, SearchGrazings& grazings, SearchCount& count) {
  ++count.panels;
  PanelResult result = PanelResult::none;
  for (std::size_t g = 0; g < guards.size(); ++g) {
    if (guards[g].amplitude == 0.0) continue;  // identically zero never crosses
    PanelSearch search(basis, guards[g], static_cast<int>(g), grazings, count);
    double root = 0.0;
    const PanelResult of_guard = search_guard(search, panel, root);
    if (of_guard == PanelResult::not_finite) return of_guard;
    if (of_guard == PanelResult::none || (crossing.found && root >= crossing.s)) continue;
    result = of_guard;
    crossing.found = true;
    crossing.guard = static_cast<int>(g);
    crossing.s = root;
    search.values_at(root, crossing.values);
  }
  return result;
}

/// Removes grazings behind the crossing that ends the search, and those that are not over there.
void drop_unfinished(const ExponentialBasis& basis, std::span<const Guard> guards, const Crossing& crossing,
                     SearchGrazings& grazings) {
  grazings.drop_after(crossing.s);
  for (int g = 0; !grazings.empty() && g < static_cast<int>(guards.size()); ++g) {
    GuardJets jets(basis, guards[static_cast<std::size_t>(g)]);
    if (g == crossing.guard || is_within_rounding(jets, crossing.s)) grazings.drop_unfinished(jets, g, crossing.s);
  }
}

/// The motion runs away: nothing can be certified, and the values must not look like those of a motion.
void give_up(double horizon, Crossing& crossing) {
  crossing.found = false;
  crossing.s = horizon;
  crossing.values.re.fill(std::numeric_limits<double>::infinity());
  crossing.values.im.fill(0.0);
}

}  // namespace

void first_crossing(const ExponentialBasis& basis, std::span<const Guard> guards, double horizon,
                    Crossing& crossing, std::vector<Grazing>& all_grazings, SearchCount& count) {
  ++count.searches;
  crossing.found = false;
  crossing.guard = -1;
  crossing.s = horizon;
  SearchGrazings grazings(all_grazings);
  if (guards.size() == 1 && crosses_as_expected(basis, guards[0], horizon, crossing, grazings, count)) return;
  std::array<ExponentialBasis::Values, 2> ends;
  if (!basis.even()) start_values(basis, ends[0]);
  const ExponentialBasis::Values* left = &ends[0];
  double a = 0.0;
  while (a < horizon) {
    const Panel panel = next_panel(basis, guards, a, horizon, *left, ends[left == &ends[0] ? 1 : 0]);
    const PanelResult result = search_panel(basis, guards, panel, crossing, grazings, count);
    if (result == PanelResult::not_finite) return give_up(horizon, crossing);
    if (result == PanelResult::crossing) {
      drop_unfinished(basis, guards, crossing, grazings);
      return grazings.finish(count);
    }
    left = panel.at_b;
    a = panel.b;
  }
  if (a == 0.0) {
    start_values(basis, crossing.values);
  } else {
    copy(basis, *left, crossing.values);
  }
  grazings.finish(count);
}

}  // namespace dualdamp::core
