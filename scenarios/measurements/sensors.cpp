#include "scenarios/measurements/sensors.hpp"

#include <utility>

#include "friction_models/modifiers/modifiers.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

Field sensor(const std::string& name, const std::string& unit, const std::string& what) {
  return section(
      name,
      {{quantity("noise", {unit}, "noise level: standard deviation of a reading").with_fallback(0.0).at_least(0),
        quantity("resolution", {unit}, "smallest step between two readings; 0: none")
            .with_fallback(0.0)
            .at_least(0),
        quantity("offset", {unit}, "reading when the quantity is zero").with_fallback(0.0),
        quantity("gain_error", {"1"}, "relative error of the gain").with_fallback(0.0).above(-1),
        quantity("gain_drift", {"1"}, "change of the gain from the first reading of a record to the last, relative")
            .with_fallback(0.0)
            .above(-1),
        integer("outlier_every",
                "length of a group of readings; the middle reading of each group is off by 'outlier_size'; 0: no "
                "outliers")
            .with_fallback(0)
            .at_least(0)
            .at_most(1'000'000),
        quantity("outlier_size", {"1"}, "relative error of these readings").with_fallback(0.0),
        quantity("phase_lag", {"rad"}, "lag of the reading as an angle at the forcing frequency")
            .at_least(0)
            .at_most(friction::largest_phase),
        quantity("delay", {"s"}, "time lag of the reading").at_least(0),
        quantity("clipping", {unit}, "readings are limited to plus and minus this value").above(0)},
       {{{"phase_lag", "delay"}, false}}},
      "sensor of " + what);
}

}  // namespace

std::vector<Field> sensor_fields() {
  return {
      quantity("sample_rate", {"1/s"}, "sample rate of the signals; amplitudes are then computed from the samples")
          .above(0),
      integer("average_cycles", "forcing periods over which an amplitude is averaged")
          .with_fallback(1)
          .at_least(1)
          .at_most(10'000),
      seed(),
      sensor("y", "m", "the base's displacement"),
      sensor("x", "m", "the mass's displacement"),
      sensor("v", "m/s", "the mass's velocity"),
      sensor("a", "m/s^2", "the mass's acceleration"),
      sensor("force", "N", "the force on the mass")};
}

void check_outliers(CheckedFile& file, const std::string& path) {
  for (const char* signal : {"y", "x", "v", "a", "force"}) {
    const std::string sensor = path + "." + signal;
    const std::string every = sensor + ".outlier_every";
    const std::string size = sensor + ".outlier_size";
    for (const auto& [given, missing] : {std::pair(every, size), std::pair(size, every)})
      if (file.is_given(given) && !file.is_given(missing))
        file.complain(given, "'" + given + "' has no effect without '" + missing + "'", "both or none");
  }
}

identify::Sensors sensors_of(const Json& section) {
  identify::Sensors result;
  result.sample_rate = number_or(section, "sample_rate", 0.0);
  result.average_cycles = section.at("average_cycles").get<int>();
  const auto read = [&](const char* name, identify::Sensor& sensor) {
    if (!section.contains(name)) return;
    const Json& values = section.at(name);
    sensor = {.noise = number(values.at("noise")),
              .resolution = number(values.at("resolution")),
              .offset = number(values.at("offset")),
              .gain_error = number(values.at("gain_error")),
              .gain_drift = number(values.at("gain_drift")),
              .outlier_every = values.at("outlier_every").get<int>(),
              .outlier_size = number(values.at("outlier_size")),
              .phase_lag = number_or(values, "phase_lag", 0.0),
              .delay = number_or(values, "delay", 0.0),
              .clipping = number_or(values, "clipping", sensor.clipping)};
  };
  read("y", result.y);
  read("x", result.x);
  read("v", result.v);
  read("a", result.a);
  read("force", result.force);
  return result;
}

}  // namespace dualdamp::scenarios
