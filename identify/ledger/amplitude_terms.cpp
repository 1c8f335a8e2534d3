#include "identify/ledger/amplitude_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/constants.hpp"
#include "identify/methods/amplitudes/input_levels.hpp"
#include "identify/models/sticking.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

using Complex = std::complex<double>;

namespace {

constexpr Complex i{0.0, 1.0};

/// The functions of Den Hartog's form. Most calls in a row differ in x or x_f alone: the slopes of a fit need three
/// zeta at each frequency, and all states of a frequency share them.
sim::analytic::DenHartog functions_at(double zeta, double r) {
  thread_local std::array<sim::analytic::DenHartog, 4> known{};  // r = 0, which no call has, marks an empty place
  thread_local std::size_t oldest = 0;
  for (const sim::analytic::DenHartog& one : known)
    if (one.zeta == zeta && one.r == r) return one;
  sim::analytic::DenHartog& found = known.at(oldest);
  oldest = (oldest + 1) % known.size();
  found = sim::analytic::den_hartog(zeta, r);
  return found;
}

}  // namespace

Complex plain_drive(const PlainFriction& friction, double x, double r) {
  const sim::analytic::DenHartog d = functions_at(friction.zeta, r);
  const double x_f = friction.x_f;
  const Complex stiffness((1.0 - r) * (1.0 + r), 2.0 * friction.zeta * r);
  // The drive that the closed form needs, counted from the turning point. The fundamental of x under it is what
  // friction leaves of it, over the stiffness: the phase is counted from there. Roots of norms: std::abs, which
  // minds overflow, would take a sixth of the ledger's time.
  const Complex drive = Complex(x + d.G * x_f, -d.H * x_f) * stiffness;
  const Complex left = drive - i * (4.0 / std::numbers::pi * x_f);
  const double size = std::sqrt(std::norm(left) * std::norm(stiffness));
  return size > 0.0 ? drive * (std::conj(left) * stiffness / size) : drive;
}

std::vector<SteadyPoint> points_of(const std::vector<Pair>& states, const KnownConstants& constants, double unit) {
  const double natural = constants.natural_frequency();
  std::vector<std::string> labels;
  std::vector<SteadyPoint> points;
  for (const Pair& pair : states) {
    auto label = std::ranges::find(labels, pair.sweep);
    if (label == labels.end()) label = labels.insert(labels.end(), pair.sweep);
    points.push_back({pair.Y / unit, pair.x / unit, pair.phase, pair.omega / natural,
                      static_cast<int>(label - labels.begin()), pair.number});
  }
  return points;
}

std::string lacks_levels(const std::vector<SteadyPoint>& points) {
  std::vector<Datum> pairs;
  pairs.reserve(points.size());
  for (const SteadyPoint& point : points) pairs.push_back({.Y = point.Y, .x = point.x, .r = point.r});
  return lacks_levels(pairs);
}

PlainFriction first_guess(const std::vector<SteadyPoint>& points) {
  PlainFriction best{0.05, 0.0};
  double least = core::infinity;
  for (double zeta = 0.002; zeta < 0.9; zeta *= 1.25) {
    for (double share = 0.0; share < 0.95; share += 0.05) {
      // x_f as a share of about that which takes the whole drive of the lowest state.
      const auto low = std::ranges::min_element(points, {}, &SteadyPoint::x);
      const PlainFriction friction{zeta, share * low->x * 0.8};
      double squares = 0.0;
      for (const SteadyPoint& point : points) {
        const double Y = std::abs(plain_drive(friction, point.x, point.r));
        squares += std::pow(std::log(Y / point.Y), 2);
      }
      if (squares >= least) continue;
      least = squares;
      best = friction;
    }
  }
  return best;
}

PlainFriction start_beside(const PlainFriction& plain, const std::vector<SteadyPoint>& points) {
  const auto gain = [](const SteadyPoint& point) { return point.x / point.Y; };
  const SteadyPoint& most = *std::ranges::max_element(points, {}, gain);
  const double viscous = most.Y / (2.0 * most.x);
  constexpr double edge = 0.1;
  if (plain.zeta > edge * viscous && plain.x_f > 0.0) return plain;
  return {0.5 * viscous, 0.5 * std::numbers::pi / 4.0 * most.Y};
}

