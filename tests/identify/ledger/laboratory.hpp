#pragma once
/// Records of random rigs as a laboratory would measure them, with errors of sensors and of stated constants.

#include <cstdint>
#include <string_view>
#include <vector>

#include "identify/assumption.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"
#include "tests/identify/ledger/rig.hpp"

namespace dualdamp::identify::testing {

enum class Kind {
  xy,        ///< 8 levels x 3 sweeps at resonance, amplitudes alone
  xy_phase,  ///< the same with phases
  response,  ///< 25 frequencies across resonance, noise in x and Y, phases
  extremes,  ///< extremes of a decay to rest, with times
  decay,     ///< history of a decay to rest and into noise
  forced,    ///< history of x, and of the force, from rest, near resonance
  beat,      ///< history under two close forces, from rest
  ramp,      ///< history under a force whose frequency rises through resonance
  random,    ///< history under a random force
};

[[nodiscard]] std::string_view name_of(Kind kind);

/// Errors beside the departures of the rig.
struct Off {
  double stiffness = 0.0;     ///< relative error of the stated stiffness
  double frequency = 0.0;     ///< of the stated frequency
  double delay = 0.0;         ///< of x, in periods
  double gain = 0.0;          ///< of x
  double drive_gain = 0.0;    ///< of Y or of the force
  double sweep_drift = 0.0;   ///< F0 of the last sweep over that of the first, less one
  double zero_drift = 0.0;    ///< of the zero of x, over the record, in x_f
  double v_noise = 0.0;       ///< of a measured velocity, over its largest value; 0: not measured
  double a_noise = 0.0;       ///< the same of a measured acceleration
  double zero = 0.0;          ///< of v and of a, in the deviation of their noise
  double noise = 1.0;         ///< factor on all noise
  double clock = 0.0;         ///< step of the clock that times of extremes are rounded to [s]; 0: none
  int bits = 0;               ///< of the converter of every signal, over 1.25 times its range; 0: none
  double samples = 100.0;     ///< of histories in a natural period
  int states = 25;            ///< of a response
  double shift = 0.0;         ///< of the frequencies of a response, in their range
  double drive_noise = 1.0;   ///< factor on the noise of Y
  double stated_noise = 0.0;  ///< stated deviation of x of a history, over the true one; 0: not stated
};

struct Measured {
  Record record;
  KnownConstants constants;
  Rig rig;  ///< the truth
  KnownDeviations deviations;
};

/// `alter` makes the rig depart. The same seed gives the same rig and noise.
[[nodiscard]] Measured measured(Kind kind, std::uint64_t seed, void (*alter)(Rig&) = nullptr, const Off& off = {});

}  // namespace dualdamp::identify::testing
