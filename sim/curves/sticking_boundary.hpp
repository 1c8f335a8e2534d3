#pragma once
/// The sticking boundary: at each frequency the smallest excitation amplitude whose steady state never sticks.
///
/// The engine finds it by bisection, for any law, between an amplitude at which the mass sticks somewhere in the
/// forcing period and one at which it does not; both are computed. Under Coulomb friction with static = kinetic, a
/// linear spring and one harmonic without offset, one amplitude divides sticking from sliding. Every other model
/// may have several (a second spring, harmonics, several steady states): there the amplitudes are scanned from
/// where the mass first moves (or from 1/1024 of the drive that equals the friction, if every drive moves it) up to
/// the first doubled amplitude that slides, in 32 steps a factor of two; the amplitudes of the caller are looked at
/// too. The boundary is the first change. A stretch of sliding that lies between two amplitudes of the scan is not
/// seen.
///
/// For the oscillator of denhartog1931 (only Coulomb friction with static = kinetic, a linear spring, one harmonic
/// of a force or, with the damper to ground, of the base) the result also has Den Hartog's closed form
/// (`sim/analytic/den_hartog.hpp`), which shares no code with the engine.
///
/// Where no law holds the mass (contacts that yield from the first motion on), it never sticks: no steady state is
/// computed.
///
/// Cost: some fifty steady states a frequency; with a scan some hundred to three hundred, and those of the caller's
/// amplitudes. Frequencies are computed in parallel. The search at a frequency has a limit of work, of which a scan
/// leaves a quarter to the bisection.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/outcome.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

struct BoundaryPoint {
  core::Outcome outcome;                ///< not ok(): no boundary was found
  double omega = 0.0;                   ///< rad/s
  double amplitude = 0.0;               ///< m (base) or N (force), to 2e-11; 1e-10 if motions hardly settle there
  double sticks = 0.0;                  ///< the largest amplitude found at which the mass sticks; 0: none
  double slides = 0.0;                  ///< the smallest one found at which it does not stick; 0: none
  double x = 0.0;                       ///< output amplitude at the boundary [m]
  std::optional<double> closed_form{};  ///< Den Hartog's amplitude, if his oscillator is this one
  /// The smallest and the largest amplitude above the boundary at which the scan saw the mass stick again; between
  /// them it need not stick everywhere.
  std::optional<std::pair<double, double>> sticks_again{};
  /// If the scan was stopped above the boundary because it takes too long: the largest amplitude it looked at.
  std::optional<double> seen_up_to{};
  bool is_stopped = false;  ///< no boundary was found, because the search takes too long
  long work = 0;            ///< `Engine::work` of all its steady states
  int unknown_below = 0;    ///< scanned amplitudes below the boundary without a steady state
};

/// Work of the search at one frequency; some half a minute.
inline constexpr long most_boundary_work = 20'000'000;

/// The boundary at each of `frequencies` [rad/s]; a scan also looks at `amplitudes` [m or N]. Needs a harmonic
/// excitation and a law that holds the mass.
[[nodiscard]] std::vector<BoundaryPoint> sticking_boundary(const Model& model, std::span<const double> frequencies,
                                                           std::span<const double> amplitudes = {},
                                                           long most_work = most_boundary_work);

}  // namespace dualdamp::sim
