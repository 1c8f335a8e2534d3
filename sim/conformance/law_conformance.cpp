#include "sim/conformance/law_conformance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "friction_models/registry.hpp"
#include "friction_models/state_sizes.hpp"
#include "sim/conformance/parameter_conformance.hpp"
#include "sim/law_host/law_host.hpp"

namespace dualdamp::sim {

namespace {

using friction::Affine;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;
using friction::Trigger;

constexpr int strokes = 60;
constexpr int steps_per_stroke = 40;

/// Relative tolerance: an affine form and its law evaluate the same few sums in different order.
constexpr double same = 1e-10;

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : stream_{seed} {}

  /// Uniform in the logarithm, in [low, high); low > 0.
  double logarithmic(double low, double high) { return low * std::pow(high / low, uniform()); }
  bool chance(double probability) { return uniform() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  double uniform() { return stream_.uniform(count_++); }

  core::RandomStream stream_;
  std::uint64_t count_ = 0;
};

double value_of(const Affine& a, double s, const Instant& now) {
  return a.constant + a.rate * s + a.position * now.x + a.velocity * now.v + a.transient * std::exp(-a.decay * s);
}

double size_of(const Affine& a, double s, const Instant& now) {
  return std::abs(a.constant) + std::abs(a.rate * s) + std::abs(a.position * now.x) + std::abs(a.velocity * now.v) +
         std::abs(a.transient);
}

/// The affine forms of a law in one mode: force, limit, guards.
std::vector<Affine> forms(const LawHost& host, const Memory& memory) {
  const Law& law = host.law();
  std::vector<Affine> list = {law.affine_force(memory, host.now(), host.direction()),
                              law.affine_limit(memory, host.now())};
  if (law.has_memory()) law.affine_guards(memory, host.now(), host.direction(), list);
  return list;
}

std::vector<double> coefficients(const std::vector<Affine>& forms) {
  std::vector<double> list;
  for (const Affine& a : forms) {
    for (const double c : {a.constant, a.rate, a.position, a.velocity, a.transient}) list.push_back(c);
  }
  return list;
}

/// For each form, the size of the parts that come from the states: the rounding of these parts is part of the
/// rounding of the form.
std::vector<double> shares_of_states(const LawHost& host, const std::vector<Affine>& at_present) {
  std::vector<double> shares(at_present.size());
  for (std::size_t i = 0; i < host.memory().state.size(); ++i) {
    Memory doubled = host.memory();
    doubled.state[i] *= 2.0;
    const std::vector<Affine> others = forms(host, doubled);
    for (std::size_t k = 0; k < std::min(shares.size(), others.size()); ++k)
      shares[k] += size_of(others[k] - at_present[k], 0.0, host.now());
  }
  return shares;
}

/// The affine forms at `begin`, evaluated at the time of `host`, must equal what the law says at `host`.
void compare_forms(const LawHost& begin, const LawHost& host, const std::string& when, Faults& faults) {
  const double s = host.now().t - begin.now().t;
  const std::vector<Affine> affine = forms(begin, begin.memory());
  const std::vector<double> shares = shares_of_states(begin, affine);
  std::vector<double> values = {host.force(), host.law().static_limit(host.memory(), host.now())};
  for (const double guard : host.guards()) values.push_back(guard);
  if (values.size() != affine.size()) return faults.add("there are more or fewer affine guards than guards");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double size = size_of(affine[i], s, host.now()) + std::abs(values[i]) + shares[i];
    if (std::abs(value_of(affine[i], s, host.now()) - values[i]) <= same * size) continue;
    faults.add((i == 0   ? "affine force differs from the force "
                : i == 1 ? "affine limit differs from the limit "
                         : "affine guards differ from the guards ") +
               when);
  }
}

/// f(z + d1 + d2) - f(z + d1) - f(z + d2) + f(z) = 0, for f a list of numbers.
template <class Function>
bool is_affine(const Function& f, const std::vector<double>& z, Random& random) {
  std::array<std::vector<double>, 4> at = {z, z, z, z};
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double d1 = random.sign() * random.logarithmic(1e-3, 1e3) * (std::abs(z[i]) + 1e-3);
    const double d2 = random.sign() * random.logarithmic(1e-3, 1e3) * (std::abs(z[i]) + 1e-3);
    at[1][i] += d1;
    at[2][i] += d2;
    at[3][i] += d1 + d2;
  }
  const std::array<std::vector<double>, 4> values = {f(at[0]), f(at[1]), f(at[2]), f(at[3])};
  for (const auto& list : values) {
    if (list.size() != values[0].size()) return false;
  }
  for (std::size_t k = 0; k < values[0].size(); ++k) {
    const double size =
        std::abs(values[0][k]) + std::abs(values[1][k]) + std::abs(values[2][k]) + std::abs(values[3][k]);
    if (!(std::abs(values[3][k] - values[1][k] - values[2][k] + values[0][k]) <= same * size)) return false;
  }
  return true;
}

