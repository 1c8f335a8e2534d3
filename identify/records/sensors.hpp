#pragma once
/// Sensors: the readings of an exact motion, as a record has them.
///
/// The reading of a true value q is
///
///   reading = clip(round((1 + gain_error + e) q + offset + noise n)),   n normal with variance 1,
///
/// rounded to multiples of `resolution` and cut off at +-`clipping`. e changes within a record: the gain drifts
/// from 0 at the first reading to `gain_drift` at the last one, and in each group of `outlier_every` readings the
/// middle one has the error `outlier_size`. A signal that lags is read `lag(w)` late. `read` applies the lag to
/// phases. For histories, the caller must sample the motion later (`scenarios/measurements/measure.hpp`).
///
/// An amplitude is half the difference of a peak and a trough, each read once a period, averaged over
/// `average_cycles` periods. Its standard deviation is noise/sqrt(2 periods); an offset cancels. A phase is read at
/// zero crossings of x and y, rising and falling, so the noise of one period is noise/amplitude. Extremes of a free
/// vibration are read once, their times exactly.
///
/// Each signal has its own stream of random numbers (core/random.hpp): a reading depends on the seed, the signal
/// and its number in the record. Cost: about 40 ns a noisy reading. Errors: `core::InputError` for a negative or
/// unknown noise, resolution, clipping or number of readings, or an average over no period.

#include <cstdint>

#include "core/constants.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Properties of a sensor, in units of its signal. The default is a perfect sensor.
struct Sensor {
  double noise = 0.0;         ///< standard deviation of a reading
  double resolution = 0.0;    ///< step between readings; 0: none
  double offset = 0.0;        ///< reading of zero
  double gain_error = 0.0;    ///< relative
  double gain_drift = 0.0;    ///< relative, over the record
  int outlier_every = 0;      ///< readings with one outlier among them; 0: no outliers
  double outlier_size = 0.0;  ///< relative
  double phase_lag = 0.0;     ///< at the forcing frequency [rad]
  double delay = 0.0;         ///< s
  double clipping = core::infinity;

  /// Delay of a reading [s]. `omega` [rad/s] may be `unknown` if there is no phase lag.
  [[nodiscard]] double lag(double omega) const { return phase_lag == 0.0 ? delay : delay + phase_lag / omega; }
};

struct Sensors {
  double sample_rate = 0.0;  ///< Hz; 0: the sensors read amplitudes, not histories
  int average_cycles = 1;    ///< periods that an amplitude is averaged over
  Sensor y, x, v, a, force;
};

/// The readings of the pairs, extremes and samples of an exact record.
[[nodiscard]] Record read(const Record& exact, const Sensors& sensors, std::uint64_t seed);

}  // namespace dualdamp::identify
