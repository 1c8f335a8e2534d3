#pragma once
/// Gross faults of a record: readings that this oscillator cannot give with any friction.
///
/// A wrong unit makes a factor of 1000 or 9.8, a wrong column a wrong sign. The checks need no model of friction:
/// * times: the frequency of the motion against the stated or the natural frequency. Finds milliseconds or minutes
///   read as seconds and, for extremes of a free vibration, numbers of samples;
/// * x, v and a at the main frequency w of a history, |a| = w |v| = w^2 |x|; or mean v^2 = (w x)^2/2 of a pair;
/// * the balance of forces, |k - m w^2| x <= k Y. Damping and friction act at right angles to it;
/// * the same balance with frequencies that are numbers of hertz, read as rad/s
/// (identify/records/faults/frequency_unit.hpp);
/// * the work of the base in a period, pi k Y x sin(phase) >= 0. If it is negative, x and Y are swapped or one of
///   them has a wrong sign. Without a phase, the line x(Y) is checked: swapped columns give zeta > 1 and F0 < 0;
/// * the work of the force or base of a history, less the energy that the motion begins with
///   (identify/records/faults/drive_work.hpp);
/// * the balance of forces of a history with the gain of the drive free (identify/records/faults/drive_gain.hpp);
/// * the phase in the balance of forces, k Y cos(phase) = (k - m w^2) x. Finds degrees read as radians;
/// * speeds above 50 m/s and accelerations above 10,000 m/s^2, if no unit was stated.
/// The limits are wide: factors of 5 and more, in most of the pairs. Smaller faults are left to the verdict.
///
/// Errors: none thrown. Cost: linear.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/setting.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// `record`: after `complete` (identify/records/derived_records.hpp). `assumed`: columns without a stated unit.
[[nodiscard]] std::vector<core::Diagnostic> gross_faults(const Record& record, const KnownConstants& constants,
                                                         const std::vector<std::string>& assumed,
                                                         const std::string& file,
                                                         const core::SettingWords& words = {});

/// Warnings about unusual, but possible readings: pairs at resonance with a damping ratio below 2e-4 or above 20,
/// angles beyond two turns, speeds of a motion above 1000 m/s.
[[nodiscard]] std::vector<std::string> odd_readings(const Record& record, const KnownConstants& constants);

}  // namespace dualdamp::identify
