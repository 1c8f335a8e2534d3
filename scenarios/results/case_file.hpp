#pragma once
/// The file of finished cases of a campaign or points of a sweep: one line of JSON each, written at once, so that a
/// program that is killed loses only the cases in progress.
///
/// The first line names the campaign by the fingerprint of its resolved scenario and program. If there are several
/// processes, each writes a part (`NAME.1.jsonl`, ...), and `finish` collects the parts, in the order of the case
/// numbers, in `NAME.jsonl`. A line begins with `{"case":NUMBER,` and ends with `,"check":"DIGITS"}`: the first 16
/// hexadecimal digits of the SHA-256 of what stands before the comma. A line that does not agree with its digits
/// was damaged, or changed: its case does not count as finished. A process holds a lock (flock) on the part that it
/// writes, so that two runs never write to one file. Cases of an earlier run are deleted only if the caller asks
/// for it.
///
/// Memory is 13 bytes a case. Errors: `core::InputError` for a file of another campaign, others as of
/// `core::fail_to_read`; `OutputError` for one that cannot be written, that another process writes to, or whose
/// cases would be lost.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/results/found_cases.hpp"

namespace dualdamp::scenarios {

/// A line with its check. `line`: an object.
[[nodiscard]] std::string checked_line(std::string_view line);

class CaseFile {
 public:
  /// `name` of the file, without extension; `part`: number of the process; part 0 writes `NAME.jsonl` itself.
  CaseFile(std::string directory, std::string name, const std::string& fingerprint, std::size_t cases,
           int part = 0);
  ~CaseFile();
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  /// Removes or refuses the files of earlier runs. Part 0 calls this before any part is opened.
  void prepare(FoundCases found);
  /// Continues with the cases that are there, without an incomplete last line.
  void open();

  /// Whether the case was there when the part was opened.
  [[nodiscard]] bool is_finished(std::size_t number) const { return finished_[number]; }
  [[nodiscard]] std::size_t finished() const;
  /// What to tell about damaged lines of an earlier run; empty: there are none.
  [[nodiscard]] const std::string& damage() const { return damage_; }

  /// Adds a line and its check with one write; from any thread.
  void add(const std::string& line);

  /// Collects all parts, in order, in `NAME.jsonl`, which must then be complete; with two files open at a time.
  /// Called by one process when the others have closed theirs.
  void finish();
  void close();

  /// Reads the lines in order after `finish`.
  [[nodiscard]] std::string path() const { return part_path(0); }

 private:
  /// A part of the file as it was read.
  struct Scan {
    std::uintmax_t end = 0;         ///< bytes of its complete lines
    std::size_t damaged = 0;        ///< lines
    std::size_t first_damaged = 0;  ///< number of the line
  };
  using Lengths = std::vector<std::uint32_t>;  ///< of the lines, by case number; 0: not there

  [[nodiscard]] std::string part_path(int part) const;
  [[nodiscard]] std::vector<int> parts() const;
  void open_part();
  void write_line(const std::string& text);
  /// Stores the lengths of the sound lines of a part.
  Scan scan(int part, Lengths& lengths) const;
  void gather(const std::vector<int>& all, const Lengths& lengths, int descriptor) const;

  std::string directory_;
  std::string name_;
  std::string head_;  ///< first line of every part
  int part_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::vector<bool> finished_;
  std::string damage_;
};

}  // namespace dualdamp::scenarios
