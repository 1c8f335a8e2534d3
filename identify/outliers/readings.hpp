#pragma once
/// The single readings of a record of steady states or extremes, and the joint model that they belong to.

#include <optional>
#include <string>

#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The joint model of steady states, or else of extremes; nothing if the record has none.
[[nodiscard]] std::optional<JointModel> model_of_readings(const Record& record, const KnownConstants& constants);

/// The value of a reading of the record [m, rad or s].
[[nodiscard]] double& value_of(Record& record, const Reading& reading);

/// "x of pair 7", "extreme 3"
[[nodiscard]] std::string name_of(const Reading& reading);

}  // namespace dualdamp::identify
