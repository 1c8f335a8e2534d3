#include "scenarios/results/staged_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>
#include <utility>

#include "core/cancellation.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr const char* lock_name = "lock";

void create_directory(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error || !std::filesystem::is_directory(directory, error))
    throw OutputError("cannot create the directory " + directory + ": " +
                      (error ? error.message() : "a file of that name is there"));
}

[[noreturn]] void refuse_path(const std::string& path, const std::string& reason) {
  throw OutputError("cannot write " + path + ": " + reason);
}

}  // namespace

StagedFiles::StagedFiles(std::string directory)
    : directory_(std::move(directory)), path_((std::filesystem::path(directory_) / ".dualdamp.partial").string()) {
  create_directory(directory_);
  wait_for_lock();
  remove_leftovers();
}

/// A process that waits may create the lock anew as soon as it is removed; the subdirectory is then not empty and
/// stays.
StagedFiles::~StagedFiles() {
  for (const std::string& name : names_) ::unlink(staged(name).c_str());
  ::unlink(staged(lock_name).c_str());
  ::rmdir(path_.c_str());
  ::close(lock_);
}

/// False while another process holds the lock, or has just removed the subdirectory.
bool StagedFiles::lock() {
  constexpr mode_t mode = 0777;  // the umask decides
  if (::mkdir(path_.c_str(), mode) != 0 && errno != EEXIST) refuse_path(path_, std::strerror(errno));
  // Behind a link, leftovers would be files of others.
  if (std::error_code error; std::filesystem::is_symlink(path_, error)) refuse_path(path_, "it is a link");
  lock_ = open_locked(staged(lock_name));
  if (lock_ >= 0 || errno == EWOULDBLOCK || errno == ENOENT) return lock_ >= 0;
  const std::string reason = std::strerror(errno);
  ::rmdir(path_.c_str());
  refuse_path(path_, reason);
}

void StagedFiles::wait_for_lock() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds patience(60);
  constexpr std::chrono::milliseconds pause(10);
  const Clock::time_point end = Clock::now() + patience;
  while (!lock()) {
    if (Clock::now() > end)
      throw OutputError("cannot write results to " + directory_ +
                        ": another process has been writing there for a minute");
    core::stop_if_cancelled();
    std::this_thread::sleep_for(pause);
  }
}

void StagedFiles::remove_leftovers() const {
  std::error_code error;  // what cannot be removed is in the way of a file or not; the write reports it
  for (const auto& entry : std::filesystem::directory_iterator(path_, error))
    if (entry.path().filename() != lock_name) std::filesystem::remove_all(entry.path(), error);
}

std::string StagedFiles::final(const std::string& name) const {
  return (std::filesystem::path(directory_) / name).string();
}

void StagedFiles::write(const OutputFile& file) {
  {
    const std::lock_guard lock(mutex_);
    names_.push_back(file.name);
  }
  if (const int error = write_new_file(staged(file.name), file); error != 0)
    refuse_path(final(file.name), std::strerror(error));
}

void StagedFiles::publish() {
  // Afterwards only a fault of the file system could leave some of the files without their final names.
  for (const std::string& name : names_)
    if (std::error_code error; std::filesystem::is_directory(final(name), error))
      refuse_path(final(name), "it is a directory");
  for (const std::string& name : names_)
    if (::rename(staged(name).c_str(), final(name).c_str()) != 0) refuse_path(final(name), std::strerror(errno));
  names_.clear();
}

}  // namespace dualdamp::scenarios
