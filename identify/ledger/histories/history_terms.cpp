#include "identify/ledger/histories/history_terms.hpp"

#include <array>
#include <cmath>

namespace dualdamp::identify {

namespace {

using At = SampledOscillator::Instant;

double elongation(const At& at, const MotionScale& scale) { return (at.x - at.y) / scale.length; }
double speed(const At& at, const MotionScale& scale) { return at.v / scale.speed; }

double drive_gain(const At& at, const MotionScale& /*scale*/) { return -at.drive; }
double cubic_spring(const At& at, const MotionScale& scale) { return std::pow(elongation(at, scale), 3); }
double square_spring(const At& at, const MotionScale& scale) { return std::pow(elongation(at, scale), 2); }
double friction_drift(const At& at, const MotionScale& /*scale*/) { return at.direction * (at.course - 0.5); }
double damping_drift(const At& at, const MotionScale& scale) { return speed(at, scale) * (at.course - 0.5); }
double drag(const At& at, const MotionScale& scale) { return at.direction * std::pow(speed(at, scale), 2); }
double cubic_damping(const At& at, const MotionScale& scale) { return std::pow(speed(at, scale), 3); }
// A Stribeck force and a presliding force fall over a share of the largest speed and of the amplitude.
template <int percent>
double falling(const At& at, const MotionScale& scale) {
  return at.direction * std::exp(-at.direction * speed(at, scale) / (0.01 * percent));
}
// Rounder: the law `stribeck`. Over a short record drag or a cubic term beside other zeta and F0 is nearly the
// same.
template <int percent>
double stribeck(const At& at, const MotionScale& scale) {
  return at.direction * std::exp(-std::pow(speed(at, scale) / (0.01 * percent), 2));
}
double presliding(const At& at, const MotionScale& scale) {
  constexpr double share = 0.03;
  return -at.direction * std::exp(-at.path / (share * scale.length));
}
double position_slope(const At& at, const MotionScale& scale) {
  return at.direction * std::abs(at.x) / scale.length;
}
double one_sided_friction(const At& /*at*/, const MotionScale& /*scale*/) { return 1.0; }
double one_sided_damping(const At& at, const MotionScale& scale) { return at.direction * speed(at, scale); }

using enum Assumption;

constexpr HistoryTerm hidden(std::string_view test, double (*force)(const At& at, const MotionScale& scale)) {
  return {.assumption = friction_velocity, .test = test, .force = force, .is_hidden = true};
}

constexpr std::array<HistoryTerm, 18> all_history_terms = {{
    {sensors, "gain of the drive free", drive_gain, 0, false, Freed::gain},
    {spring, "cubic stiffness", cubic_spring},
    {spring, "quadratic stiffness", square_spring},
    {stationarity, "friction force that drifts", friction_drift},
    {stationarity, "damping that drifts", damping_drift},
    {.assumption = friction_velocity, .test = "quadratic term over speed", .force = drag, .is_law = true},
    {friction_velocity, "cubic term over speed", cubic_damping},
    {friction_velocity, "force at low speed", falling<10>},
    hidden("force that falls over 20 % of the largest speed", falling<20>),
    hidden("Stribeck force below 10 % of the largest speed", stribeck<10>),
    hidden("Stribeck force below 14 % of the largest speed", stribeck<14>),
    hidden("Stribeck force below 20 % of the largest speed", stribeck<20>),
    hidden("Stribeck force below 28 % of the largest speed", stribeck<28>),
    hidden("Stribeck force below 40 % of the largest speed", stribeck<40>),
    {.assumption = friction_displacement,
     .test = "friction that builds up after a reversal",
     .force = presliding,
     .sign = 1,
     .is_of_contact = true,
     .is_law = true},
    {friction_displacement, "slope over position", position_slope},
    {.assumption = symmetry,
     .test = "friction force of its own in each direction",
     .force = one_sided_friction,
     .is_constant = true},
    {symmetry, "damping of its own in each direction", one_sided_damping, 0, true},
}};

}  // namespace

std::span<const HistoryTerm> history_terms() { return all_history_terms; }

}  // namespace dualdamp::identify