namespace {

template <auto force>
Complex with_force(const PlainFriction& friction, double x, double r, double g) {
  return plain_drive(friction, x, r) + g * force(x, r);
}

// The spring stretches by x - y. Its fundamental e under the drive D = x - e obeys D = plain + g |e|^2 e, which is
// e (1 + g |e|^2) = x - plain: the spring has the pull of a linear one, and |e| is a root of a cubic. Beyond the
// largest pull of a softening spring it stays at that one.
Complex elongation(const PlainFriction& friction, double x, double r, double g) {
  const Complex pull = x - plain_drive(friction, x, r);
  const double root = std::sqrt(3.0 * std::abs(g));
  const double share = 1.5 * root * std::abs(pull);
  if (!(share > 0.0)) return pull;
  const double third =
      g > 0.0 ? std::sinh(std::asinh(share) / 3.0) : std::sin(std::asin(std::min(1.0, share)) / 3.0);
  return pull * (3.0 * third / share);
}

// Its cube also has a third harmonic, g |e|^3/3, which moves the mass at its turning points.
Complex with_cubic_spring(const PlainFriction& friction, double x, double r, double g) {
  const Complex e = elongation(friction, x, r, g);
  constexpr double least = 0.5;  // near r = 1/3 the harmonic is in resonance
  const double inertia = std::max(least, 9.0 * r * r - 1.0);
  const double harmonic = g / 3.0 * std::pow(std::abs(e), 3) * std::cos(3.0 * std::arg(e)) / inertia;
  const double fundamental = x - std::clamp(harmonic, -0.2 * x, 0.2 * x);
  return fundamental - elongation(friction, fundamental, r, g);
}

// Fundamentals of forces: the real part is in phase with x, the imaginary part with its velocity.
Complex second_mode(double x, double r) { return -r * r * r * r * x; }
Complex drag(double x, double r) { return i * (r * x) * (r * x); }
Complex cubic_damping(double x, double r) { return i * std::pow(r * x, 3); }
Complex low_speed(double x, double r) { return i / (r * x * r * x); }
// A contact that yields before it slides does less work, by a share that falls as 1/x. After each reversal it also
// has a restoring force, whose fundamental is proportional to the root of its deflection over x.
Complex presliding(double x, double /*r*/) { return i / x; }
Complex presliding_stiffness(double x, double /*r*/) { return 1.0 / std::sqrt(x); }
Complex position_slope(double x, double /*r*/) { return i * x; }

Complex detuned(const PlainFriction& friction, double x, double r, double g) {
  return plain_drive(friction, x, r * std::exp(g));
}
Complex gained(const PlainFriction& friction, double x, double r, double g) {
  return plain_drive(friction, x * std::exp(g), r);
}
Complex lagging(const PlainFriction& friction, double x, double r, double g) {
  return plain_drive(friction, x, r) * std::polar(1.0, g);
}
Complex delayed(const PlainFriction& friction, double x, double r, double g) {
  return plain_drive(friction, x, r) * std::polar(1.0, g * r);
}

using enum Assumption;
constexpr std::array<AmplitudeTerm, 13> all_amplitude_terms = {{
    // By the mass or by the stiffness: they differ only in F0 = k x_f.
    {constants, "natural frequency free, stiffness as stated", false, detuned, 0, Freed::mass},
    {constants, "natural frequency free, mass as stated", false, detuned, 0, Freed::stiffness},
    {sensors, "lag of the phase free", false, lagging},
    {sensors, "delay of x free", true, delayed},
    {sensors, "gain of x against y free", true, gained, 0, Freed::gain},
    {spring, "cubic stiffness", false, with_cubic_spring},
    {one_mode, "residual inertia of a further mode", false, with_force<second_mode>},
    {friction_velocity, "quadratic term over speed", false, with_force<drag>},
    {friction_velocity, "cubic term over speed", false, with_force<cubic_damping>},
    {friction_velocity, "force at low speed", false, with_force<low_speed>},
    {friction_displacement, "deflection before sliding", false, with_force<presliding>, -1},
    {friction_displacement, "restoring force before sliding", false, with_force<presliding_stiffness>, 1},
    {friction_displacement, "slope over position", true, with_force<position_slope>},
}};

}  // namespace

std::span<const AmplitudeTerm> amplitude_terms() { return all_amplitude_terms; }

bool drop_sticking(std::vector<SteadyPoint>& points, const PlainFriction& friction,
                   std::vector<std::string>& left_out) {
  if (!(friction.x_f > 0.0)) return false;
  const std::size_t before = points.size();
  Sticking sticking(friction.zeta, friction.x_f);
  std::erase_if(points, [&](const SteadyPoint& point) {
    const bool sticks = sticking.sticks(point.x, point.r);
    if (sticks) left_out.push_back("state " + std::to_string(point.number) + " sticks at the fit and is left out");
    return sticks;
  });
  return points.size() < before;
}

}  // namespace dualdamp::identify
