#pragma once
/// What the uncertainty of stated constants does to an estimate.
///
/// A mass, a stiffness, a frequency or the gain of a sensor that is off by its standard uncertainty u moves an
/// estimate theta by d = (theta(+u) - theta(-u))/2: the record is read twice more for each of them. theta is the
/// middle of the interval, which a method that knows its bias has corrected. They
/// are off once for the whole record, so that no number of readings averages them out. The constants err
/// independently: variances d^2 add to those that the readings leave, and each side of a 95 % interval becomes
/// sqrt(side^2 + sum (1.96 d)^2).
/// Source: gum2008, 5.1.2. Cost: two readings for each uncertain constant.

#include <functional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Standard uncertainties (one standard deviation), >= 0; 0: none is stated.
struct ConstantUncertainties {
  double mass = 0.0;       ///< kg
  double stiffness = 0.0;  ///< N/m
  double frequency = 0.0;  ///< rad/s
  /// Relative, of the gain of each sensor. `gain_y` is that of Y and y.
  double gain_y = 0.0, gain_x = 0.0, gain_v = 0.0, gain_a = 0.0, gain_force = 0.0;

  [[nodiscard]] bool any() const;
};

/// How an estimate answers to one constant that is 1 % higher.
struct Sensitivity {
  std::string constant;      ///< "mass", "stiffness", "frequency", "gain of x", ...
  double zeta_change = 0.0;  ///< relative; NaN where there is no spring and so no zeta
  double F0_change = 0.0;    ///< relative
};

/// How an estimate follows from a record and constants: a method with its options, for example.
using Reader = std::function<Estimate(const Record&, const KnownConstants&)>;

/// What `read` gives, with the uncertainties of the constants in its standard errors, covariance and intervals. A
/// warning says where it gives no estimate for a constant that is off by its uncertainty.
[[nodiscard]] Estimate with_uncertainties(const Reader& read, const Record& record, const KnownConstants& constants,
                                          const ConstantUncertainties& uncertainties);

/// How `stated`, which `read` gives, answers to each constant that it depends on and whose uncertainty is not
/// stated, the strongest first. Cost: a reading for each constant.
[[nodiscard]] std::vector<Sensitivity> sensitivities(const Reader& read, const Estimate& stated,
                                                     const Record& record, const KnownConstants& constants,
                                                     const ConstantUncertainties& uncertainties);

}  // namespace dualdamp::identify
