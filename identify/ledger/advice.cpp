#include "identify/ledger/advice.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/methods.hpp"

namespace dualdamp::identify {

namespace {

std::string of_sensors(const Recorded& recorded) {
  if (recorded.one_sensor)
    return "check the zero and the range of x, or record a second sensor on the mass, which x can be compared with";
  const std::string calibrate = "calibrate the sensors against each other";
  return recorded.histories ? calibrate : calibrate + ", or record the phase";
}

std::string of_stationarity(const Recorded& recorded) {
  if (recorded.histories)
    return "analyse the parts of the record one by one, or measure again when the rig is steady";
  if (recorded.free) return "measure several decays, and check the zero of x after each";
  return "give the sweeps their labels, or measure them one by one";
}

std::string of_spring(const Recorded& recorded) {
  std::string smaller = "measure at smaller amplitudes";
  if (recorded.free || recorded.histories) return smaller;
  return smaller + ", or record the phase: the work of a forcing period does not depend on the spring";
}

std::string of_friction(const Recorded& recorded) {
  std::string law = "fit a law that has such a term";
  if (recorded.histories) return law;
  if (recorded.free) return "record the whole history, and " + law;
  return "record the phase at several frequencies, or a history, and " + law;
}

std::string what_would_help(Assumption assumption, const Recorded& recorded) {
  using enum Assumption;
  switch (assumption) {
    case constants:
      return "leave out the stated stiffness or mass where the record can tell it, or measure them anew";
    case sensors:
      return of_sensors(recorded);
    case stationarity:
      return of_stationarity(recorded);
    case drive:
      return "record the drive, or leave out where it is not steady";
    case spring:
    case one_mode:
      return of_spring(recorded);
    case friction_velocity:
    case friction_displacement:
      return of_friction(recorded);
    case symmetry:
      return "measure each direction of motion separately";
  }
  return "more data, or less noise";
}

}  // namespace

std::string what_would_help(const Ledger& ledger) {
  std::vector<std::string> helps;
  for (const std::vector<Assumption>& departure : ledger.departures) {
    std::string help = what_would_help(departure.front(), ledger.recorded);
    if (std::ranges::find(helps, help) == helps.end()) helps.push_back(std::move(help));
  }
  return core::joined(helps, "; and ");
}

std::string no_freedom(const Estimate& estimate) {
  constexpr std::size_t most_unknowns = 4;  // of a method that reads pairs or extremes
  const MethodEntry* method = find_method(estimate.method);
  const std::size_t count = estimate.used.size();
  const bool reads_few = method != nullptr && method->needs != RecordKind::history && count <= most_unknowns;
  if (!reads_few || count == 0 || estimate.interval95 || estimate.laws) return {};
  return ", from " + std::to_string(count) + " readings that leave no freedom for an interval";
}

}  // namespace dualdamp::identify
