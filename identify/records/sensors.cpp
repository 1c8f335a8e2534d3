#include "identify/records/sensors.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/diagnostics.hpp"
#include "core/random.hpp"

namespace dualdamp::identify {

namespace {

/// Stream number of the first signal, apart from the streams of laws and excitations with the same seed.
constexpr std::uint32_t first_stream = 16;

/// Takes the readings of one signal, in order.
class Reader {
 public:
  Reader(const Sensor& sensor, std::uint64_t seed, std::uint32_t stream)
      : sensor_(sensor), draws_{.seed = seed, .stream = stream} {}

  /// The next one of `size` readings.
  struct Place {
    std::size_t number = 0;
    std::size_t size = 1;
  };

  void read(std::vector<double>& signal) {
    for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = reading(signal[i], {i, signal.size()});
  }

  double amplitude(double value, int periods, Place place) {
    double sum = 0.0;
    for (int i = 0; i < periods; ++i) {
      const double peak = reading(value, place);
      sum += 0.5 * (peak - reading(-value, place));
    }
    return sum / periods;
  }

  /// The error of a phase [rad], for a signal of this amplitude.
  double phase_error(double amplitude, double omega, int periods) {
    double sum = 0.0;
    for (int i = 0; i < periods; ++i) sum += noise();
    return sensor_.lag(omega) * omega + (amplitude > 0.0 ? sum / (periods * amplitude) : 0.0);
  }

 private:
  double reading(double value, Place place) {
    return quantise((1.0 + gain_error(place)) * value + sensor_.offset + noise());
  }

  [[nodiscard]] double gain_error(Place place) const {
    const double share =
        place.size < 2 ? 0.0 : static_cast<double>(place.number) / static_cast<double>(place.size - 1);
    const auto every = static_cast<std::size_t>(sensor_.outlier_every);
    const bool is_outlier = every > 0 && place.number % every == every / 2;
    return sensor_.gain_error + sensor_.gain_drift * share + (is_outlier ? sensor_.outlier_size : 0.0);
  }

  double noise() { return sensor_.noise > 0.0 ? sensor_.noise * draws_.normal(count_++) : 0.0; }

  [[nodiscard]] double quantise(double value) const {
    if (sensor_.resolution > 0.0) value = sensor_.resolution * std::round(value / sensor_.resolution);
    return std::clamp(value, -sensor_.clipping, sensor_.clipping);
  }

  Sensor sensor_;
  core::RandomStream draws_;
  std::uint64_t count_ = 0;
};

struct Readers {
  Readers(const Sensors& sensors, std::uint64_t seed)
      : y(sensors.y, seed, first_stream),
        x(sensors.x, seed, first_stream + 1),
        v(sensors.v, seed, first_stream + 2),
        a(sensors.a, seed, first_stream + 3),
        force(sensors.force, seed, first_stream + 4) {}

  Reader y, x, v, a, force;
};

void require_sound(const Sensors& sensors) {
  const auto refuse = [](const std::string& message, const std::string& allowed) {
    throw core::InputError(core::Diagnostic{{}, message, allowed, {}, {}});
  };
  if (sensors.average_cycles < 1) refuse("an amplitude is averaged over one period at least", ">= 1");
  for (const Sensor* sensor : {&sensors.y, &sensors.x, &sensors.v, &sensors.a, &sensors.force}) {
    if (!(sensor->noise >= 0.0)) refuse("the noise of a sensor must not be negative", ">= 0");
    if (!(sensor->resolution >= 0.0)) refuse("the resolution of a sensor must not be negative", ">= 0");
    if (!(sensor->clipping >= 0.0)) refuse("the clipping of a sensor must not be negative", ">= 0");
    if (sensor->outlier_every < 0) refuse("the number of readings to an outlier must not be negative", ">= 0");
  }
}

/// The angle in [0, 2 pi).
double in_one_turn(double phase) { return phase - core::two_pi * std::floor(phase / core::two_pi); }

/// Keeps `unknown` values unknown.
Pair read_pair(const Pair& exact, Readers& readers, int periods, Reader::Place place) {
  Pair pair = exact;
  pair.Y = readers.y.amplitude(exact.Y, periods, place);
  pair.x = readers.x.amplitude(exact.x, periods, place);
  if (!std::isnan(exact.phase)) {
    const double late = readers.x.phase_error(exact.x, exact.omega, periods);
    pair.phase = in_one_turn(exact.phase + late - readers.y.phase_error(exact.Y, exact.omega, periods));
  }
  if (!std::isnan(exact.fundamental)) pair.fundamental = readers.x.amplitude(exact.fundamental, periods, place);
  if (!std::isnan(exact.mean_square_speed)) {
    const double speed = readers.v.amplitude(std::sqrt(exact.mean_square_speed), periods, place);
    pair.mean_square_speed = speed * speed;
  }
  return pair;
}

}  // namespace

Record read(const Record& exact, const Sensors& sensors, std::uint64_t seed) {
  require_sound(sensors);
  Record record = exact;
  Readers readers(sensors, seed);
  if (record.pairs) {
    std::vector<Pair>& pairs = record.pairs->pairs;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      pairs[i] = read_pair(pairs[i], readers, sensors.average_cycles, {i, pairs.size()});
  }
  if (record.decay) readers.x.read(record.decay->extremes);
  for (History& history : record.histories) {
    readers.y.read(history.y);
    readers.x.read(history.x);
    readers.v.read(history.v);
    readers.a.read(history.a);
    readers.force.read(history.force);
  }
  return record;
}

}  // namespace dualdamp::identify
