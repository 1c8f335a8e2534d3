#include "identify/departures/departures.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <string>

#include "core/constants.hpp"
#include "identify/departures/groups.hpp"

namespace dualdamp::identify::departures {

namespace {

std::vector<Departure> those_that(bool (*belongs)(const Departure&)) {
  std::vector<Departure> list;
  std::ranges::copy_if(all_departures(), std::back_inserter(list), belongs);
  return list;
}

const Departure* find(const std::vector<Departure>& list, std::string_view name) {
  const auto found = std::ranges::find(list, name, &Departure::name);
  return found == list.end() ? nullptr : &*found;
}

RigBase base_of(const Apparatus& apparatus, const RigFriction& friction, double Y) {
  // In boundary lubrication friction falls over the first 10 mm/s.
  RigBase base{.F0 = friction.F0,
               .reference = apparatus.reference,
               .warming_time = apparatus.warming_time,
               .boundary_velocity = 0.01,
               .found_at_reference = true};
  base.model.oscillator = apparatus.oscillator;
  base.model.oscillator.damping = friction.c;
  base.model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = Y, .frequency = apparatus.reference.frequency};
  return base;
}

}  // namespace

std::string_view name_of(Family family) {
  static constexpr std::array<std::string_view, 10> names = {
      "none", "presliding", "velocity", "position", "memory", "spring", "sensors", "constants", "drive", "pairs"};
  return names.at(static_cast<std::size_t>(family));
}

const std::vector<Departure>& all_departures() {
  static const std::vector<Departure> list = [] {
    std::vector<Departure> all = joined({contact_departures(), sliding_departures(), film_departures(),
                                         drive_departures(), laboratory_departures()});
    std::ranges::sort(all, {}, &Departure::name);
    return all;
  }();
  return list;
}

const std::vector<Departure>& departures() {
  static const std::vector<Departure> list =
      those_that([](const Departure& departure) { return !departure.severity.empty(); });
  return list;
}

const std::vector<Departure>& mechanisms() {
  static const std::vector<Departure> list =
      those_that([](const Departure& departure) { return !departure.plausible.empty(); });
  return list;
}

const Departure* find_departure(std::string_view name) { return find(departures(), name); }

const Departure* find_mechanism(std::string_view name) { return find(mechanisms(), name); }

sim::Model undisturbed(const Truth& truth) { return with_coulomb({.model = truth.model, .F0 = truth.F0}); }

sim::Model departed(const Departure& departure, const Truth& truth, const ReferenceMotion& reference, double s) {
  const double period = core::two_pi / reference.frequency;
  const RigBase base{.model = truth.model,
                     .F0 = truth.F0,
                     .reference = reference,
                     .warming_time = 5.0 * period,
                     .boundary_velocity = 0.02 * reference.speed()};
  return departure.build(base, departure.values_at(base, s));
}

sim::Model driven(const Departure& mechanism, const Apparatus& apparatus, const RigFriction& friction,
                  std::span<const double> values, double Y) {
  return mechanism.build(base_of(apparatus, friction, Y), values);
}

sim::Model released(const Departure& mechanism, const Apparatus& apparatus, const RigFriction& friction,
                    std::span<const double> values, double stiffness, double displacement) {
  Apparatus other = apparatus;
  other.oscillator.stiffness = stiffness;
  const RigBase base = base_of(other, friction, apparatus.reference.Y);
  sim::Model model = mechanism.forced_only ? with_coulomb(base) : mechanism.build(base, values);
  model.excitation = {};
  model.initial = {.position = displacement};
  return model;
}

double natural_scale(const Apparatus& apparatus, std::string_view unit) {
  const double k = apparatus.oscillator.stiffness;
  const double X = apparatus.reference.amplitude;
  const double V = apparatus.reference.speed();
  const double force = k * apparatus.reference.Y;
  if (unit == "1") return 1.0;
  if (unit == "m") return X;
  if (unit == "m/s") return V;
  if (unit == "s") return 1.0 / apparatus.reference.frequency;
  if (unit == "N/m") return k;
  if (unit == "N/m^3") return k / (X * X);
  if (unit == "N.s^2/m^2") return force / (V * V);
  if (unit == "W") return force * V / 2.0;
  throw std::logic_error("no scale for the unit " + std::string(unit));
}

}  // namespace dualdamp::identify::departures
