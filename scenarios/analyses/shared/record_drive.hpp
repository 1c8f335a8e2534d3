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

/// Makes the motion y of the base the excitation of the scenario, if the data are one file that holds it. A loop, a
/// file of several tests, and one that also holds a force have none.
void take_recorded_drive(CheckedFile& file);

}  // namespace dualdamp::scenarios
