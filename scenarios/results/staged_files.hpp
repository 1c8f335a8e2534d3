#pragma once
/// Files that become those of a directory all at once.
///
/// They are written to a subdirectory, `.dualdamp.partial`, and get their final names when all are complete. So an
/// error, such as a full disk, leaves the files that were there. A lock (flock) in the subdirectory keeps other
/// processes out, so that the files of two runs are never mixed; they wait for up to a minute. A file system may
/// have no locks. What a killed program has left in the subdirectory is removed by the next one.
///
/// Errors: `OutputError`; `core::Cancelled` while waiting.

#include <mutex>
#include <string>
#include <vector>

#include "scenarios/results/files.hpp"

namespace dualdamp::scenarios {

class StagedFiles {
 public:
  /// Creates the directory if necessary, and locks it.
  explicit StagedFiles(std::string directory);
  /// Removes the files that were not published.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Writes a file to `path`; from any thread.
  void write(const OutputFile& file);
  /// Renames the files into `directory`, in the order in which they were written.
  void publish();

  [[nodiscard]] const std::string& directory() const { return directory_; }
  /// The subdirectory with the files that are not published yet.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[nodiscard]] bool lock();
  void wait_for_lock();
  void remove_leftovers() const;
  [[nodiscard]] std::string staged(const std::string& name) const { return path_ + "/" + name; }
  [[nodiscard]] std::string final(const std::string& name) const;

  std::string directory_;
  std::string path_;
  int lock_ = -1;
  std::mutex mutex_;  ///< of the names
  std::vector<std::string> names_;
};

}  // namespace dualdamp::scenarios
