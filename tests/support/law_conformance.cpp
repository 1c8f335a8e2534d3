#include "tests/support/law_conformance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "friction_models/registry.hpp"
#include "tests/support/random.hpp"

namespace dualdamp::test {

namespace {

using friction::Affine;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;

constexpr int max_jumps = 32;
constexpr int strokes = 60;
constexpr int steps_per_stroke = 40;

/// Affine forms and laws evaluate the same few sums in another order.
constexpr double same = 1e-10;

/// Keeps each kind of fault once, with its first occasion.
class Faults {
 public:
  void add(const std::string& kind, const std::string& occasion = {}) {
    if (kinds_.insert(kind).second) list_.push_back(occasion.empty() ? kind : kind + " (" + occasion + ")");
  }
  [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

 private:
  std::set<std::string> kinds_;
  std::vector<std::string> list_;
};

double value_of(const Affine& a, double s, const Instant& now) {
  return a.constant + a.rate * s + a.position * now.x + a.velocity * now.v + a.transient * std::exp(-a.decay * s);
}

double size_of(const Affine& a, double s, const Instant& now) {
  return std::abs(a.constant) + std::abs(a.rate * s) + std::abs(a.position * now.x) + std::abs(a.velocity * now.v) +
         std::abs(a.transient);
}

Direction opposite(Direction direction) { return static_cast<Direction>(-static_cast<int>(direction)); }

/// The driver's part: a law, what it remembers, and where the mass is.
class Host {
 public:
  Host(const Law& law, const Instant& start, Faults& faults)
      : law_(law), faults_(faults), memory_(law.start(start)), now_(start) {
    settle();
  }

  [[nodiscard]] double force() const { return law_.force(memory_, now_, direction_); }
  [[nodiscard]] const Instant& now() const { return now_; }
  /// It makes no sense to go on.
  [[nodiscard]] bool broken() const { return broken_; }

  void turn(Direction direction) {
    for (const Direction next : {Direction::rest, direction}) {
      direction_ = next;
      if (law_.is_modal()) law_.jump(memory_, {}, now_, direction_);
      settle();
    }
  }

  /// Moves the mass to `end`, through the events of the law in between.
  template <class Path>
  void follow(double end, const Path& path) {
    examine(path((now_.t + end) / 2.0), path(end));
    for (int events = 0; now_.t < end && !broken_; ++events) {
      if (events > 100) return give_up("there is no end of events within one step");
      const Memory before = memory_;
      const Instant begin = now_;
      go(path(end));
      if (worst_guard() < 0) return;
      // The first moment at which a guard is below zero.
      double low = begin.t;
      double high = end;
      for (int i = 0; i < 80; ++i) {
        const double t = (low + high) / 2.0;
        memory_ = before;
        now_ = begin;
        go(path(t));
        (worst_guard() < 0 ? low : high) = t;
      }
      memory_ = before;
      now_ = begin;
      go(path(high));
      const int guard = worst_guard();
      if (guard < 0) continue;
      law_.jump(memory_, {guard}, now_, direction_);
      settle();
    }
  }

 private:
  /// States from now to `end`, no event in between.
  void go(const Instant& end) {
    if (law_.is_affine()) {
      law_.advance(memory_, now_, end, end.t - now_.t, direction_);
    } else if (law_.has_rates()) {
      integrate(end);
    }
    now_ = end;
  }

  /// Runge and Kutta's fourth order, with the speed varying linearly.
  void integrate(const Instant& end) {
    const std::size_t n = memory_.state.size();
    const double h = end.t - now_.t;
    const auto rates = [&](const std::vector<double>& state, double part) {
      Memory memory = memory_;
      memory.state = state;
      const Instant now{now_.t + part * h, now_.x + part * (end.x - now_.x), now_.v + part * (end.v - now_.v)};
      std::vector<double> result(n);
      law_.rates(memory, now, direction_, result);
      return result;
    };
    const auto moved = [&](const std::vector<double>& slope, double step) {
      std::vector<double> state = memory_.state;
      for (std::size_t i = 0; i < n; ++i) state[i] += step * slope[i];
      return state;
    };
    const std::vector<double> k1 = rates(memory_.state, 0.0);
    const std::vector<double> k2 = rates(moved(k1, h / 2.0), 0.5);
    const std::vector<double> k3 = rates(moved(k2, h / 2.0), 0.5);
    const std::vector<double> k4 = rates(moved(k3, h), 1.0);
    for (std::size_t i = 0; i < n; ++i) memory_.state[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }

  [[nodiscard]] std::vector<double> guards() const { return guards(memory_); }
  [[nodiscard]] std::vector<double> guards(const Memory& memory) const {
    std::vector<double> values;
    if (law_.is_modal()) law_.guards(memory, now_, direction_, values);
    return values;
  }

  /// The guard farthest below zero beyond rounding; -1: none.
  int worst_guard() {
    const std::vector<double> values = guards();
    int worst = -1;
    double least = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      guard_size_ = std::max(guard_size_, std::abs(values[i]));
      if (!std::isfinite(values[i])) faults_.add("a guard is not finite");
      if (values[i] < std::min(least, -1e-12 * guard_size_)) {
        least = values[i];
        worst = static_cast<int>(i);
      }
    }
    return worst;
  }

