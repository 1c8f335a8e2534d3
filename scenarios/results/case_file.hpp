#pragma once
/// The file of finished cases of a campaign or points of a sweep: one line of JSON each, written at once, so that
/// whatever ends the program loses no more than the cases under way.
///
/// The first line names the campaign by the fingerprint of its resolved scenario and program. Several processes
/// write a part each (`NAME.1.jsonl`, ...), which `finish` gathers, in the order of the case numbers, into
/// `NAME.jsonl`. A line begins with `{"case":NUMBER,`. Whoever writes a part holds a lock on it (flock), so that
/// two runs never write to one file. Cases of an earlier run are lost only where the caller says so.
///
/// Memory is 13 bytes a case. Errors: `core::InputError` for a file of another campaign or one that cannot be read,
/// `OutputError` for one that cannot be written, that another process writes to, or whose cases would be
/// lost.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "scenarios/results/found_cases.hpp"

namespace dualdamp::scenarios {

class CaseFile {
 public:
  /// `name` of the file, without extension; `part`: number of the process; part 0 writes `NAME.jsonl` itself.
  CaseFile(std::string directory, std::string name, const std::string& fingerprint, std::size_t cases,
           int part = 0);
  ~CaseFile();
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  /// Removes or refuses what earlier runs have left. Part 0 calls this before any part is opened.
  void prepare(FoundCases found);
  /// Goes on with the cases that are there, without a last line that is torn.
  void open();

  /// Of those that were there when the part was opened.
  [[nodiscard]] bool is_finished(std::size_t number) const { return finished_[number]; }
  [[nodiscard]] std::size_t finished() const;

  /// Adds a line with one write; from any thread.
  void add(const std::string& line);

  /// Gathers all parts, in order, into `NAME.jsonl`, which must then be complete; with two files open at a time.
  /// Called by one process when the others have closed theirs.
  void finish();
  void close();

  /// Reads the lines in order after `finish`.
  [[nodiscard]] std::string path() const { return part_path(0); }

 private:
  /// An earlier run may have been killed as it wrote: its lines are read whole. This run's are known to be whole.
  enum class Origin { earlier_run, this_run };
  using Lengths = std::vector<std::uint32_t>;  ///< of the lines, by case number; 0: not there

  [[nodiscard]] std::string part_path(int part) const;
  [[nodiscard]] std::vector<int> parts() const;
  void open_part();
  void write_line(const std::string& text);
  /// Notes the whole lines of a part; returns how many bytes they take.
  std::uintmax_t scan(int part, Lengths& lengths, Origin origin) const;
  void gather(const std::vector<int>& all, const Lengths& lengths, int descriptor) const;

  std::string directory_;
  std::string name_;
  std::string head_;  ///< first line of every part
  int part_;
  int descriptor_ = -1;
  std::mutex mutex_;
  std::vector<bool> finished_;
};

}  // namespace dualdamp::scenarios
