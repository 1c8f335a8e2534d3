#include "bench/random_response.hpp"

#include <numbers>
#include <string>
#include <utility>

#include "core/numbers.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/work_checks.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::CheckedFile;
using scenarios::Field;
using scenarios::Json;
using scenarios::Variant;

constexpr const char* place = "analysis.random_response";

/// The keys of an excitation without its seed, which each motion has of its own, and the keys of the recording.
Variant recorded(const std::string& type) {
  using namespace scenarios;
  Variant variant = *excitations().find(type);
  std::erase_if(variant.section.fields, [](const Field& field) { return field.name == "seed"; });
  for (Field& field :
       std::vector<Field>{quantity("duration", {"s"}, "length of the record").required().above(0),
                          quantity("settle", {"s"}, "time from the start at rest until the record begins")
                              .with_fallback(0.0)
                              .at_least(0),
                          quantity("sample_rate", {"1/s"}, "samples of x, v, a and the drive").required().above(0)})
    variant.section.fields.push_back(std::move(field));
  return variant;
}

/// The sensor with its phase lag as the delay that it is at this frequency.
identify::Sensor delayed(identify::Sensor sensor, double frequency) {
  sensor.delay = sensor.lag(frequency);
  sensor.phase_lag = 0.0;
  return sensor;
}

}  // namespace

Field random_response_key() {
  return scenarios::choice(
      "random_response", {"type", {recorded("force_noise"), recorded("base_noise")}},
      "the response to a random drive in addition to each curve, for the methods that need one");
}

void check_random_response(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  if (!analysis.contains("random_response")) return;
  const Json& section = analysis.at("random_response");
  if (section.contains("sample_rate"))
    check_work(file, section, place,
               {place + std::string(".sample_rate"), scenarios::number(section.at("sample_rate")), 1.0});
  if (section.contains("duration") && section.contains("bandwidth")) {
    const double values =
        (scenarios::number(section.at("duration")) + scenarios::number_or(section, "settle", 0.0)) *
        scenarios::number(section.at("bandwidth")) / std::numbers::pi;
    if (values > scenarios::max_nodes)
      file.complain(place + std::string(".bandwidth"), "the drive has too many pieces",
                    "at most " + core::format_number(scenarios::max_nodes, 8) + " pieces",
                    core::format_number(values, 6));
  }
  const Json sets = analysis.value("sensors", Json::array());
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (sets.at(i).contains("sample_rate"))
      file.complain("analysis.sensors[" + std::to_string(i) + "].sample_rate",
                    "a record holds the samples of steady states or those of 'random_response', not both",
                    "a 'sample_rate' in one of them");
}

identify::History random_outline(const Json& section) {
  identify::History history{.sample_rate = 1.0, .x = {0.0}, .v = {0.0}, .a = {0.0}};
  (scenarios::moves_base(section.value("type", "")) ? history.y : history.force) = {0.0};
  return history;
}

RandomTest random_test_of(const Json& section) {
  RandomTest test{.duration = scenarios::number(section.at("duration")),
                  .settle = scenarios::number(section.at("settle")),
                  .sample_rate = scenarios::number(section.at("sample_rate"))};
  test.drive.type = scenarios::moves_base(section.at("type").get<std::string>()) ? sim::ExcitationType::base_noise
                                                                                 : sim::ExcitationType::force_noise;
  test.drive.noise = {.intensity = scenarios::number(section.at("intensity")),
                      .bandwidth = scenarios::number(section.at("bandwidth"))};
  return test;
}

scenarios::MotionRecord random_motion(const RandomTest& test, sim::Model model, std::uint64_t seed,
                                      const identify::Sensors& sensors, double frequency) {
  model.initial = {};
  model.excitation = test.drive;
  model.excitation.noise.seed = seed;
  scenarios::Measurement measurement{.kind = scenarios::MeasurementKind::histories};
  measurement.duration = test.duration;
  measurement.settle = test.settle;
  identify::Sensors sampling{.sample_rate = test.sample_rate};
  for (const auto sensor : {&identify::Sensors::y, &identify::Sensors::x, &identify::Sensors::v,
                            &identify::Sensors::a, &identify::Sensors::force})
    sampling.*sensor = delayed(sensors.*sensor, frequency);
  scenarios::MotionRecord motion = motion_of(model, measurement, sampling);
  for (std::string& warning : motion.warnings) warning = "response to a random drive: " + warning;
  return motion;
}

}  // namespace dualdamp::bench
