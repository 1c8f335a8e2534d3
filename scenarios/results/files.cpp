#include "scenarios/results/files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/input_file.hpp"
#include "core/provenance.hpp"

namespace dualdamp::scenarios {

namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  [[nodiscard]] int number() const { return number_; }
  /// True when what was written has arrived.
  [[nodiscard]] bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    content.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// A stream to a descriptor; stops at the first error.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) { empty(); }
  /// Digest of all that was written.
  [[nodiscard]] std::string sha256() { return sum_.text(); }
  /// errno of the first failure.
  [[nodiscard]] int error() const { return error_; }

 protected:
  int_type overflow(int_type character) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(character, traits_type::eof())) sputc(traits_type::to_char_type(character));
    return traits_type::not_eof(character);
  }
  int sync() override {
    const std::string_view bytes(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    const bool arrived = write_all(descriptor_, bytes);
    if (!arrived) error_ = errno;
    sum_.add(bytes);
    empty();
    return arrived ? 0 : -1;
  }

 private:
  void empty() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

  int descriptor_;
  int error_ = 0;
  core::Sha256 sum_;
  std::array<char, 1 << 16> buffer_{};
};

bool write_all(int descriptor, const OutputFile& content) {
  DescriptorBuffer buffer(descriptor);
  std::ostream stream(&buffer);
  content.write(stream);
  stream.flush();
  if (!stream) errno = buffer.error();
  if (content.sha256) *content.sha256 = buffer.sha256();
  return stream.good();
}

/// Whether the file of the descriptor is still at `path`: another process may have replaced or removed it.
bool is_at(const std::string& path, int descriptor) {
  struct stat opened{};
  struct stat there{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &there) == 0 && opened.st_ino == there.st_ino &&
         opened.st_dev == there.st_dev;
}

constexpr mode_t mode_of_files = 0666;  // the umask decides

}  // namespace

namespace {

constexpr std::string_view seal = "# Written by dualdamp. SHA-256 of the lines below, before any change: ";

}  // namespace

std::string sealed(const std::string& text) { return std::string(seal) + core::sha256(text) + "\n" + text; }

bool is_sealed(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (!text.starts_with(seal) || end == std::string_view::npos) return false;
  return text.substr(seal.size(), end - seal.size()) == core::sha256(std::string(text.substr(end + 1)));
}

namespace {

Descriptor open_to_read(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) core::fail_to_read(path, "cannot be opened", errno);
  return file;
}

/// Hands over a file piece by piece, until `take` returns false.
template <typename Take>
void read_pieces(const Descriptor& file, const std::string& path, Take take) {
  std::array<char, 1 << 16> buffer{};
  while (true) {
    const ssize_t count = ::read(file.number(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) core::fail_to_read(path, "cannot be read", errno);
    if (count == 0 || !take(std::string_view(buffer.data(), static_cast<std::size_t>(count)))) return;
  }
}

}  // namespace

std::string read_file(const std::string& path, std::size_t limit) {
  const Descriptor file = open_to_read(path);
  struct stat status{};
  if (::fstat(file.number(), &status) == 0 && S_ISDIR(status.st_mode))
    core::refuse({.file = path}, "is a directory, not a file");
  const auto refuse_large = [&] {
    core::refuse({.file = path}, "is larger than " + std::to_string(limit >> 20U) + " MiB");
  };
  if (S_ISREG(status.st_mode) && static_cast<std::uintmax_t>(status.st_size) > limit) refuse_large();

  std::string content;
  read_pieces(file, path, [&](std::string_view piece) {
    content += piece;
    if (content.size() > limit) refuse_large();
    return true;
  });
  return content;
}

std::string beginning_of(const std::string& path, std::size_t count) {
  std::string beginning;
  read_pieces(open_to_read(path), path, [&](std::string_view piece) {
    beginning += piece.substr(0, count - beginning.size());
    return beginning.size() < count;
  });
  return beginning;
}

std::string sha256_of_file(const std::string& path) {
  core::Sha256 sum;
  read_pieces(open_to_read(path), path, [&](std::string_view piece) {
    sum.add(piece);
    return true;
  });
  return sum.text();
}

int write_new_file(const std::string& path, const OutputFile& content) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_of_files));
  return file.number() >= 0 && write_all(file.number(), content) && file.close() ? 0 : errno;
}

int open_locked(const std::string& path, int flags) {
  while (true) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | flags, mode_of_files);
    if (descriptor < 0) return descriptor;
    const bool is_held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_held && is_at(path, descriptor)) return descriptor;
    ::close(descriptor);
    if (!is_held) continue;
    errno = EWOULDBLOCK;
    return -1;
  }
}

std::string set_aside(const std::string& path) {
  std::string other = path;
  std::error_code error;
  do other += "~";
  while (std::filesystem::exists(other, error));
  std::filesystem::rename(path, other, error);
  if (error)
    throw OutputError("cannot write " + path + ": the file that is there cannot be renamed: " + error.message());
  return "the " + path + " that was there is kept as " + other;
}

}  // namespace dualdamp::scenarios
