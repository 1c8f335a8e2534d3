#pragma once
/// The extremes of a free vibration as readings, by the engines in time: a release from rest under any law. Beside
/// F0 and c the release and the sensor's offset are free.
///
/// The law's internal state is that of the release: bristles and contacts are relaxed. Extremes after which the
/// mass should have come to rest are those that free_decay leaves out.
///
/// Cost: one decay for each derivative; 0.1 ms under laws of the exact engine, some milliseconds under others.

#include <memory>
#include <string>
#include <variant>

#include "identify/methods/any_law/reading_model.hpp"

namespace dualdamp::identify {

/// The model, or why there is none: there is no decay with six extremes, or its plain friction is not positive.
[[nodiscard]] std::variant<std::unique_ptr<const ReadingModel>, std::string> decay_readings(
    const Record& record, const KnownConstants& constants, double sigma_x);

/// Extremes that are to be measured on the rig of another record, after a release at `release` [m]. `deviation` [m]
/// of an extreme. The readings themselves mean nothing.
[[nodiscard]] std::unique_ptr<const ReadingModel> planned_decay(const ReadingModel& record, double release,
                                                                int count, const KnownConstants& constants,
                                                                double deviation);

}  // namespace dualdamp::identify
