#pragma once
/// Reading of files with a limit of size, and writing of single files; scenarios/results/staged_files.hpp writes
/// the files of a result.

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::scenarios {

/// The bytes of a file. More than `limit` bytes: `core::InputError`; others: as of `core::fail_to_read`.
[[nodiscard]] std::string read_file(const std::string& path, std::size_t limit);

/// The first bytes of a file, up to `count`. Errors: as of `core::fail_to_read`.
[[nodiscard]] std::string beginning_of(const std::string& path, std::size_t count);

/// The digest of a file of any size. Errors: as of `core::fail_to_read`.
[[nodiscard]] std::string sha256_of_file(const std::string& path);

/// Writes a whole document. So a result of gigabytes is never a text in memory.
using Writer = std::function<void(std::ostream&)>;

struct OutputFile {
  std::string name;
  Writer write;
  std::shared_ptr<std::string> sha256 = {};  ///< if not null: receives the digest of the written bytes
};

/// A text that a user may edit later, below a line with its digest: the program overwrites it only as long as
/// nobody has.
[[nodiscard]] std::string sealed(const std::string& text);
[[nodiscard]] bool is_sealed(std::string_view text);

/// Writes a file that must not exist. Returns 0 or errno; a part of the file may then be there.
[[nodiscard]] int write_new_file(const std::string& path, const OutputFile& content);

/// Opens a file for reading and writing, creates it if necessary, and locks it against other processes (flock). A
/// file system may have no locks. Returns the descriptor, or -1 and errno: EWOULDBLOCK if another process holds the
/// lock.
[[nodiscard]] int open_locked(const std::string& path, int flags = 0);

/// Gives a file a new name that is not in use, NAME~. Returns a message. Errors: `OutputError`.
[[nodiscard]] std::string set_aside(const std::string& path);

/// The output directory or a file in it cannot be written.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A directory holds files of an earlier run, which this one would replace. Whoever asked for the run says how to
/// go on: with these files if `may_resume`, anew, or in another directory.
class EarlierFiles : public OutputError {
 public:
  EarlierFiles(const std::string& message, bool may_resume) : OutputError(message), may_resume_(may_resume) {}

  [[nodiscard]] bool may_resume() const { return may_resume_; }

 private:
  bool may_resume_;
};

}  // namespace dualdamp::scenarios
