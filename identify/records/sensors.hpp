#pragma once
/// Sensors: what becomes of an exact motion on its way into a record.
///
/// One reading of a true value q:
///
///   reading = clip(round((1 + gain_error + e) q + offset + noise n)),   n normal with variance 1,
///
/// rounded to multiples of `resolution`, cut off at +-`clipping`. e is what changes within a record: a drift of the
/// gain from 0 at the first reading to `gain_drift` at the last, and `outlier_size` at one reading of each
/// `outlier_every`, the middle one. A signal that lags is read `lag(w)` late; of
/// histories the motion that is sampled must allow for that (`scenarios/measurements/measure.hpp`), of phases it is
/// done here.
///
/// An amplitude is half the difference of a peak and a trough, each read once a period, averaged over
/// `average_cycles`: a standard deviation of noise/sqrt(2 periods), and no offset. A phase is read at zero
/// crossings of x and y, rising and falling, so that the noise of a period is noise/amplitude. Extremes of a free
/// vibration are read once, their times exactly.
///
/// The draws of each signal are a stream of their own (core/random.hpp): a reading depends on the seed, the signal
/// and its number in the record. Cost: about 40 ns a noisy reading. Errors: a
/// `core::InputError` for a negative or unknown noise, resolution, clipping or number of readings, or an average
/// over no period.

#include <cstdint>
#include <limits>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// In units of its signal; the default is perfect.
struct Sensor {
  double noise = 0.0;         ///< standard deviation of a reading
  double resolution = 0.0;    ///< step between readings; 0: none
  double offset = 0.0;        ///< reading of zero
  double gain_error = 0.0;    ///< relative
  double gain_drift = 0.0;    ///< relative, over the record
  int outlier_every = 0;      ///< readings of which one is off; 0: none
  double outlier_size = 0.0;  ///< relative
  double phase_lag = 0.0;     ///< at the forcing frequency [rad]
  double delay = 0.0;         ///< s
  double clipping = std::numeric_limits<double>::infinity();

  /// Time by which readings come late [s]; w [rad/s] may be `unknown` without a phase lag.
  [[nodiscard]] double lag(double omega) const { return phase_lag == 0.0 ? delay : delay + phase_lag / omega; }
};

struct Sensors {
  double sample_rate = 0.0;  ///< Hz; 0: amplitudes are read, not histories
  int average_cycles = 1;    ///< periods that an amplitude is averaged over
  Sensor y, x, v, a, force;
};

/// The record that the sensors make of an exact one, its pairs, extremes and samples.
[[nodiscard]] Record read(const Record& exact, const Sensors& sensors, std::uint64_t seed);

}  // namespace dualdamp::identify
