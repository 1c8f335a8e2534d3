#include "tests/support/random_oscillations.hpp"

#include <fmt/format.h>
#include <vector>

#include "friction_models/laws/bristle.hpp"
#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/iwan.hpp"
#include "friction_models/laws/reset_integrator.hpp"

namespace dualdamp::test {

namespace {

/// Force levels are shares of the drive's force, so that the mass overcomes them.
double drive_force(const Oscillation& o) { return o.model.oscillator.stiffness * o.model.excitation.amplitude; }

template <class L>
void append(Oscillation& o, L law) {
  o.model.friction.push_back(friction::Law(std::move(law)));
}

void add_coulomb(Oscillation& o, Random& random) {
  const double kinetic = drive_force(o) * random.logarithmic(1e-2, 0.7);
  const double limit = random.chance(0.5) ? kinetic : kinetic * random.uniform(1.0, 1.8);
  append(o, friction::Coulomb(kinetic, limit));
  o.plain.add_coulomb(kinetic, limit);
}

void add_contact(Oscillation& o, LawKind kind, Random& random, const Ranges& ranges) {
  const sim::Oscillator& oscillator = o.model.oscillator;
  const double kinetic = drive_force(o) * random.logarithmic(1e-3, 0.9);
  const double stiffness = oscillator.stiffness * random.logarithmic(0.1, ranges.stiffest);
  double limit = kinetic;
  double damping = 0.0;
  if (kind == LawKind::contact_static) limit *= 1.0 + random.logarithmic(1e-3, 1.0);
  if (kind == LawKind::contact_damped) {
    if (random.chance(0.5)) limit *= 1.0 + random.logarithmic(1e-3, 1.0);
    damping = stiffness / sim::natural_frequency(oscillator) * random.logarithmic(1e-2, 1.0);
  }
  append(o, friction::ContactCompliance(kinetic, limit, stiffness, damping));
  o.plain.add_contact(kinetic, limit, stiffness, damping);
}

/// Two to thirty elements: in half of the cases spread evenly, otherwise each drawn.
void add_iwan(Oscillation& o, Random& random, const Ranges& ranges) {
  const int count = 2 + random.pick(29);
  const double stiffness = o.model.oscillator.stiffness * random.logarithmic(0.3, 0.1 * ranges.stiffest);
  const double limit = drive_force(o) * random.logarithmic(1e-2, 0.9);
  const double n = count;
  const bool even = random.chance(0.5);
  std::vector<friction::Iwan::Element> elements;
  for (int i = 0; i < count; ++i) {
    if (even) {
      elements.push_back({stiffness / n, 2.0 * limit * (i + 0.5) / (n * n)});
    } else {
      elements.push_back({stiffness / n * random.logarithmic(0.2, 2.0), limit / n * random.logarithmic(0.05, 3.0)});
    }
    o.plain.add_iwan(elements.back().stiffness, elements.back().limit);
  }
  append(o, friction::Iwan(elements));
}

void add_reset_integrator(Oscillation& o, Random& random, const Ranges& ranges) {
  const sim::Oscillator& oscillator = o.model.oscillator;
  const double kinetic = drive_force(o) * random.logarithmic(1e-3, 0.7);
  const double stiffness = oscillator.stiffness * random.logarithmic(0.1, ranges.stiffest);
  const double gain = random.chance(0.3) ? 0.0 : random.logarithmic(1e-3, 0.5);
  double damping = 0.0;
  if (random.chance(0.5))
    damping = oscillator.mass * sim::natural_frequency(oscillator) * random.logarithmic(1e-2, 10.0);
  append(o, friction::ResetIntegrator(kinetic, stiffness, gain, damping));
  o.plain.add_reset_integrator(kinetic, stiffness, gain, damping);
}

void add_bristles(Oscillation& o, Random& random) {
  const int count = 1 + random.pick(12);
  const double distance = o.model.excitation.amplitude * random.logarithmic(0.05, 1.0);
  const double stiffness = drive_force(o) * random.logarithmic(1e-2, 1.0) / (count * distance);
  const auto seed = static_cast<std::uint64_t>(random.pick(1'000'000));
  append(o, friction::Bristle(stiffness, distance, count, seed));
  o.plain.add_bristles(stiffness, distance, count, seed);
}

}  // namespace

std::string_view name(LawKind kind) {
  static constexpr std::array<std::string_view, 7> names = {"coulomb",
                                                            "contact_compliance",
                                                            "contact_compliance, static > kinetic",
                                                            "contact_compliance, damped",
                                                            "iwan",
                                                            "reset_integrator",
                                                            "bristle"};
  return names[static_cast<std::size_t>(kind)];
}

std::string Oscillation::describe() const {
  const sim::Oscillator& o = model.oscillator;
  const sim::Excitation& e = model.excitation;
  return fmt::format("m {:.17g}, k {:.17g}, c {:.17g}, Y {:.17g}, w {:.17g}, phase {:.17g}, x0 {:.17g}, v0 {:.17g}",
                     o.mass, o.stiffness, o.damping, e.amplitude, e.frequency, e.phase, model.initial.position,
                     model.initial.velocity);
}

Oscillation random_oscillator(Random& random, const Ranges& ranges) {
  Oscillation result;
  const double wn = random.logarithmic(1.0, 100.0);
  const double mass = random.logarithmic(0.1, 10.0);
  double zeta = random.logarithmic(ranges.damping_ratio[0], ranges.damping_ratio[1]);
  if (random.chance(0.2)) zeta = 0.0;
  result.model.oscillator = {.mass = mass, .stiffness = mass * wn * wn, .damping = 2.0 * zeta * mass * wn};
  if (random.chance(0.3)) result.model.oscillator.damper_to = sim::DamperTo::base;
  const double amplitude = random.logarithmic(1e-3, 1.0);
  const double ratio = random.logarithmic(ranges.frequency_ratio[0], ranges.frequency_ratio[1]);
  result.model.excitation = {.type = sim::ExcitationType::base_harmonic,
                             .amplitude = amplitude,
                             .frequency = wn * ratio,
                             .phase = random.angle()};
  const double side = random.sign();
  result.model.initial.position = amplitude * random.uniform(-0.5, 0.5);
  result.model.initial.velocity = side * wn * amplitude * random.uniform(0.05, 1.0);
  return result;
}

void add_law(Oscillation& oscillation, LawKind kind, Random& random, const Ranges& ranges) {
  switch (kind) {
    case LawKind::coulomb:
      return add_coulomb(oscillation, random);
    case LawKind::contact:
    case LawKind::contact_static:
    case LawKind::contact_damped:
      return add_contact(oscillation, kind, random, ranges);
    case LawKind::iwan:
      return add_iwan(oscillation, random, ranges);
    case LawKind::reset_integrator:
      return add_reset_integrator(oscillation, random, ranges);
    case LawKind::bristle:
      return add_bristles(oscillation, random);
  }
}

void start(Oscillation& oscillation) { oscillation.plain.start(oscillation.model.initial.position); }

}  // namespace dualdamp::test