/// All members: a new one of the course does not compile here until it is in the list.
auto numbers_of(const friction::ModifierCourse& course) {
  const auto& [drift_ended, cell, level, side, unloaded, vanished] = course;
  return std::array{drift_ended ? 1.0 : 0.0,   static_cast<double>(cell), level,
                    static_cast<double>(side), unloaded ? 1.0 : 0.0,      static_cast<double>(vanished)};
}

/// Tests that forms and jumps are affine: the engine differentiates them by displacing states and positions.
void examine_displaced(const LawHost& host, bool with_jumps, Random& random, Faults& faults) {
  const std::vector<double>& state = host.memory().state;
  const auto forms_at = [&](const std::vector<double>& z) {
    Memory memory = host.memory();
    memory.state = z;
    return coefficients(forms(host, memory));
  };
  if (!is_affine(forms_at, state, random)) faults.add("force, limit or guards are not affine in the states");
  if (!with_jumps) return;
  std::vector<double> place = state;
  place.push_back(host.now().x);
  place.push_back(host.now().v);
  std::vector<int> causes = {Trigger::direction_change, Trigger::limit_change};
  for (int i = 0; i < static_cast<int>(host.guards().size()); ++i) causes.push_back(i);
  for (const int cause : causes) {
    for (const Direction direction : {Direction::backward, Direction::none, Direction::forward}) {
      if (cause != Trigger::direction_change && direction != host.direction()) continue;
      const auto jumped = [&](const std::vector<double>& z) {
        Memory memory = host.memory();
        std::copy_n(z.begin(), state.size(), memory.state.begin());
        Instant now = host.now();
        now.x = z[state.size()];
        now.v = z[state.size() + 1];
        host.law().jump(memory, {cause}, now, direction);
        std::vector<double> result = memory.state;
        result.push_back(memory.mode);
        for (const int index : memory.indices) result.push_back(index);
        for (const double part : numbers_of(memory.course)) result.push_back(part);
        return result;
      };
      if (!is_affine(jumped, place, random)) faults.add("a jump is not affine in states, position and speed");
    }
  }
}

/// The rates are the derivative of `advance`, by a one-sided difference of second order.
void examine_rates(const LawHost& host, const Path& path, double duration, Faults& faults) {
  const std::size_t n = host.memory().state.size();
  double decay = 1.0 / duration;
  for (const Affine& form : forms(host, host.memory())) decay = std::max(decay, form.decay);
  const double h = 1e-3 / decay;
  LawHost once = host;
  LawHost twice = host;
  once.go(host.now().t + h, path);
  twice.go(host.now().t + 2.0 * h, path);
  std::vector<double> rates(n);
  host.law().rates(host.memory(), host.now(), host.direction(), rates);
  for (std::size_t i = 0; i < n; ++i) {
    const double z0 = host.memory().state[i];
    const double z1 = once.memory().state[i];
    const double z2 = twice.memory().state[i];
    const double difference = (-3.0 * z0 + 4.0 * z1 - z2) / (2.0 * h);
    const double size = std::abs(rates[i]) + decay * std::abs(z0);
    if (!(std::abs(difference - rates[i]) <= 1e-5 * size))
      faults.add("rates differ from the derivative of advance");
  }
}

/// Force and rates at this speed, in the direction frozen by the host.
std::vector<double> response(const LawHost& host, double v) {
  Instant now = host.now();
  now.v = v;
  std::vector<double> values(host.memory().state.size() + 1);
  values.back() = host.law().respond(host.memory(), now, host.direction(), {values.data(), values.size() - 1});
  return values;
}

/// Tests for a kink at v = 0: without one a second difference grows as the square of its width.
void examine_kink(const LawHost& host, double speed, Faults& faults) {
  const double e = 1e-4 * speed;
  const std::vector<double> centre = response(host, 0.0);
  const std::array<std::vector<double>, 4> around = {response(host, e), response(host, -e), response(host, 2.0 * e),
                                                     response(host, -2.0 * e)};
  for (std::size_t i = 0; i < centre.size(); ++i) {
    const double narrow = std::abs(around[0][i] - 2.0 * centre[i] + around[1][i]);
    const double wide = std::abs(around[2][i] - 2.0 * centre[i] + around[3][i]);
    const double size = std::abs(around[2][i]) + std::abs(centre[i]) + std::abs(around[3][i]);
    if (narrow > 1e-10 * size && wide < 3.0 * narrow)
      faults.add("force or rates have a kink at v = 0 while the direction of slip is frozen");
  }
}

