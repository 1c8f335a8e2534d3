#pragma once
/// A result directory that another run wrote before: what of it goes, and what the user is told.

#include <string>
#include <vector>

#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// Writes the files of a run and its page. Tables of the run before it that this one does not write are removed;
/// files of others stay, and so does a table that was this run's data; one whose name is needed is renamed. Returns
/// what to tell: that the result of another input was replaced, what was renamed.
[[nodiscard]] std::vector<std::string> write_results(const std::string& directory, const std::string& source,
                                                     const std::vector<std::string>& data_sha256,
                                                     const std::vector<scenarios::OutputFile>& files);

/// Writes files of results. One that is there and that the program did not write is renamed, and so is data that a
/// run has read. Returns what to tell. Errors: `scenarios::OutputError`.
[[nodiscard]] std::vector<std::string> write_keeping(const std::string& directory,
                                                     const std::vector<scenarios::OutputFile>& files,
                                                     const std::vector<std::string>& data_sha256 = {});

}  // namespace dualdamp::cli
