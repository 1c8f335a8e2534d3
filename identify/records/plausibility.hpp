#pragma once
/// Gross faults of a record: what no measurement of this oscillator can be, whatever its friction.
///
/// A wrong unit is off by 1000 or by 9.8, a wrong column by a sign: found without a model of friction, from
/// * times against the stated or the natural frequency: seconds that are milliseconds or minutes; of extremes of a
///   free vibration also numbers of samples;
/// * x, v and a at the main frequency of a history, |a| = w |v| = w^2 |x|, or at that of a pair, mean v^2 = (w
/// x)^2/2;
/// * the balance of forces, |k - m w^2| x <= k Y: dampers and friction act across it;
/// * work: the base puts in pi k Y x sin(phase) a period, which is not below zero. Otherwise x and Y are swapped,
///   or one of both has the other sign. So does a force, but for the energy of the motion. Without a phase the line
///   x(Y) tells: swapped, it has zeta > 1 and F0 < 0;
/// * phase and balance of forces, k Y cos(phase) = (k - m w^2) x: degrees that are radians;
/// * where no unit was stated: speeds above 50 m/s and accelerations above 10,000 m/s^2.
/// Limits are wide: factors of 5 and more, most of the pairs. What is closer is a matter of the verdict.
///
/// Errors: none thrown. Cost: linear.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// `record` is completed (identify/records/derived_records.hpp). `assumed`: columns for which no unit was stated.
[[nodiscard]] std::vector<core::Diagnostic> gross_faults(const Record& record, const KnownConstants& constants,
                                                         const std::vector<std::string>& assumed,
                                                         const std::string& file);

/// Warnings of what is unusual, though a rig may be so: pairs at resonance with a damping ratio below 2e-4 or above
/// 20, angles beyond two turns.
[[nodiscard]] std::vector<std::string> odd_readings(const Record& record, const KnownConstants& constants);

}  // namespace dualdamp::identify
