#include "scenarios/results/case_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/diagnostics.hpp"
#include "core/input_file.hpp"
#include "core/provenance.hpp"
#include "core/utf8.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::scenarios {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view number_key = "{\"case\":";
constexpr std::string_view check_key = ",\"check\":\"";

/// What ends a line that begins with this text.
std::string check_of(std::string_view beginning) {
  constexpr std::size_t digits = 16;
  return std::string(check_key) + core::sha256(beginning).substr(0, digits) + "\"}";
}

/// The number of the case in a line; nothing for a line without a case.
std::optional<std::size_t> number_of(std::string_view line) {
  if (!line.starts_with(number_key)) return std::nullopt;
  std::size_t number = 0;
  const char* begin = line.data() + number_key.size();
  const auto [end, fault] = std::from_chars(begin, line.data() + line.size(), number);
  if (fault != std::errc() || end == begin || end == line.data() + line.size() || *end != ',') return std::nullopt;
  return number;
}

/// The number of a line as it was written; nothing for one that was damaged or changed.
std::optional<std::size_t> sound_number_of(std::string_view line) {
  const std::size_t end = line.rfind(check_key);
  if (end == std::string_view::npos || line.substr(end) != check_of(line.substr(0, end))) return std::nullopt;
  return number_of(line);
}

[[noreturn]] void fail_to_write(const std::string& path, const std::string& reason) {
  throw OutputError("cannot write " + path + ": " + reason);
}

/// The complete lines of a part, its head first. A file that cannot be opened does not count as empty.
class Lines {
 public:
  explicit Lines(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
    if (!file_) core::fail_to_read(path_, "cannot be opened", errno);
  }

  /// False at the end, or before an incomplete last line. Of a long line that does not hold a case, only the
  /// beginning is kept.
  bool next(std::string& line) {
    line.clear();
    std::uintmax_t length = 0;
    while (true) {
      file_.getline(piece_.data(), static_cast<std::streamsize>(piece_.size()));
      if (file_.bad()) core::fail_to_read(path_, "cannot be read", errno);
      if (file_.eof()) return false;
      const auto count = static_cast<std::size_t>(file_.gcount());
      const bool is_end = !file_.fail();  // the line end is counted, and not stored
      if (line.empty() || line.starts_with(number_key)) line.append(piece_.data(), is_end ? count - 1 : count);
      length += count;
      if (is_end) break;
      file_.clear();
    }
    end_ += length;
    return true;
  }
  /// Bytes up to the end of the last line that was read.
  [[nodiscard]] std::uintmax_t end() const { return end_; }

 private:
  std::string path_;
  std::ifstream file_;
  std::uintmax_t end_ = 0;
  std::array<char, 1U << 12U> piece_{};
};

void write_at(int descriptor, std::string_view text, std::uintmax_t place, const std::string& path) {
  while (!text.empty()) {
    const ssize_t count = ::pwrite(descriptor, text.data(), text.size(), static_cast<off_t>(place));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail_to_write(path, std::strerror(errno));
    text.remove_prefix(static_cast<std::size_t>(count));
    place += static_cast<std::uintmax_t>(count);
  }
}

}  // namespace

std::string checked_line(std::string_view line) {
  const std::string_view beginning = line.substr(0, line.size() - 1);  // without the brace
  return std::string(beginning) + check_of(beginning);
}

CaseFile::CaseFile(std::string directory, std::string name, const std::string& fingerprint, std::size_t cases,
                   int part)
    : directory_(std::move(directory)),
      name_(std::move(name)),
      head_("{\"campaign\":\"" + fingerprint + "\",\"cases\":" + std::to_string(cases) + "}"),
      part_(part),
      finished_(cases, false) {}

CaseFile::~CaseFile() { close(); }

std::string CaseFile::part_path(int part) const {
  return directory_ + "/" + name_ + (part == 0 ? "" : "." + std::to_string(part)) + ".jsonl";
}

/// Those that are there, in order.
std::vector<int> CaseFile::parts() const {
  std::vector<int> found;
  std::error_code error;
  const fs::directory_iterator entries(directory_, error);
  if (error) throw OutputError("cannot read " + directory_ + ": " + error.message());
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (name == name_ + ".jsonl") found.push_back(0);
    if (!name.starts_with(name_ + ".") || !name.ends_with(".jsonl")) continue;
    int part = 0;
    const char* begin = name.data() + name_.size() + 1;
    const auto [end, fault] = std::from_chars(begin, name.data() + name.size(), part);
    if (fault == std::errc() && std::string_view(end) == ".jsonl" && part > 0) found.push_back(part);
  }
  std::ranges::sort(found);
  return found;
}

std::size_t CaseFile::finished() const { return static_cast<std::size_t>(std::ranges::count(finished_, true)); }

CaseFile::Scan CaseFile::scan(int part, Lengths& lengths) const {
  const std::string path = part_path(part);
  Lines lines(path);
  std::string line;
  Scan scan;
  // A head is incomplete if the campaign was killed before its first case.
  if (!lines.next(line)) return scan;
  if (line != head_)
    core::refuse({.file = path, .line = 1},
                 "the cases are those of another campaign, or of another version of the program",
                 "the same scenario, options and program; or another directory", core::shortened(line, 100));
  for (std::size_t place = 2; lines.next(line); ++place) {
    const std::optional<std::size_t> number = sound_number_of(line);
    if (number && *number < lengths.size())
      lengths[*number] = static_cast<std::uint32_t>(line.size() + 1);
    else if (scan.damaged++ == 0)
      scan.first_damaged = place;
  }
  scan.end = lines.end();
  return scan;
}

