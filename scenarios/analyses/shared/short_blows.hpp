#pragma once
/// Blows of the force on the mass that have too few samples, in the records of a fit or a prediction
/// (identify/records/short_blow.hpp).

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// The drive of a history that follows a short blow of its column force, or of a force that the scenario states:
/// none. Nothing if there is no such blow, or if the fit needs the force: where neither mass nor stiffness is
/// known, or where `initial` states the state before the blow. A warning then gives the error of the impulse.
/// `column`: what drives the history in place of the excitation; empty: nothing.
[[nodiscard]] std::optional<RecordDrive> drive_after_blow(CheckedFile& file, DataFile& data, std::size_t history,
                                                          const std::string& column);

/// Takes away a stated force that drives no history any more, because all of them follow its blow.
void withdraw_idle_blow(CheckedFile& file);

}  // namespace dualdamp::scenarios
