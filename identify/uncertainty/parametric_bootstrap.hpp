#pragma once
/// Intervals from the parametric bootstrap: how far a method errs, and how much it scatters, where the truth is
/// known.
///
/// The method's own estimate theta is taken for the truth of a synthetic record. A synthetic record obeys the
/// assumed law exactly with those parameters, moves as the measured mass does, and is noisy as the measured record
/// is (synthetic_record.hpp). The very same method reads B of them, each with other noise:
///
///   b = mean(theta*) - theta,   S = covariance(theta*),   interval: theta - b +- t_(B-1) sqrt(S (1 + 1/B))
///
/// So what noise in the regressors, a filter's gain or a smoothed sign do to the method moves the middle of the
/// interval. The estimate itself stays what the method gives. What the law leaves out is in no synthetic record:
/// where the method's own standard error, from its residuals, is larger than on every synthetic record (which
/// chance does once in B + 1 times), the interval widens by its ratio to their mean, and by the bias, which need
/// not be that of the record then; it never narrows.
///
/// Draws depend on the record and the number of the synthetic record. Source: efron1993 (parametric bootstrap).
/// Cost: B times that of the method, and B x 50 ns a sample and noisy signal.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/models/force_parameters.hpp"
#include "identify/record.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

inline constexpr int synthetic_count = 40;

/// Place of a sensor's offset [N] behind m, c, k and F0.
inline constexpr Eigen::Index offset_place = 4;

/// What a method makes of one record: m, c, k, F0, and after them what else it estimates.
struct ParameterReading {
  Eigen::VectorXd parameters;
  Eigen::VectorXd errors;  ///< standard errors as the residuals show them; 0: a constant
};

struct BootstrapSpread {
  Eigen::VectorXd bias;        ///< of each of the parameters
  Eigen::MatrixXd covariance;  ///< of one reading
  double half_width = 0.0;     ///< of a 95 % interval in standard errors
};

/// `draw(b)`: the record of number b; `read`: the method, nothing where it refuses. `truth`: what they
/// were made with: m, c, k, F0 and what the method estimates beside them. Nothing when the method refuses more than
/// one record in ten, or its bias is as large as the mass or the stiffness.
[[nodiscard]] std::optional<BootstrapSpread> bootstrap_spread(
    const ParameterReading& own, const Eigen::VectorXd& truth, const std::function<Record(int)>& draw,
    const std::function<std::optional<ParameterReading>(const Record&)>& read, int records = synthetic_count);

/// How many synthetic records of so many samples are read: fewer of long ones, 12 from 200,000 samples on, whose
/// intervals are 12 % wider for it. The quantile and 1/B keep their coverage.
[[nodiscard]] int synthetic_records_for(std::size_t samples);

/// The spread over synthetic records of the synthetic record that `own` is the truth of. `offset`: a constant force
/// [N].
[[nodiscard]] std::optional<BootstrapSpread> parametric_bootstrap(
    const std::vector<NumberedHistory>& histories, const ParameterReading& own, double offset,
    const std::function<std::optional<ParameterReading>(const Record&)>& read);

/// Value, and from the spread standard errors, intervals, covariance and correlation of (zeta, F0); a warning where
/// the bias is more than half a standard error and a thousandth of the value. Without a spread the value alone, and
/// a warning that no interval is claimed.
void set_estimate(Estimate& estimate, const ForceParameters& force, const std::optional<BootstrapSpread>& spread);

/// Parameter `index` of the readings.
[[nodiscard]] FurtherParameter further(std::string name, std::string unit, double value,
                                       const std::optional<BootstrapSpread>& spread, Eigen::Index index);

}  // namespace dualdamp::identify
