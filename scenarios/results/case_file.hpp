#pragma once
/// The file of finished cases of a campaign or points of a sweep: one line of JSON each, written at once, so that
/// whatever ends the program loses no more than the cases under way.
///
/// A line begins with `{"case":NUMBER,`. The first line names the campaign by the fingerprint of its resolved
/// scenario and program. `resume` reads which
/// cases are there, cuts off a last line that is torn, and refuses a file of another campaign. `finish` puts the
/// lines into the order of the case numbers; memory is 8 bytes a case. Several processes write a part each
/// (`NAME.1.jsonl`, ...), which `finish` gathers.
///
/// Errors: `core::InputError` for a file of another campaign, `scenarios::OutputError` for one that cannot be
/// written.

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace dualdamp::scenarios {

class CaseFile {
 public:
  /// `name`: of the file, without .jsonl; `part`: number of the process, of which 0 writes NAME.jsonl itself.
  CaseFile(std::string directory, std::string name, const std::string& fingerprint, std::size_t cases,
           int part = 0);
  ~CaseFile();
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  /// Begins anew: parts of an earlier run are removed.
  void begin();
  /// Goes on with what is there.
  void resume();

  [[nodiscard]] bool is_finished(std::size_t number) const { return finished_[number]; }
  [[nodiscard]] std::size_t finished() const;

  /// Adds a line with one write; from any thread.
  void add(std::size_t number, const std::string& line);

  /// Gathers all parts, in order, into NAME.jsonl. Called by one process when the others have closed theirs.
  void finish();
  void close();

  /// Reads the lines in order after `finish`.
  [[nodiscard]] std::string path() const { return part_path(0); }

 private:
  struct Place {
    int part = -1;
    long offset = 0;
  };

  [[nodiscard]] std::string part_path(int part) const;
  [[nodiscard]] std::vector<int> parts() const;
  void open(bool fresh);
  void write_line(const std::string& text);
  /// Notes the whole lines of a part; returns how many bytes they take.
  long scan(int part, std::vector<Place>& places) const;

  std::string directory_;
  std::string name_;
  std::string head_;  ///< first line of every part
  int part_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::vector<bool> finished_;
};

}  // namespace dualdamp::scenarios
