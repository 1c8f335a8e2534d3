#include "cli/report/result_directory.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>

#include "cli/report/report.hpp"
#include "cli/report/stored_run.hpp"
#include "scenarios/results/mat_file.hpp"

namespace dualdamp::cli {

namespace {

namespace fs = std::filesystem;

/// Whether a table of an earlier run was read by this run: history.csv of a simulation may be identified in its own
/// directory.
bool is_data(const fs::path& path, const std::vector<std::string>& data_sha256) {
  return !data_sha256.empty() &&
         std::ranges::find(data_sha256, scenarios::sha256_of_file(path.string())) != data_sha256.end();
}

/// The text with which every file of this kind begins, if the program wrote it.
std::string_view mark_of(const fs::path& path) {
  if (path.extension() == ".csv") return "# program: dualdamp ";
  if (path.extension() == ".json") return "{\n  \"program\": {\n    \"name\": \"dualdamp\"";
  if (path.extension() == ".html")
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
           "http-equiv=\"Content-Security-Policy\" ";
  if (path.extension() == ".mat") return scenarios::mat_heading;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ";
}

bool is_ours(const fs::path& path) {
  try {
    if (path.extension() == ".yaml")
      return scenarios::is_sealed(scenarios::read_file(path.string(), std::numeric_limits<std::size_t>::max()));
    return scenarios::beginning_of(path.string(), mark_of(path).size()) == mark_of(path);
  } catch (const std::system_error& fault) {
    if (fault.code() == std::errc::permission_denied) return false;  // a file of somebody else
    throw;
  }
}

/// Scenarios that a fit has written into the directory and nobody has changed.
std::vector<std::string> fitted_scenarios(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code error;  // a directory that cannot be read cannot be written either; the write reports it
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("fitted") && entry.path().extension() == ".yaml" && entry.is_regular_file(error) &&
        is_ours(entry.path()))
      names.push_back(name);
  }
  return names;
}

/// A table of an earlier run that the user has changed is the user's file.
bool is_as_written(const fs::path& table, const EarlierResult& before) {
  const auto sum = before.sums.find(table.filename().string());
  return sum == before.sums.end() || sum->second == scenarios::sha256_of_file(table.string());
}

/// Files of the earlier run that this run does not write.
std::vector<fs::path> stale_files(const fs::path& directory, const EarlierResult& before,
                                  const std::vector<std::string>& data_sha256,
                                  const std::vector<scenarios::OutputFile>& files) {
  std::vector<std::string> names = fitted_scenarios(directory);
  names.insert(names.end(), before.tables.begin(), before.tables.end());
  std::vector<fs::path> stale;
  for (const std::string& name : names) {
    const fs::path path = directory / name;
    const bool is_written = std::ranges::find(files, name, &scenarios::OutputFile::name) != files.end();
    if (!is_written && !is_data(path, data_sha256) && is_as_written(path, before)) stale.push_back(path);
  }
  return stale;
}

std::vector<std::string> set_others_aside(const fs::path& directory,
                                          const std::vector<scenarios::OutputFile>& files,
                                          const std::vector<std::string>& data_sha256) {
  std::vector<std::string> messages;
  for (const scenarios::OutputFile& file : files) {
    const fs::path path = directory / file.name;
    std::error_code unseen;  // a path that cannot be examined cannot be written either; the write reports it
    if (fs::is_regular_file(path, unseen) && (!is_ours(path) || is_data(path, data_sha256)))
      messages.push_back(scenarios::set_aside(path.string()));
  }
  return messages;
}

}  // namespace

std::vector<std::string> write_keeping(const std::string& directory,
                                       const std::vector<scenarios::OutputFile>& files) {
  scenarios::StagedFiles staged(directory);
  for (const scenarios::OutputFile& file : files) staged.write(file);
  std::vector<std::string> messages = set_others_aside(directory, files, {});
  staged.publish();
  return messages;
}

std::vector<std::string> write_results(scenarios::StagedFiles& staged, const std::string& source,
                                       const std::vector<std::string>& data_sha256,
                                       std::vector<scenarios::OutputFile> files) {
  const std::string& directory = staged.directory();
  std::vector<std::string> messages;
  const std::optional<EarlierResult> before = earlier_result(directory);
  if (before && before->source != source)
    messages.push_back(directory + " held the result of " + before->source +
                       ", which is replaced; --out DIR keeps results apart");
  for (const scenarios::OutputFile& file : files) staged.write(file);
  files.push_back(report_page(staged.path()));
  staged.write(files.back());
  std::vector<fs::path> stale;
  if (before) stale = stale_files(directory, *before, data_sha256, files);
  std::ranges::copy(set_others_aside(directory, files, data_sha256), std::back_inserter(messages));
  staged.publish();
  std::error_code error;  // if a file cannot be removed, its provenance still shows the other run
  for (const fs::path& path : stale) fs::remove(path, error);
  return messages;
}

}  // namespace dualdamp::cli
