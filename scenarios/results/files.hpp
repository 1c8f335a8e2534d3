#pragma once
/// Reading of files with a limit of size, and writing that leaves either the old file or the complete new one.

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::scenarios {

/// The bytes of a file. A missing file, a directory, no permission, more than `limit` bytes: `core::InputError`.
[[nodiscard]] std::string read_file(const std::string& path, std::size_t limit);

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

/// Creates `directory` if necessary and writes the files there. Each file is written under another name and renamed
/// when complete. Errors: `OutputError`; files written before the error stay.
void write_files(const std::string& directory, const std::vector<OutputFile>& files);

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
