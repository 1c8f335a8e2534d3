#pragma once
/// The extremes of a free vibration as readings: the engines compute a release from rest under any law. The release
/// and the sensor's offset are free beside F0 and c.
///
/// At the release, bristles and contacts are relaxed. Extremes that free_decay leaves out, because the mass should
/// have come to rest before, are left out here, too.
///
/// Cost: one decay for each derivative; 0.1 ms under laws of the exact engine, some milliseconds under others.

#include <memory>
#include <string>
#include <variant>

#include "identify/methods/any_law/reading_model.hpp"

namespace dualdamp::identify {

/// The model, or why there is none: there are fewer than six usable extremes, or plain friction is not positive.
[[nodiscard]] std::variant<std::unique_ptr<const ReadingModel>, std::string> decay_readings(
    const Record& record, const KnownConstants& constants, double sigma_x);

/// Extremes that are planned on the rig of another record, after a release at `release` [m]. `extremes`: what would
/// be read. `deviation`: of an extreme [m].
[[nodiscard]] std::unique_ptr<const ReadingModel> planned_decay(const ReadingModel& record, double release,
                                                                Eigen::VectorXd extremes,
                                                                const KnownConstants& constants, double deviation);

}  // namespace dualdamp::identify