  void settle() {
    for (int i = 0; i <= max_jumps; ++i) {
      const int guard = worst_guard();
      if (guard < 0) return;
      law_.jump(memory_, {guard}, now_, direction_);
    }
    give_up("jumps do not end within 32 repeats");
  }

  void give_up(const std::string& fault) {
    faults_.add(fault);
    broken_ = true;
  }

  /// Size of the parts of a value that come from the states: their rounding is the value's.
  template <class Evaluate>
  [[nodiscard]] double share_of_states(const Evaluate& evaluate) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < memory_.state.size(); ++i) {
      Memory doubled = memory_;
      doubled.state[i] *= 2.0;
      sum += std::abs(evaluate(doubled) - evaluate(memory_));
    }
    return sum;
  }

  void compare(const Affine& affine, double s, const Instant& now, double value, double share,
               const std::string& what) {
    const double size = size_of(affine, s, now) + std::abs(value) + share;
    if (!(std::abs(value_of(affine, s, now) - value) <= same * size)) faults_.add(what);
  }

  /// All that can be asked of one step without leaving it for good.
  void examine(const Instant& middle, const Instant& end) {
    const Memory before = memory_;
    const Instant begin = now_;
    const double force = law_.force(memory_, now_, direction_);
    if (!std::isfinite(force)) faults_.add("the force is not finite");
    if (force != law_.force(memory_, now_, direction_) || memory_ != before) faults_.add("the force is not pure");
    const double limit = law_.static_limit(memory_, now_);
    if (!(limit >= 0.0) || !std::isfinite(limit)) faults_.add("the static limit is negative or not finite");
    if (limit > 0.0 && !law_.holds_mass()) faults_.add("a law that does not hold the mass has a static limit");
    if (!law_.is_affine()) return;

    const Affine affine = law_.affine_force(memory_, now_, direction_);
    const Affine affine_limit = law_.affine_limit(memory_, now_);
    std::vector<Affine> affine_guards;
    if (law_.is_modal()) law_.affine_guards(memory_, now_, direction_, affine_guards);
    const auto agree = [&](double s, const std::string& when) {
      const auto force_with = [&](const Memory& memory) { return law_.force(memory, now_, direction_); };
      compare(affine, s, now_, force_with(memory_), share_of_states(force_with),
              "affine force differs from the force " + when);
      const auto limit_with = [&](const Memory& memory) { return law_.static_limit(memory, now_); };
      compare(affine_limit, s, now_, limit_with(memory_), share_of_states(limit_with),
              "affine limit differs from the limit " + when);
      const std::vector<double> values = guards();
      if (values.size() != affine_guards.size())
        return faults_.add("there are more or fewer affine guards than guards");
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto guard_with = [&](const Memory& memory) { return guards(memory)[i]; };
        compare(affine_guards[i], s, now_, values[i], share_of_states(guard_with),
                "affine guards differ from the guards " + when);
      }
    };
    agree(0.0, "at the start of a phase");
    go(end);
    agree(end.t - begin.t, "after advance");
    const Memory whole = memory_;
    memory_ = before;
    now_ = begin;
    go(middle);
    go(end);
    for (std::size_t i = 0; i < whole.state.size(); ++i) {
      const double size = std::abs(whole.state[i]) + std::abs(before.state[i]);
      if (!(std::abs(memory_.state[i] - whole.state[i]) <= 1e-9 * size)) faults_.add("advance in halves differs");
    }
    memory_ = before;
    now_ = begin;
  }

  const Law& law_;
  Faults& faults_;
  Memory memory_;
  Instant now_;
  Direction direction_ = Direction::rest;
  double guard_size_ = 0.0;
  bool broken_ = false;
};

/// A stroke of length `length` (signed) from `begin`: speed (1 - cos)/T, zero at both ends.
struct Stroke {
  Instant begin;
  double length = 0.0;
  double duration = 1.0;

  Instant operator()(double t) const {
    const double angle = 2.0 * std::numbers::pi * (t - begin.t) / duration;
    return {t, begin.x + length * (angle - std::sin(angle)) / (2.0 * std::numbers::pi),
            length / duration * (1.0 - std::cos(angle))};
  }
};

