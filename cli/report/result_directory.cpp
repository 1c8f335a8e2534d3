#include "cli/report/result_directory.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>

#include "cli/report/report.hpp"
#include "core/provenance.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;

/// A table of an earlier run may be what was read: history.csv of a simulation, identified in its own directory.
bool is_data(const fs::path& path, const std::vector<std::string>& data_sha256) {
  if (data_sha256.empty()) return false;
  const std::string sum =
      core::sha256(scenarios::read_file(path.string(), std::numeric_limits<std::size_t>::max()));
  return std::ranges::find(data_sha256, sum) != data_sha256.end();
}

void remove_stale(const fs::path& directory, const StoredResult& before,
                  const std::vector<std::string>& data_sha256, const std::vector<scenarios::OutputFile>& files) {
  for (const std::string& name : before.tables) {
    const bool is_written = std::ranges::find(files, name, &scenarios::OutputFile::name) != files.end();
    if (is_written || is_data(directory / name, data_sha256)) continue;
    std::error_code error;
    fs::remove(directory / name, error);  // a table that stays is told from ours by its provenance
  }
}

}  // namespace

std::vector<std::string> write_results(const std::string& directory, const std::string& source,
                                       const std::vector<std::string>& data_sha256,
                                       const std::vector<scenarios::OutputFile>& files) {
  std::vector<std::string> messages;
  const std::optional<StoredResult> before = stored_result(directory);
  if (before && before->source != source)
    messages.push_back(directory + " held the result of " + before->source +
                       ", which is replaced; --out DIR keeps results apart");
  scenarios::write_files(directory, files);
  if (before) remove_stale(directory, *before, data_sha256, files);
  scenarios::write_files(directory, {report_page(directory)});
  return messages;
}

}  // namespace dualdamp::cli
