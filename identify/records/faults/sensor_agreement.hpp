#pragma once
/// Do two sensors read one motion? Neither a frequency nor mass and stiffness are needed: a decay of half a swing
/// tells.

#include <vector>

namespace dualdamp::identify {

/// A signal beside its derivative, over windows of about a sixth of a swing. A wrong unit changes the ratio alone,
/// a wrong sign that of the correlation. NaN: the record is too short, or one of them is constant.
struct SensorAgreement {
  double ratio = 0.0;        ///< deviation of the integrated derivative over that of the signal
  double correlation = 0.0;  ///< of both
};

/// `order` 1: `derivative` is the first one, 2: the second one. Integration averages the noise of the derivative;
/// constant errors of either have no effect. Cost: O(samples).
[[nodiscard]] SensorAgreement sensor_agreement(const std::vector<double>& signal,
                                               const std::vector<double>& derivative, int order,
                                               double sample_rate);

}  // namespace dualdamp::identify
