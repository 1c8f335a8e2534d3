#pragma once
/// The loops over packs, compiled once for each width of vector register.
///
/// Arrays have one entry for each oscillator; `count` is a multiple of the kernel's width. If a kernel cannot
/// certify an oscillator, it sets certified = 0 and leaves the oscillator to the exact engine; the numbers then
/// mean nothing.

#include <cstddef>

namespace dualdamp::sim::batch {

/// Where the drive acts.
enum class DriveOn {
  base,             ///< through the spring; damper to ground
  base_and_damper,  ///< through spring and damper
  mass,             ///< as a force
};

/// See sim/batch/batch.hpp for meaning and units.
struct Oscillators {
  DriveOn drive = DriveOn::base;
  std::size_t count = 0;
  const double* mass = nullptr;
  const double* damping = nullptr;
  const double* stiffness = nullptr;
  const double* kinetic = nullptr;
  const double* static_level = nullptr;
  const double* amplitude = nullptr;
  const double* frequency = nullptr;
};

struct Orbits {
  double* peak = nullptr;
  double* lag = nullptr;
  double* turned_re = nullptr;  ///< e^{i angle of the drive at the peak}
  double* turned_im = nullptr;
  double* radius = nullptr;
  double* searches = nullptr;  ///< core::SearchCount, of the half periods tried
  double* panels = nullptr;
  double* splits = nullptr;
  double* certified = nullptr;
};

struct PeriodsAhead {
  int periods = 0;
  double* position = nullptr;  ///< in and out
  double* velocity = nullptr;  ///< in and out
  double* amplitude = nullptr;
  double* reversals = nullptr;
  double* certified = nullptr;
};

struct Kernels {
  int width = 0;
  void (*find_orbits)(const Oscillators& oscillators, const Orbits& orbits) = nullptr;
  void (*pass_periods)(const Oscillators& oscillators, const PeriodsAhead& ahead) = nullptr;
};

/// Relative closure of an orbit.
inline constexpr double closure = 1e-14;

/// The largest width, a multiple of all others.
inline constexpr std::size_t widest = 8;

extern const Kernels scalar_kernels;
#ifdef __x86_64__
extern const Kernels sse2_kernels;
extern const Kernels avx2_kernels;
extern const Kernels avx512_kernels;
#endif

}  // namespace dualdamp::sim::batch
