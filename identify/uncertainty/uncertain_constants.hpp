#pragma once
/// The effect of uncertain constants on an estimate.
///
/// An error of one standard uncertainty u in a mass, a stiffness, a frequency or the gain of a sensor changes an
/// estimate theta by d = (theta(+u) - theta(-u))/2: the record is read twice more for each of them. For methods
/// that know their bias, theta is the middle of the interval, which is corrected for it. Such an error is the same
/// in the whole record, so no number of readings averages it out. The errors are independent: variances d^2 add to
/// those by the readings, and each side of a 95 % interval becomes sqrt(side^2 + sum (1.96 d)^2). Source:
/// gum2008, 5.1.2. Where both signs change theta the same way, d is the larger change. Of an uncertainty of more
/// than 5 %, errors of its half, quarter, ... down to some 3 % are tried as well, and the largest d counts: a
/// record may tell a large error and correct it. Cost: two readings for each error.

#include <array>
#include <functional>
#include <string>
#include <string_view>
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

/// One of the numbers that a laboratory states: a constant, or the gain of the sensor of a signal.
struct StatedNumber {
  std::string_view name;  ///< of the constant, or of the signal
  double ConstantUncertainties::* uncertainty = nullptr;
  double KnownConstants::* constant = nullptr;  ///< nullptr: a gain, whose uncertainty is relative

  [[nodiscard]] bool is_gain() const { return constant == nullptr; }
  /// "mass", "gain of x"
  [[nodiscard]] std::string text() const { return (is_gain() ? "gain of " : "") + std::string(name); }
  /// The uncertainty as a share of the number; 0 where none is stated.
  [[nodiscard]] double relative(const ConstantUncertainties& uncertainties, const KnownConstants& constants) const {
    const double deviation = uncertainties.*uncertainty;
    if (!(deviation > 0.0)) return 0.0;
    return is_gain() ? deviation : deviation / constants.*constant;
  }
};

inline constexpr std::array<StatedNumber, 8> stated_numbers = {
    {{"mass", &ConstantUncertainties::mass, &KnownConstants::mass},
     {"stiffness", &ConstantUncertainties::stiffness, &KnownConstants::stiffness},
     {"frequency", &ConstantUncertainties::frequency, &KnownConstants::frequency},
     {"y", &ConstantUncertainties::gain_y},
     {"x", &ConstantUncertainties::gain_x},
     {"v", &ConstantUncertainties::gain_v},
     {"a", &ConstantUncertainties::gain_a},
     {"force", &ConstantUncertainties::gain_force}}};
static_assert(sizeof(ConstantUncertainties) == stated_numbers.size() * sizeof(double),
              "each uncertainty has a row in this table");

/// So many standard uncertainties count when constants and gains are said to be as stated: a level of 1 %.
inline constexpr double counted_deviations = 2.6;

/// Relative standard uncertainty of m w^2/k.
[[nodiscard]] double relative_of_inertia(const ConstantUncertainties& uncertainties,
                                         const KnownConstants& constants);

/// Change of an estimate when one constant is 1 % higher.
struct Sensitivity {
  std::string constant;      ///< text of a `StatedNumber`: "mass", "stiffness", "frequency", "gain of x", ...
  double zeta_change = 0.0;  ///< relative; NaN where there is no spring and so no zeta
  double F0_change = 0.0;    ///< relative
};

/// How an estimate follows from a record and constants: a method with its options, for example.
using Reader = std::function<Estimate(const Record&, const KnownConstants&)>;

/// The estimate of `read`, with the uncertainties of the constants in its standard errors, covariance and
/// intervals. A warning names each constant for which `read` gives no estimate when it is off by its uncertainty;
/// the estimate then has no standard errors and no intervals.
[[nodiscard]] Estimate with_uncertainties(const Reader& read, const Record& record, const KnownConstants& constants,
                                          const ConstantUncertainties& uncertainties);

/// Sensitivity of `stated`, the estimate of `read`, to each constant that it depends on and whose uncertainty is
/// not stated; the strongest first. Cost: one reading for each constant.
[[nodiscard]] std::vector<Sensitivity> sensitivities(const Reader& read, const Estimate& stated,
                                                     const Record& record, const KnownConstants& constants,
                                                     const ConstantUncertainties& uncertainties);

}  // namespace dualdamp::identify