/// The checks of one instant of a law that is not affine.
void examine_response(const LawHost& host, const LawCase& c, Faults& faults) {
  const Law& law = host.law();
  const Memory& memory = host.memory();
  const std::vector<double> values = response(host, host.now().v);
  std::vector<double> rates(memory.state.size());
  law.rates(memory, host.now(), host.direction(), rates);
  if (values.back() != host.force() || !std::equal(rates.begin(), rates.end(), values.begin()))
    faults.add("the response differs from force and rates");
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    faults.add("a rate is not finite");
  std::vector<double> scales(rates.size());
  law.scales(memory, scales);
  const auto fits = [](double scale) {
    return scale >= 0.0 && (std::isfinite(scale) || scale == friction::size_of_velocity);
  };
  if (!std::ranges::all_of(scales, fits)) faults.add("the scale of a state is negative or not finite");
  const double heat = law.dissipation(memory, host.now(), host.direction());
  const double power = values.back() * host.now().v;
  if (!std::isfinite(heat)) faults.add("the dissipation is not finite");
  // If the law states no dissipation, heat is the power F v, which may be negative.
  if (c.passive && heat != power && heat < -same * std::abs(power)) faults.add("the dissipation is negative");
  if (host.direction() != Direction::none) examine_kink(host, c.stroke / c.stroke_time, faults);
}

/// The checks of one step, before the step. There must be no event between now and `end`.
void examine(const LawHost& host, const Path& path, double end, const LawCase& c, Random& random, Faults& faults) {
  const Law& law = host.law();
  Memory before;  // a copy: a law from a library may write to the memory although it must only read
  before = host.memory();
  const double force = host.force();
  if (!std::isfinite(force)) faults.add("the force is not finite");
  if (force != host.force() || host.memory() != before) faults.add("the force is not pure");
  const double limit = law.static_limit(host.memory(), host.now());
  if (!(limit >= 0.0) || !std::isfinite(limit)) faults.add("the static limit is negative or not finite");
  if (limit > 0.0 && !law.holds_mass()) faults.add("a law that does not hold the mass has a static limit");
  if (!law.is_affine()) return examine_response(host, c, faults);

  compare_forms(host, host, "at the start of an interval", faults);
  LawHost whole = host;
  whole.go(end, path);
  compare_forms(host, whole, "after advance", faults);
  LawHost halves = host;
  halves.go((host.now().t + end) / 2.0, path);
  halves.go(end, path);
  for (std::size_t i = 0; i < before.state.size(); ++i) {
    const double size = std::abs(whole.memory().state[i]) + std::abs(before.state[i]);
    if (!(std::abs(halves.memory().state[i] - whole.memory().state[i]) <= 1e-9 * size))
      faults.add("advance in halves differs");
  }
  if (law.has_memory()) examine_displaced(host, !c.random, random, faults);
  if (law.advances()) examine_rates(host, path, end - host.now().t, faults);
}

/// A stroke of length `length` (signed) from `begin`: speed (1 - cos)/T, zero at both ends.
struct Stroke {
  Instant begin;
  double length = 0.0;
  double duration = 1.0;

  Instant operator()(double t) const {
    const double angle = core::two_pi * (t - begin.t) / duration;
    return {t, begin.x + length * (angle - std::sin(angle)) / core::two_pi,
            length / duration * (1.0 - std::cos(angle))};
  }
};

