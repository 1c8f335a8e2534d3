#pragma once
/// The checks of single analyses that `check` calls in turn. Each adds problems to the file and completes its
/// values.

#include <optional>
#include <string>
#include <vector>

#include "identify/readers/record_reader.hpp"
#include "scenarios/checked_file.hpp"
#include "scenarios/checks.hpp"

namespace dualdamp::scenarios {

/// A motion followed in time, which `section` of the file at `path` asks for, `tests` times over.
void check_work(CheckedFile& file, const Json& section, const std::string& path, std::optional<double> rate,
                double tests);

/// Rows of all histories together.
void check_rows(CheckedFile& file, double rows);

/// Of `identify`: the synthetic measurement and its sensors.
void check_measurement(CheckedFile& file);

/// A record of the kind that the measurement will give: enough to tell which methods it allows.
[[nodiscard]] identify::Record outline(const CheckedFile& file);

/// The record of `analysis.data`, if it is there.
[[nodiscard]] std::optional<identify::MeasuredRecord> read_data(CheckedFile& file, const CheckOptions& options);

/// Methods of `identify`, for the data or for the measurement's outline.
void resolve_methods(CheckedFile& file, const std::optional<identify::MeasuredRecord>& data);

/// All methods that each of such records allows, or those of the file, which each must allow.
void resolve_methods_for(CheckedFile& file, const std::vector<identify::Record>& records);

/// The system has one Coulomb law and damping, and nothing else: the analysis departs from it.
void check_truth(CheckedFile& file);

void check_stress_test(CheckedFile& file);

void check_mechanisms(CheckedFile& file);

/// Paths of `expect` against what the analysis returns.
void check_expectations(CheckedFile& file);

}  // namespace dualdamp::scenarios
