#include "scenarios/measurements/work_checks.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/drives.hpp"

namespace dualdamp::scenarios {

namespace {

using core::two_pi;

}  // namespace

void check_rows(CheckedFile& file, const std::string& path, double rows) {
  if (rows > max_samples)
    file.complain(path, "the history has too many rows", "at most " + core::format_number(max_samples, 6),
                  core::format_number(rows, 6));
}

void check_work(CheckedFile& file, const Json& section, const std::string& path, const Sampling& sampling) {
  const auto m = file.number_at("system", "mass");
  const auto k = file.number_at("system", "stiffness");
  const bool by_cycles = section.contains("cycles");
  // A frequency that could not be resolved is still a word, which is reported elsewhere.
  const bool driven =
      file.has("excitation", "frequency") && file.text_at("excitation", "frequency").ends_with("rad/s");
  if (by_cycles && !driven) {
    const std::string key = path + ".cycles";
    if (!file.stands_in_file("excitation", "frequency"))
      file.complain(key, "'" + key + "' needs a harmonic excitation", "'duration' instead");
    return;
  }
  const double frequency = driven ? *file.number_at("excitation", "frequency") : 0.0;
  if (!by_cycles && !section.contains("duration")) return;
  const double recorded =
      by_cycles ? number(section.at("cycles")) * two_pi / frequency : number(section.at("duration"));
  const double duration = recorded + (section.contains("settle") ? number(section.at("settle")) : 0.0);
  const double fastest = std::max(frequency, m && k ? std::sqrt(*k / *m) : 0.0);
  if (duration * fastest / two_pi > max_periods)
    file.complain(path + (by_cycles ? ".cycles" : ".duration"), "the simulation is too long",
                  "at most " + core::format_number(max_periods, 6) + " forcing or natural periods",
                  core::format_number(duration * fastest / two_pi, 6) + " periods");
  check_drive(file, duration);
  check_rows(file, sampling.path, recorded * sampling.rate.value_or(0.0) * sampling.tests);
}

}  // namespace dualdamp::scenarios
