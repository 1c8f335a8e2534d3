#pragma once
/// The drive of a fit and the drive of its records.

#include <string>
#include <vector>

#include "scenarios/analyses/shared/fit_setup.hpp"

namespace dualdamp::scenarios {

/// Complains about histories that the drive of the model cannot have driven: it begins at another time or is over
/// before, or the record holds another motion of the base, or another force, than the drive. `drive_start`: time of
/// the first sample of the drive on the clock of its file [s]. `free`: names of parameters that are sought; a phase
/// that is sought is not compared.
void refuse_other_drives(const std::vector<DataItem>& items, const std::string& key, const sim::Model& model,
                         double drive_start, const std::vector<std::string>& free, std::vector<SetupFault>& faults);

/// What to do about a drive that the file holds and the model lacks; empty if there is none.
[[nodiscard]] std::string idle_drive(const DataItem& item, const sim::Model& model);

/// Why the histories of a file cannot be simulated with a stiffness of zero, and what can be done; else empty.
[[nodiscard]] std::string lacking_spring(const DataItem& item, double stiffness);

/// The drives that the records themselves hold, by cubic splines: the columns that `drive` of the data files names;
/// without it y, the motion of the base, of a file without force, if nothing else drives histories (`is_open`). A
/// single history makes its drive the excitation of the scenario. Each of several gets its own
/// (`DataFile::drives`), and so does one that does not begin with its file, or whose samples are too far apart for
/// cubics: it gets further samples between them (`identify/statistics/finer_samples.hpp`).
void take_recorded_drives(CheckedFile& file, bool is_open);

/// Whether the scenario states nothing that drives histories: no excitation, or the frequency of x-Y pairs alone.
[[nodiscard]] bool leaves_drive_open(const CheckedFile& file);

/// Warns of histories that nothing drives beside histories with drives of their own.
[[nodiscard]] std::vector<std::string> undriven_warnings(const std::vector<DataItem>& items,
                                                         const sim::Model& model);

/// Warning about a stated drive of histories that was sampled too coarsely for the straight lines or cubics between
/// its samples.
[[nodiscard]] std::vector<std::string> drive_warnings(const std::vector<DataItem>& items, const sim::Model& model);

/// `excitation` of a scenario of this experiment; `shared`: that of the scenario of the fit.
[[nodiscard]] Json excitation_of(const identify::Experiment& experiment, const std::vector<DataItem>& items,
                                 const Json& shared);

}  // namespace dualdamp::scenarios
