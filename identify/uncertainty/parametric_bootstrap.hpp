#pragma once
/// Intervals from the parametric bootstrap: bias and scatter of a method on records whose truth is known.
///
/// The method's own estimate theta is taken as the truth of synthetic records. A synthetic record obeys the assumed
/// law exactly with these parameters, moves like the measured mass, and has the noise of the measured record
/// (synthetic_record.hpp). The same method reads B of them, each with other noise:
///
///   b = mean(theta*) - theta,   S = covariance(theta*),   interval: theta - b +- t_(B-1) sqrt(S (1 + 1/B))
///
/// Bias by noise in the regressors, by a filter's gain or by a smoothed sign thus moves the middle of the interval.
/// The estimate itself is not changed. No synthetic record contains what the law leaves out. If the method's own
/// standard error, from its residuals, is larger than on every synthetic record (by chance once in B + 1 times),
/// the interval is widened by the ratio of this error to their root mean square. It is then also widened by the
/// bias, which need not be that of the record. The interval is never narrowed.
///
/// A bias that depends on the parameters is that at theta - b, not at theta: where it is large, the records are
/// made again with theta - b until b settles (iterated bootstrap).
///
/// Draws depend on the record and the number of the synthetic record. Source: efron1993 (parametric bootstrap).
/// Cost: B times that of the method, and B x 50 ns a sample and noisy signal; up to four times that where the bias
/// is large.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/models/force_parameters.hpp"
#include "identify/record.hpp"
#include "identify/records/usable_histories.hpp"

namespace dualdamp::identify {

inline constexpr int synthetic_count = 40;

/// Place of a sensor's offset [N] behind m, c, k and F0.
inline constexpr Eigen::Index offset_place = 4;

/// What a method estimates from one record: m, c, k, F0, and then its further parameters.
struct ParameterReading {
  Eigen::VectorXd parameters;
  Eigen::VectorXd errors;  ///< standard errors from the residuals; 0: a constant
};

struct BootstrapSpread {
  Eigen::VectorXd bias;        ///< of each of the parameters
  Eigen::MatrixXd covariance;  ///< of one reading
  double half_width = 0.0;     ///< of a 95 % interval in standard errors
};

/// `own`: the method on the measured record. `truth`: parameters of the synthetic records, m, c, k, F0 and what the
/// method estimates beside them. `draw(b)`: synthetic record number b. `read`: the method; nothing if it refuses.
/// Returns nothing if the method refuses more than one record in ten, or if its bias is as large as the mass or the
/// stiffness.
[[nodiscard]] std::optional<BootstrapSpread> bootstrap_spread(
    const ParameterReading& own, const Eigen::VectorXd& truth, const std::function<Record(int)>& draw,
    const std::function<std::optional<ParameterReading>(const Record&)>& read, int records = synthetic_count);

/// Number of synthetic records for a record of so many samples: fewer for long ones, 12 from 200,000 samples on.
/// Their intervals are then 12 % wider, and keep their coverage by the quantile and 1/B.
[[nodiscard]] int synthetic_records_for(std::size_t samples);

/// The spread over synthetic records made with the parameters of `own`, less their bias if that is more than 0.3
/// standard errors. `offset`: a constant force [N]. `read` as above.
[[nodiscard]] std::optional<BootstrapSpread> parametric_bootstrap(
    const std::vector<NumberedHistory>& histories, const ParameterReading& own, double offset,
    const std::function<std::optional<ParameterReading>(const Record&)>& read);

/// Sets the value, and from the spread standard errors, intervals, covariance and correlation of (zeta, F0). Warns
/// if the bias is more than half a standard error and a thousandth of the value. Without a spread, sets the value
/// alone and adds the finding that no interval is claimed.
void set_estimate(Estimate& estimate, const ForceParameters& force, const std::optional<BootstrapSpread>& spread);

/// Parameter `index` of the readings, with its interval if there is a spread.
[[nodiscard]] FurtherParameter further(std::string name, std::string unit, double value,
                                       const std::optional<BootstrapSpread>& spread, Eigen::Index index);

}  // namespace dualdamp::identify
