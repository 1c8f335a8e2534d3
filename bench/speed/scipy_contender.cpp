#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>

#include "bench/speed/contender.hpp"

namespace dualdamp::bench::speed {
namespace {

constexpr int package_missing = 69 << 8;  // as pclose() returns the script's status

/// The output of a program; `status` as returned by pclose().
std::string output_of(const std::string& command, int& status) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  std::string text;
  std::array<char, 4096> part;
  while (const std::size_t length = std::fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), length);
  status = pclose(pipe);
  return text;
}

}  // namespace

std::vector<ScipyResult> integrate_with_scipy(const StandardCase& work, const std::vector<double>& tolerances,
                                              int batches, int periods) {
  const std::string python = DUALDAMP_SPEED_PYTHON;
  if (python.empty()) return {};
  std::string command = fmt::format("'{}' '{}' {} {} {} {} {} {} {} {} {} {}", python, DUALDAMP_SPEED_SCRIPT,
                                    batches, periods, work.mass, work.stiffness, work.damping, work.friction,
                                    work.frequency, work.base_amplitude, work.start_position, work.start_velocity);
  for (const double tolerance : tolerances) command += fmt::format(" {}", tolerance);
  int status = 0;
  const std::string text = output_of(command, status);
  if (status == package_missing) return {};
  if (status != 0) throw std::runtime_error(fmt::format("status {} of {}", status, command));

  std::vector<ScipyResult> results;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    double reversals = 0.0;
    ScipyResult& result = results.emplace_back();
    numbers >> result.motion.amplitude >> reversals;
    result.motion.reversals = static_cast<long>(reversals);
    for (double seconds = 0.0; numbers >> seconds;) result.seconds.push_back(seconds);
  }
  return results;
}

}  // namespace dualdamp::bench::speed