/// Random strokes, with sticks between some of them; the second host has the mirrored path. Returns the forces.
std::vector<double> walk(const LawCase& c, std::uint64_t seed, Faults& faults) {
  Random random(seed);
  LawHost host(c.law, {});
  LawHost mirror(c.law, {});
  std::vector<double> forces;
  double exchanged = 0.0;
  double force_size = 0.0;
  for (int i = 0; i < strokes; ++i) {
    const bool sticks = random.chance(0.15);
    Stroke stroke{host.now(), 0.0, c.stroke_time * random.logarithmic(0.1, 3.0)};
    if (!sticks) stroke.length = random.sign() * c.stroke * random.logarithmic(1e-3, 1.0);
    const Direction direction = friction::direction_of(stroke.length);
    const Path path = stroke;
    const Path mirrored = [stroke](double t) {
      const Instant now = stroke(t);
      return Instant{now.t, -now.x, -now.v};
    };
    host.change_direction(direction);
    mirror.change_direction(opposite(direction));
    for (int step = 1; step <= steps_per_stroke; ++step) {
      const double power = host.force() * host.now().v;
      const double from = host.now().t;
      const double to = stroke.begin.t + stroke.duration * step / steps_per_stroke;
      examine(host, path, std::min(to, c.law.next_change(host.memory())), c, random, faults);
      host.move_along(to, path);
      if (c.odd) mirror.move_along(to, mirrored);
      for (const LawHost* each : {&host, &mirror}) {
        if (!each->broken()) continue;
        for (const std::string& fault : each->faults()) faults.add(fault);
        return forces;
      }
      const double power_after = host.force() * host.now().v;
      exchanged += (std::abs(power) + std::abs(power_after)) / 2.0 * (to - from);
      forces.push_back(host.force());
      force_size = std::max(force_size, std::abs(host.force()));
      // The work of an affine law is computed by the trapezoidal rule.
      if (c.passive && host.work() < -(c.law.is_affine() ? 1e-2 : 1e-8) * exchanged)
        faults.add("it gives out more work than it took in");
      if (c.odd && std::abs(host.force() + mirror.force()) > 1e-9 * force_size)
        faults.add("the mirrored path does not give the mirrored force");
    }
  }
  return forces;
}

/// Tests that a factor on the force limits gives the same as the law with its force limits multiplied.
void examine_factor(const LawCase& c, Faults& faults) {
  const double factor = 0.6;
  Random random(7);
  LawHost modified(c.law, {.modification = {.factor = factor}});
  LawHost scaled(c.scaled(factor), {});
  double force_size = 0.0;
  for (int i = 0; i < strokes; ++i) {
    Stroke stroke{scaled.now(), random.sign() * c.stroke * random.logarithmic(1e-3, 1.0), c.stroke_time};
    const Direction direction = friction::direction_of(stroke.length);
    modified.change_direction(direction);
    scaled.change_direction(direction);
    for (int step = 1; step <= steps_per_stroke; ++step) {
      const double to = stroke.begin.t + stroke.duration * step / steps_per_stroke;
      scaled.move_along(to, stroke);
      modified.move_along(to, [stroke, factor](double t) {
        Instant now = stroke(t);
        now.modification.factor = factor;
        return now;
      });
      force_size = std::max(force_size, std::abs(scaled.force()));
      const double limit = scaled.law().static_limit(scaled.memory(), scaled.now());
      const double modified_limit = modified.law().static_limit(modified.memory(), modified.now());
      if (!(std::abs(modified.force() - scaled.force()) <= 1e-9 * force_size) ||
          !(std::abs(modified_limit - limit) <= same * limit))
        return faults.add("a factor on its limits is not the law with scaled limits");
    }
  }
}

friction::Law with_scaled_limits(const friction::LawEntry& entry, friction::ParameterValues values, double factor) {
  for (const std::string_view name : entry.limits) values.set(name, factor * values.number(name));
  return entry.make(values).front();
}

/// Whether the values have modifiers whose effect differs between the two sides of x = 0.
bool differs_by_side(const friction::ParameterValues& values) {
  if (values.has("load_gradient")) return true;
  return values.has("fluctuation") && values.record("fluctuation").has("correlation_length");
}

}  // namespace

LawCase law_case(std::string_view name, const friction::ParameterValues& values) {
  const friction::LawEntry* entry = friction::find_law(name);
  if (entry == nullptr) throw std::invalid_argument("there is no law '" + std::string(name) + "'");
  friction::ParameterValues completed = values;
  if (!friction::complete(*entry, completed).empty()) {
    throw std::invalid_argument("the values for '" + std::string(name) + "' are refused");
  }
  const std::vector<friction::Law> made = entry->make(completed);
  if (made.size() != 1) throw std::invalid_argument("'" + std::string(name) + "' is several laws in parallel");
  LawCase result{.law = made.front(),
                 .parameters = &entry->parameters,
                 .values = values,
                 .odd = entry->is_odd && !differs_by_side(completed),
                 .passive = entry->is_passive,
                 .random = entry->is_random};
  if (!entry->limits.empty())
    result.scaled = [=](double factor) { return with_scaled_limits(*entry, completed, factor); };
  return result;
}

std::vector<std::string> nonconformities(const LawCase& c) {
  Faults faults;
  if (c.parameters != nullptr) examine_parameters(*c.parameters, c.values, faults);
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const std::vector<double> forces = walk(c, seed, faults);
    if (seed == 5U && walk(c, seed, faults) != forces)
      faults.add("the same path gives other forces the second time");
  }
  if (c.scaled) examine_factor(c, faults);
  return faults.list();
}

}  // namespace dualdamp::sim