void CaseFile::prepare(FoundCases found) {
  std::error_code error;
  fs::create_directories(directory_, error);
  if (error) throw OutputError("cannot create the directory " + directory_ + ": " + error.message());
  open_part();  // no other process is writing
  if (found == FoundCases::resume) return;
  std::size_t cases = 0;
  std::size_t sound = 0;
  bool is_this = true;
  for (const int part : parts()) {
    Lines lines(part_path(part));
    std::string line;
    if (!lines.next(line)) continue;
    const bool same = line == head_;
    while (lines.next(line)) {
      if (!number_of(line)) continue;
      ++cases;
      is_this = is_this && same;
      if (is_this && sound_number_of(line)) ++sound;
    }
  }
  if (found == FoundCases::refuse && cases > 0) {
    if (is_this && sound >= finished_.size()) return;
    throw EarlierFiles(directory_ + " holds " + std::to_string(cases) + " finished cases of " +
                           (is_this ? "this campaign" : "another campaign"),
                       is_this);
  }
  for (const int part : parts())
    if (part != 0) fs::remove(part_path(part));
  if (::ftruncate(descriptor_, 0) != 0) fail_to_write(part_path(0), std::strerror(errno));
}

void CaseFile::open_part() {
  if (descriptor_ >= 0) return;
  const std::string path = part_path(part_);
  descriptor_ = open_locked(path, O_APPEND);
  if (descriptor_ < 0)
    fail_to_write(path, errno == EWOULDBLOCK
                            ? "another process is writing it; several that share a campaign are to be started by "
                              "mpirun or srun"
                            : std::strerror(errno));
}

void CaseFile::open() {
  open_part();
  Lengths lengths(finished_.size(), 0);
  std::uintmax_t end = 0;
  std::size_t damaged = 0;
  std::string first;
  for (const int part : parts()) {
    const Scan found = scan(part, lengths);
    if (part == part_) end = found.end;
    if (damaged == 0) first = part_path(part) + ":" + std::to_string(found.first_damaged);
    damaged += found.damaged;
  }
  if (damaged > 0)
    damage_ = first + ": " + (damaged == 1 ? "a line is" : std::to_string(damaged) + " lines from here on are") +
              " not as the program wrote it: what is missing is computed again";
  const std::string path = part_path(part_);
  if (::ftruncate(descriptor_, static_cast<off_t>(end)) != 0) fail_to_write(path, std::strerror(errno));
  if (end == 0) write_line(head_);
  for (std::size_t i = 0; i < lengths.size(); ++i) finished_[i] = lengths[i] > 0;
}

void CaseFile::write_line(const std::string& text) {
  const std::string line = text + "\n";
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t count = ::write(descriptor_, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail_to_write(part_path(part_), std::strerror(errno));
    written += static_cast<std::size_t>(count);
  }
}

void CaseFile::add(const std::string& line) {
  const std::string checked = checked_line(line);
  const std::lock_guard lock(mutex_);
  write_line(checked);
}

/// Each line is written at its place, which follows from the lengths of the lines before it.
void CaseFile::gather(const std::vector<int>& all, const Lengths& lengths, int descriptor) const {
  std::vector<std::uintmax_t> places;
  places.reserve(lengths.size());
  std::uintmax_t end = head_.size() + 1;
  for (const std::uint32_t length : lengths) {
    places.push_back(end);
    end += length;
  }
  write_at(descriptor, head_ + "\n", 0, path());
  constexpr std::size_t enough = 1U << 16U;
  for (const int part : all) {
    Lines lines(part_path(part));
    std::string line;
    std::string run;  // lines that are consecutive in both files
    std::uintmax_t begin = 0;
    if (!lines.next(line)) continue;
    while (lines.next(line)) {
      const std::optional<std::size_t> number = sound_number_of(line);
      if (!number || *number >= lengths.size()) continue;
      if (lengths[*number] != line.size() + 1)
        core::refuse({.file = part_path(part), .line = 1},
                     "case " + std::to_string(*number) + " is there twice and differs");
      if (places[*number] != begin + run.size() || run.size() > enough) {
        write_at(descriptor, run, begin, path());
        run.clear();
        begin = places[*number];
      }
      run += line + "\n";
    }
    write_at(descriptor, run, begin, path());
  }
}

void CaseFile::finish() {
  Lengths lengths(finished_.size(), 0);
  const std::vector<int> all = parts();
  for (const int part : all) static_cast<void>(scan(part, lengths));
  if (const auto missing = std::ranges::count(lengths, 0U); missing > 0) {
    const auto first = std::ranges::find(lengths, 0U) - lengths.begin();
    fail_to_write(path(), std::to_string(missing) + " cases are missing, first " + std::to_string(first));
  }
  const std::string partial = path() + "." + std::to_string(::getpid()) + ".partial";
  const int whole = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (whole < 0) fail_to_write(partial, std::strerror(errno));
  try {
    gather(all, lengths, whole);
  } catch (...) {
    ::close(whole);
    ::unlink(partial.c_str());
    throw;
  }
  if (::close(whole) != 0 || ::rename(partial.c_str(), path().c_str()) != 0)
    fail_to_write(path(), std::strerror(errno));
  for (const int part : all)
    if (part != 0) fs::remove(part_path(part));
  close();
}

void CaseFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace dualdamp::scenarios