void walk(const LawCase& c, Random& random, Faults& faults) {
  Host host(c.law, {}, faults);
  Host mirror(c.law, {}, faults);
  double work = 0.0;
  double exchanged = 0.0;
  double force_size = 0.0;
  for (int i = 0; i < strokes; ++i) {
    const bool rest = random.chance(0.15);
    Stroke path{host.now(), 0.0, c.stroke_time * random.logarithmic(0.1, 3.0)};
    if (!rest) path.length = random.sign() * c.stroke * random.logarithmic(1e-3, 1.0);
    const Direction direction = rest ? Direction::rest : path.length > 0 ? Direction::forward : Direction::backward;
    const auto mirrored = [&](double t) {
      const Instant now = path(t);
      return Instant{now.t, -now.x, -now.v};
    };
    host.turn(direction);
    mirror.turn(opposite(direction));
    for (int step = 1; step <= steps_per_stroke; ++step) {
      const double power = host.force() * host.now().v;
      const double from = host.now().t;
      const double to = path.begin.t + path.duration * step / steps_per_stroke;
      host.follow(to, path);
      if (c.odd) mirror.follow(to, mirrored);
      if (host.broken() || mirror.broken()) return;
      const double power_after = host.force() * host.now().v;
      work += (power + power_after) / 2.0 * (to - from);
      exchanged += (std::abs(power) + std::abs(power_after)) / 2.0 * (to - from);
      force_size = std::max(force_size, std::abs(host.force()));
      // The trapezoidal rule over a jump of the force errs by a step's work: a percent of all that is exchanged.
      if (c.passive && work < -1e-2 * exchanged) faults.add("it gives out more work than it took in");
      if (c.odd && std::abs(host.force() + mirror.force()) > 1e-9 * force_size) {
        faults.add("the mirrored path does not give the mirrored force");
      }
    }
  }
}

bool names(const std::vector<friction::ParameterFault>& faults, std::string_view name) {
  return std::any_of(faults.begin(), faults.end(), [&](const auto& fault) { return fault.name == name; });
}

void examine_parameters(const LawCase& c, Faults& faults) {
  const std::vector<friction::Parameter>& table = *c.parameters;
  friction::ParameterValues values = c.values;
  if (!friction::complete(table, values).empty()) return faults.add("the values of the case are refused");

  const auto refuse = [&](const friction::Parameter& parameter, double value, bool with_range) {
    friction::ParameterValues wrong = c.values;
    const std::string name(parameter.name);
    wrong[name] = value;
    const auto found = friction::complete(table, wrong);
    const auto fault = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.name == name; });
    const std::string what = "'" + name + "' = " + std::to_string(value);
    if (fault == found.end()) return faults.add(what + " is accepted");
    if (fault->found.empty()) faults.add(what + " is refused without the value");
    const std::string range = with_range ? parameter.range.describe(parameter.unit) : "a finite number";
    if (fault->allowed != range) faults.add(what + " is refused without the range");
  };
  for (const friction::Parameter& parameter : table) {
    const std::string name(parameter.name);
    if (parameter.meaning.empty() || parameter.unit.empty()) faults.add("'" + name + "' has no meaning or no unit");
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()}) {
      refuse(parameter, value, false);
    }
    const friction::Range& range = parameter.range;
    if (std::isfinite(range.low)) {
      refuse(parameter, range.low - 1e-3 * std::max(1.0, std::abs(range.low)), true);
      if (range.low_open) refuse(parameter, range.low, true);
    }
    if (std::isfinite(range.high)) {
      refuse(parameter, range.high + 1e-3 * std::max(1.0, std::abs(range.high)), true);
      if (range.high_open) refuse(parameter, range.high, true);
    }
    if (!parameter.at_least.empty() && values.at(std::string(parameter.at_least)) > range.low) {
      friction::ParameterValues wrong = values;
      const double floor = values.at(std::string(parameter.at_least));
      wrong[name] = std::nextafter(floor, -std::numeric_limits<double>::infinity());
      if (!names(friction::complete(table, wrong), name)) {
        faults.add("'" + name + "' below '" + std::string(parameter.at_least) + "' is accepted");
      }
    }
    if (parameter.required()) {
      friction::ParameterValues missing = c.values;
      missing.erase(name);
      if (!names(friction::complete(table, missing), name)) faults.add("a missing '" + name + "' is accepted");
    }
  }
  friction::ParameterValues unknown = c.values;
  unknown["no_such_parameter"] = 1.0;
  if (!names(friction::complete(table, unknown), "no_such_parameter"))
    faults.add("an unknown parameter is accepted");
}

}  // namespace

LawCase law_case(std::string_view name, const friction::ParameterValues& values) {
  const friction::LawEntry* entry = friction::find_law(name);
  if (entry == nullptr) throw std::invalid_argument("there is no law '" + std::string(name) + "'");
  friction::ParameterValues completed = values;
  if (!friction::complete(entry->parameters, completed).empty()) {
    throw std::invalid_argument("the values for '" + std::string(name) + "' are refused");
  }
  return {.law = entry->make(completed), .parameters = &entry->parameters, .values = values};
}

std::vector<std::string> nonconformities(const LawCase& c) {
  Faults faults;
  if (c.parameters != nullptr) examine_parameters(c, faults);
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    Random random(seed);
    walk(c, random, faults);
  }
  return faults.list();
}

}  // namespace dualdamp::test
