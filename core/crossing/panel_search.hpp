#pragma once
/// The search for the first root of one guard on one panel. `core/crossing/first_crossing.hpp` states the proof
/// that none is missed.

#include <algorithm>
#include <cmath>

#include "core/crossing/grazing.hpp"
#include "core/crossing/guard_jets.hpp"
#include "core/crossing/search_result.hpp"

namespace dualdamp::core {

class PanelSearch {
 public:
  /// `index`: position of the guard in the list of guards that are searched.
  PanelSearch(const ExponentialBasis& basis, const Guard& guard, int index, SearchGrazings& grazings,
              SearchCount& count)
      : basis_(basis),
        guard_(guard),
        index_(index),
        jets_(basis, guard),
        grazings_(grazings),
        count_(count),
        last_(count.splits + most_splits) {}

  [[nodiscard]] GuardJets& jets() { return jets_; }

  /// Computes the bounds for the panel [a, a + h] from the values of the basis at a.
  void bound_panel(double a, double h, const ExponentialBasis::Values& values) {
    if (basis_.even()) {
      sixth_ = guard_.sixth_bound;
      curvature_ = guard_.curvature_bound;
      amplitude_ = guard_.amplitude;
      return;
    }
    bound_locally(a, h, values);
  }

  /// False if the guard leaves the range of double precision on the panel.
  [[nodiscard]] bool finite(const Jet& end) const {
    return std::isfinite(sixth_ + std::abs(end.value) + std::abs(end.slope) + std::abs(end.curvature));
  }
  /// Whether a jet's value is within rounding of zero.
  [[nodiscard]] bool is_rounding(const Jet& j) const {
    return std::abs(j.value) <= slack(j.s) && std::abs(j.value) <= jets_.rounding(j.s);
  }
  void record_grazing(double s) { grazings_.record(jets_, index_, s); }

  /// The panel was divided more often than is allowed: the result of the search then means nothing.
  [[nodiscard]] bool is_too_long() const { return count_.splits > last_; }
  /// First root in (a, b), or a negative number.
  [[nodiscard]] double first_root(const Jet& a, const Jet& b, int depth = 0);
  /// First root in (0, horizon), if it lies near the one that the basis expects; else a negative number.
  [[nodiscard]] double expected_root(double horizon);
  /// The elements at the root that was returned last.
  void values_at(double root, ExponentialBasis::Values& values) const {
    if (root == polished_) {
      copy(basis_, root_values_, values);
    } else {
      basis_.evaluate(root, values);
    }
  }

 private:
  static constexpr double none = -1.0;
  /// Largest number of splits of one panel: about a second.
  static constexpr long most_splits = 500'000;

  // Bounds and rounding.
  void narrow(double a, double b);
  void bound_locally(double a, double h, const ExponentialBasis::Values& values);
  [[nodiscard]] double slack(double s) const { return jets_.slack(s, amplitude_); }
  /// The part of the remainder in the middle coefficient of L, on a panel of width h.
  [[nodiscard]] double remainder(double h) const {
    const double angle = h * basis_.fastest();
    const double cube = angle * angle * angle;
    return sixth_ * cube * cube / 14400.0;
  }
  /// Rounding of the coefficients of L.
  [[nodiscard]] double allowance(const Jet& a, const Jet& b) const {
    return a.zeros > 0 ? 0.0625 * slack(b.s) : std::max(slack(a.s), slack(b.s));
  }

  // Proofs.
  [[nodiscard]] bool positive_between(const Jet& a, const Jet& b) const;
  [[nodiscard]] bool is_first_crossing(const Jet& a, Jet& root) const;
  [[nodiscard]] bool flat(const Jet& a, const Jet& b) const;

  // Roots, minima and where to divide a panel.
  [[nodiscard]] double accept_root(const Jet& a, const Jet& b);
  Jet polish(double s);
  void polish(Jet& j);
  [[nodiscard]] Jet minimum(const Jet& a, const Jet& b);
  [[nodiscard]] double sign_change(double low, double high);
  [[nodiscard]] Jet split_point(const Jet& a, const Jet& b);
  [[nodiscard]] double split(const Jet& a, const Jet& b, int depth);

  const ExponentialBasis& basis_;
  const Guard& guard_;
  int index_;
  GuardJets jets_;
  SearchGrazings& grazings_;
  SearchCount& count_;
  long last_;           ///< count of splits after which no panel is divided
  double sixth_ = 0.0;  ///< bounds on the panel: d^6 g/d(fastest() s)^6, |g''|, the sum of amplitudes
  double curvature_ = 0.0;
  double amplitude_ = 0.0;
  double polished_ = -1.0;  ///< time at which Halley's iteration has converged; root_values_ belong to it
  ExponentialBasis::Values root_values_;
};

/// The jet at a grazing where two panels meet: the guard counts as positive on both sides of it.
[[nodiscard]] inline Jet as_grazing(const Jet& touched) {
  return {touched.s, 0.0, 0.0, std::max(touched.curvature, 0.0), 2};
}

}  // namespace dualdamp::core
