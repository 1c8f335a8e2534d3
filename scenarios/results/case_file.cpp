#include "scenarios/results/case_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "core/diagnostics.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::scenarios {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view number_key = "{\"case\":";

/// The number of the case a line holds; nothing for a line that is not whole.
std::optional<std::size_t> number_of(std::string_view line) {
  if (!line.starts_with(number_key) || !line.ends_with('}')) return std::nullopt;
  std::size_t number = 0;
  const char* begin = line.data() + number_key.size();
  const auto [end, fault] = std::from_chars(begin, line.data() + line.size(), number);
  if (fault != std::errc() || end == begin || *end != ',') return std::nullopt;
  return number;
}

[[noreturn]] void refuse(const std::string& path, std::string message, std::string allowed, std::string found) {
  throw core::InputError(
      core::Diagnostic{{path, 1, 0, {}}, std::move(message), std::move(allowed), std::move(found), {}});
}

}  // namespace

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
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_)) {
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

long CaseFile::scan(int part, std::vector<Place>& places) const {
  const std::string path = part_path(part);
  std::ifstream file(path, std::ios::binary);
  std::string line;
  // A head that is torn is that of a campaign killed before its first case.
  if (!std::getline(file, line) || file.eof()) return 0;
  if (line != head_)
    refuse(path, "the cases are those of another campaign or sweep, or of another version of the program",
           "the same scenario, options and program; or another --out", line.substr(0, 100));
  long end = file.tellg();
  while (std::getline(file, line) && !file.eof()) {
    const std::optional<std::size_t> number = number_of(line);
    if (!number || *number >= places.size()) break;
    places[*number] = {part, end};
    end = file.tellg();
  }
  return end;
}

void CaseFile::open(bool fresh) {
  close();
  const std::string path = part_path(part_);
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (fresh ? O_TRUNC : 0), 0666);
  if (descriptor_ < 0) throw OutputError("cannot write " + path + ": " + std::strerror(errno));
}

void CaseFile::begin() {
  fs::create_directories(directory_);
  for (const int part : parts())
    if (part_ == 0 && part != 0) fs::remove(part_path(part));
  open(true);
  finished_.assign(finished_.size(), false);
  write_line(head_);
}

void CaseFile::resume() {
  fs::create_directories(directory_);
  std::vector<Place> places(finished_.size());
  for (const int part : parts()) {
    const long end = scan(part, places);
    if (part == part_) fs::resize_file(part_path(part), static_cast<std::uintmax_t>(end));
  }
  open(false);
  if (fs::file_size(part_path(part_)) == 0) write_line(head_);
  for (std::size_t i = 0; i < places.size(); ++i) finished_[i] = places[i].part >= 0;
}

void CaseFile::write_line(const std::string& text) {
  const std::string line = text + "\n";
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t count = ::write(descriptor_, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw OutputError("cannot write " + part_path(part_) + ": " + std::strerror(errno));
    written += static_cast<std::size_t>(count);
  }
}

void CaseFile::add(std::size_t number, const std::string& line) {
  const std::lock_guard lock(mutex_);
  write_line(line);
  finished_[number] = true;
}

void CaseFile::finish() {
  close();
  std::vector<Place> places(finished_.size());
  const std::vector<int> all = parts();
  for (const int part : all) scan(part, places);
  write_files(directory_, {{name_ + ".jsonl", [&](std::ostream& out) {
                              std::vector<std::ifstream> files(static_cast<std::size_t>(all.back()) + 1);
                              for (const int part : all)
                                files[static_cast<std::size_t>(part)].open(part_path(part), std::ios::binary);
                              out << head_ << "\n";
                              std::string line;
                              for (const Place& place : places) {
                                if (place.part < 0) continue;
                                std::ifstream& file = files[static_cast<std::size_t>(place.part)];
                                file.seekg(place.offset);
                                std::getline(file, line);
                                out << line << "\n";
                              }
                            }}});
  for (const int part : all)
    if (part != 0) fs::remove(part_path(part));
}

void CaseFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace dualdamp::scenarios
