#include "core/crossing/guard_jets.hpp"

namespace dualdamp::core {

double GuardJets::rounding(double s) const {
  ExponentialBasis::Values values;
  const bool factored = near_start(s);
  const double there = factored && basis_.fastest() > 0.0 ? 1.0 / basis_.fastest() : s;
  basis_.evaluate(there, values);
  return slack(s, bound(basis_, guard_.value, values, there, 0.0));
}

/// Elements that have left the range of double precision count only if the guard contains them.
void GuardJets::take_with_growth(const ExponentialBasis::Values& values, Jet& j) {
  j.value = evaluate(basis_, guard_.value, values);
  j.slope = evaluate(basis_, guard_.slope, values);
  j.curvature = evaluate(basis_, guard_.curvature, values);
}

void GuardJets::take_from_taylor_series(Jet& j) {
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

}  // namespace dualdamp::core
