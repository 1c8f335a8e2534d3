#pragma once
/// Checks of a record and of constants. They are for callers who build them by hand; the readers of data files and
/// scenarios give sound ones.
///
/// A fault is something that no measurement can give: signals of one history with different lengths, a sample that
/// is not finite, a frequency that is not positive, a mass that is not positive. A quantity that was not measured
/// is `unknown`, which is no fault. Pairs and histories that a method cannot use are no faults either: the method
/// leaves them out and lists them.
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

/// Why the samples of a history have no meaning; empty when they do.
[[nodiscard]] std::string sample_fault(const History& history);

/// Why the signals of a history do not belong together; empty when they do. Checks lengths and rate only, no
/// samples.
[[nodiscard]] std::string shape_fault(const History& history);

}  // namespace dualdamp::identify
