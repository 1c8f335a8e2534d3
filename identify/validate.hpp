#pragma once
/// Are a record and the constants beside it sound? For callers who build them by hand: the readers of data files
/// and scenarios give sound ones.
///
/// A fault is what no measurement can be: signals of one history with different lengths, a sample that is not
/// finite, a frequency that is not positive, a mass that is not positive. A quantity that was not measured is
/// `unknown` and no fault. Methods leave out pairs and histories that they cannot use and say so: that is no fault
/// either.
///
/// Errors: none thrown by `faults_of`; `require_sound` throws a `core::InputError` with all faults. Cost: linear.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Every message names the place: "pair 3: the forcing frequency is not positive and finite".
[[nodiscard]] std::vector<core::Diagnostic> faults_of(const Record& record);

/// Mass > 0, stiffness >= 0, frequency > 0, each finite or unknown.
[[nodiscard]] std::vector<core::Diagnostic> faults_of(const KnownConstants& constants);

void require_sound(const Record& record);

/// Why the signals of a history do not belong together; empty when they do. Length and rate alone: no sample is
/// looked at.
[[nodiscard]] std::string shape_fault(const History& history);

}  // namespace dualdamp::identify
