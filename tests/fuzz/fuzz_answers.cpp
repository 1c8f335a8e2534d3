/// Answers of a program to an exported stress test, and its key: the two parts of the input stand before and after
/// the first zero byte; without one the input is the answers, to a key of nine cases.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "bench/score/key.hpp"
#include "core/diagnostics.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;

/// In memory where the system has it.
std::string place_of(const char* name) {
  const std::filesystem::path folder = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : ".";
  return (folder / ("dualdamp-fuzz-" + std::to_string(::getpid()) + "-" + name)).string();
}

std::string written(const char* name, std::string_view content) {
  static const std::string path = place_of(name);
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
  return path;
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  try {
    bench::Key key = bench::make_key("scenario", 1, 9);
    if (const auto zero = input.find('\0'); zero != std::string_view::npos) {
      const std::string path = written("input", input.substr(zero + 1));
      key = bench::read_key(path);
      std::filesystem::remove(path);
      input = input.substr(0, zero);
    }
    const std::string path = written("input", input);
    const bench::Entry entry = bench::read_entry("program", path, key);
    require(entry.answers.size() == key.numbers.size(), "every case has its answer");
    for (const bench::CaseAnswer& answer : entry.answers) {
      const bench::Mark mark = bench::mark_of(answer, {.zeta = 0.1, .F0 = 2.0});
      require(mark.loss >= 0.0F && mark.loss <= 1.0F, "a loss lies between 0 and 1");
    }
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
  }
}
