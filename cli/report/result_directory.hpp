#pragma once
/// Writes results to a directory that may hold files of an earlier run or of the user.

#include <string>
#include <vector>

#include "scenarios/results/staged_files.hpp"

namespace dualdamp::cli {

/// Writes the files of a run and its page, all at once. Tables of the earlier run that this run does not write are
/// removed. Files of others are kept, and so is a table that this run has read; if its name is needed, it is
/// renamed. Returns messages: the result of another input was replaced, a file was renamed. Errors:
/// `scenarios::OutputError`; the files of the earlier run then stay.
[[nodiscard]] std::vector<std::string> write_results(scenarios::StagedFiles& staged, const std::string& source,
                                                     const std::vector<std::string>& data_sha256,
                                                     std::vector<scenarios::OutputFile> files);

/// Writes files of results, all at once. An existing file of the same name is renamed if the program did not write
/// it. Returns messages. Errors: `scenarios::OutputError`.
[[nodiscard]] std::vector<std::string> write_keeping(const std::string& directory,
                                                     const std::vector<scenarios::OutputFile>& files);

}  // namespace dualdamp::cli
