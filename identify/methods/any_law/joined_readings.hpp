#pragma once
/// Readings of two tests of one rig as one record, such as steady states and a free vibration.
///
/// The tests share F0, c, and nuisances of the same name. Channels of the same number are those of the same sensor;
/// the known deviations are those of the first test. Each test has a smooth curve of its own.

#include <memory>

#include "identify/methods/any_law/reading_model.hpp"

namespace dualdamp::identify {

/// `first` must live as long as the result. The search begins at its unknowns `start`.
[[nodiscard]] std::unique_ptr<const ReadingModel> joined_readings(const ReadingModel& first,
                                                                  std::unique_ptr<const ReadingModel> second,
                                                                  const Eigen::VectorXd& start);

}  // namespace dualdamp::identify
