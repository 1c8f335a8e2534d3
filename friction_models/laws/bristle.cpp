#include "friction_models/laws/bristle.hpp"

#include <algorithm>
#include <numeric>

#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

namespace {

/// Bristles beyond this part of their limit count as at the limit, so that rounding does not separate equal ones.
constexpr double part_of_limit = 1.0 - 1e-12;

}  // namespace

const std::vector<Parameter>& Bristle::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "stiffness", .unit = "N/m", .range = positive, .meaning = "stiffness of one bristle"},
      {.name = "snap_distance", .unit = "m", .range = positive, .meaning = "stretch at which a bristle snaps"},
      {.name = "count",
       .kind = ParameterKind::count,
       .range = {.low = 1.0, .high = 10'000.0},
       .meaning = "number of bristles"},
      {.name = "seed", .kind = ParameterKind::seed, .meaning = "seed of the random numbers"},
  };
  return table;
}

bool Bristle::has_length(const Instant& now) const {
  const Affine limit = now.force_limit(snap_distance_);
  return limit.constant != 0.0 || limit.rate != 0.0;
}

double Bristle::draw_position(Memory& memory, const Instant& now) const {
  const auto number = static_cast<std::uint64_t>(memory.indices[0]++);
  return now.x + now.force_limit_now(snap_distance_) * (2.0 * draws_.uniform(number) - 1.0);
}

Memory Bristle::start(const Instant& now) const {
  Memory memory{.indices = {0}};
  for (int i = 0; i < count_; ++i) memory.state.push_back(draw_position(memory, now));
  std::ranges::sort(memory.state);
  return memory;
}

Affine Bristle::affine_force(const Memory& memory, const Instant& now, Direction) const {
  if (!has_length(now)) return {};
  const double positions = std::accumulate(memory.state.begin(), memory.state.end(), 0.0);
  return {.constant = -stiffness_ * positions, .position = stiffness_ * count_};
}

void Bristle::affine_guards(const Memory& memory, const Instant& now, Direction,
                            std::vector<Affine>& guards) const {
  if (!has_length(now)) return;
  const Affine limit = now.force_limit(snap_distance_);
  guards.push_back(limit - Affine{.constant = -memory.state.front(), .position = 1.0});
  guards.push_back(limit + Affine{.constant = -memory.state.back(), .position = 1.0});
}

void Bristle::jump(Memory& memory, Trigger trigger, const Instant& now, Direction) const {
  std::vector<double>& positions = memory.state;
  if (trigger.cause == Trigger::limit_change && !has_length(now)) std::ranges::fill(positions, now.x);
  if (trigger.cause < 0) return;
  // All bristles at this end that are beyond the limit snap together: those at one position, and those that are
  // beyond the limit because it fell.
  const double limit = part_of_limit * now.force_limit_now(snap_distance_);
  const bool rear = trigger.cause == 0;
  do {
    const double position = draw_position(memory, now);
    positions.erase(rear ? positions.begin() : positions.end() - 1);
    positions.insert(std::ranges::lower_bound(positions, position), position);
  } while (rear ? now.x - positions.front() >= limit : positions.back() - now.x >= limit);
}

LawEntry bristle_entry() {
  return {.name = "bristle",
          .summary = "bonds that stretch, snap and form again at random (Haessig and Friedland)",
          .equation = "F = sum of stiffness (x - b);  at |x - b| = snap_distance: b = x + snap_distance U(-1, 1)",
          .states = "place of each bristle",
          .is_random = true,
          .is_odd = false,
          .sources = "haessig1991",
          .modifiers = {"fluctuation"},
          .parameters = Bristle::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Law law(Bristle(p.number("stiffness"), p.number("snap_distance"),
                                  static_cast<int>(p.count("count")), p.seed("seed")));
            return {modified(law, p)};
          }};
}

}  // namespace dualdamp::friction
