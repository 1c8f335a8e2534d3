#pragma once
/// What every fuzzing harness shares. A harness is one source `fuzz_NAME.cpp` that defines `consume`.
///
/// It is linked twice: with libFuzzer (preset `fuzz`: clang, coverage, sanitizers), and with replay.cpp, which
/// needs no clang and runs it over given files and simple mutations of them, as the test suite does.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dualdamp::fuzz {

/// Gives the input to the code under test. Throws, or ends by a signal, where that does what it does not promise:
/// another exception than `core::InputError`, a number that is not finite.
void consume(std::string_view input);

/// A promise of the code under test: throws where it is broken.
inline void require(bool holds, const std::string& promise) {
  if (!holds) throw std::logic_error("broken promise: " + promise);
}

/// A folder of this process, in memory where the system has it, removed when it ends.
inline const std::filesystem::path& folder() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::path(std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : ".") /
        ("dualdamp-fuzz-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder own;
  return own.path;
}

/// Writes a file there and returns its path.
inline std::string written(const std::string& name, std::string_view content) {
  const std::string path = (folder() / name).string();
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
  return path;
}

}  // namespace dualdamp::fuzz
