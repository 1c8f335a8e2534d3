#pragma once
/// Measured data: the keys that name a file, and the record in it.

#include <vector>

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// `data`, and the keys for information that the file does not contain: `units`, `columns`, `scale`, `decimal`,
/// `no_header`, `sample_rate`.
[[nodiscard]] std::vector<Field> data_fields();

/// A list of data files `analysis.NAME`, each with the same keys, whether it is a friction loop, and the noise of
/// its signals.
[[nodiscard]] Field data_list(const std::string& name, std::string meaning);

/// Reads the records of such a list into `file.files`.
void read_data_list(CheckedFile& file, const std::string& name);

/// Marks of the readings of the files of `analysis.data`, by which a prediction knows them again
/// (`identify::marks_of`).
[[nodiscard]] std::vector<double> marks_of_files(const Json& analysis, const std::vector<DataFile>& files);

/// Refuses files of `analysis.data` whose readings are among these marks: a record that was fitted predicts itself.
void refuse_fitted(CheckedFile& file, const std::vector<double>& marks);

/// Reads the record of `analysis.data`, if it is there, into `file.data`.
void read_data(CheckedFile& file);

/// Adds a problem if pairs were measured at a frequency that neither the file nor the scenario states.
void check_frequency(CheckedFile& file, const identify::Record& record);

}  // namespace dualdamp::scenarios
