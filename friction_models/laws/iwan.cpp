#include "friction_models/laws/iwan.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "friction_models/law_entry.hpp"
#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/modifiers/force_limits.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

namespace {

/// Slip distances that differ by less than this, relative, count as equal: they may differ by the rounding of f/k.
constexpr double equal = 1e-12;

/// The stack of segments in a Memory. Mode: the direction in which elements slide, 0 if none slides. Indices: two
/// for each segment, from the bottom up. State: the reversal point of each segment. All elements before the first
/// element of the top segment slide.
class Segments {
 public:
  struct Segment {
    int first = 0;          ///< of its elements
    int end = 0;            ///< one behind its last element
    int direction = 0;      ///< in which they slid before they stuck; 0: they have not slid yet
    double reversal = 0.0;  ///< x at which they stuck [m]
  };

  Segments(const Memory& memory, int elements) : memory_(memory), elements_(elements) {}

  [[nodiscard]] std::size_t size() const { return memory_.state.size(); }
  [[nodiscard]] bool empty() const { return memory_.state.empty(); }
  [[nodiscard]] Segment operator[](std::size_t i) const {
    return {first(i), i == 0 ? elements_ : first(i - 1), memory_.indices[2 * i + 1], memory_.state[i]};
  }
  [[nodiscard]] Segment top() const { return (*this)[size() - 1]; }
  [[nodiscard]] int sliding() const { return empty() ? elements_ : first(size() - 1); }

 private:
  [[nodiscard]] int first(std::size_t i) const { return memory_.indices[2 * i]; }

  const Memory& memory_;
  int elements_;
};

void push(Memory& memory, int first, int direction, double reversal) {
  memory.indices.push_back(first);
  memory.indices.push_back(direction);
  memory.state.push_back(reversal);
}

void pop(Memory& memory) {
  memory.indices.resize(memory.indices.size() - 2);
  memory.state.pop_back();
}

}  // namespace

const std::vector<Parameter>& Iwan::parameters() {
  const Parameter stiffness{
      .name = "stiffness", .unit = "N/m", .range = positive, .meaning = "stiffness of the spring"};
  const Parameter limit{
      .name = "limit", .unit = "N", .range = positive, .meaning = "force at which the slider slides"};
  Parameter total_stiffness = stiffness;
  total_stiffness.instead_of = "elements";
  total_stiffness.meaning = "stiffness of all springs together";
  Parameter total_limit = limit;
  total_limit.instead_of = "elements";
  total_limit.meaning = "force at which all sliders slide";
  static const std::vector<Parameter> table = {
      {.name = "elements",
       .kind = ParameterKind::list,
       .fields = {stiffness, limit},
       .meaning = "springs with their sliders, in any order"},
      total_stiffness,
      total_limit,
      {.name = "count",
       .kind = ParameterKind::count,
       .instead_of = "elements",
       .range = {.low = 1.0, .high = 10'000.0},
       .meaning = "number of elements"},
      {.name = "distribution",
       .kind = ParameterKind::choice,
       .words = {"uniform"},
       .fallback = "uniform",
       .instead_of = "elements",
       .meaning = "slip distances spread evenly from 0 to 2 limit/stiffness"},
  };
  return table;
}

std::vector<Iwan::Element> Iwan::elements(const ParameterValues& values) {
  if (!values.has("elements"))
    return uniform(values.number("stiffness"), values.number("limit"), static_cast<int>(values.count("count")));
  std::vector<Element> elements;
  for (const ParameterValues& element : values.list("elements"))
    elements.push_back({element.number("stiffness"), element.number("limit")});
  return elements;
}

std::vector<Iwan::Element> Iwan::uniform(double stiffness, double limit, int count) {
  std::vector<Element> elements;
  const double n = count;
  for (int i = 0; i < count; ++i) elements.push_back({stiffness / n, 2.0 * limit * (i + 0.5) / (n * n)});
  return elements;
}

Iwan::Iwan(std::vector<Element> elements) : stiffness_below_{0.0}, limit_below_{0.0} {
  assert(!elements.empty());
  const auto distance = [](const Element& e) { return e.limit / e.stiffness; };
  std::ranges::sort(elements, {}, distance);
  for (const Element& element : elements) {
    const double stiffness = stiffness_below_.back() + element.stiffness;
    const double limit = limit_below_.back() + element.limit;
    const double d = distance(element);
    if (!slip_distance_.empty() && d - slip_distance_.back() <= equal * d) {
      stiffness_below_.back() = stiffness;
      limit_below_.back() = limit;
    } else {
      slip_distance_.push_back(d);
      stiffness_below_.push_back(stiffness);
      limit_below_.push_back(limit);
    }
  }
}

Memory Iwan::start(const Instant& now) const {
  Memory memory;
  push(memory, 0, 0, now.x);
  return memory;
}

Affine Iwan::affine_force(const Memory& memory, const Instant&, Direction) const {
  const Segments segments(memory, count());
  const auto sliding = static_cast<std::size_t>(segments.sliding());
  Affine force{.constant = memory.mode * limit_below_[sliding],
               .position = stiffness_below_.back() - stiffness_below_[sliding]};
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto [first, end, direction, reversal] = segments[i];
    const auto from = static_cast<std::size_t>(first);
    const auto to = static_cast<std::size_t>(end);
    // The sum of k (x - a), a = reversal - direction d.
    force.constant += direction * (limit_below_[to] - limit_below_[from]) -
                      (stiffness_below_[to] - stiffness_below_[from]) * reversal;
  }
  return force;
}

/// The next element to slide is the stuck one with the smallest slip distance.
void Iwan::affine_guards(const Memory& memory, const Instant&, Direction direction,
                         std::vector<Affine>& guards) const {
  const Segments segments(memory, count());
  if (direction == Direction::none || segments.empty()) return;
  const Segments::Segment top = segments.top();
  const double s = sign(direction);
  const double distance = slip_distance_[static_cast<std::size_t>(top.first)];
  guards.push_back({.constant = (1.0 - s * top.direction) * distance + s * top.reversal, .position = -s});
}

void Iwan::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  if (trigger.cause == Trigger::direction_change && memory.mode != 0 && sign(direction) != memory.mode)
    push(memory, 0, std::exchange(memory.mode, 0), now.x);
  if (trigger.cause < 0) return;
  const Segments::Segment top = Segments(memory, count()).top();
  memory.mode = static_cast<int>(direction);
  // Back at a reversal point of this direction: the loop closes, and its elements slide together.
  if (top.direction == memory.mode || top.first + 1 == top.end) {
    pop(memory);
  } else {
    ++memory.indices[memory.indices.size() - 2];
  }
}

void Iwan::rates(const Memory&, const Instant&, Direction, std::span<double> rates) const {
  std::ranges::fill(rates, 0.0);
}

void Iwan::scales(const Memory&, std::span<double> scales) const {
  std::ranges::fill(scales, slip_distance_.front());
}

std::vector<Law> Iwan::laws(std::vector<Element> elements, const ParameterValues& values) {
  if (ModifierSettings(values).do_nothing()) return {Law(Iwan(std::move(elements)))};
  std::vector<Law> laws;
  for (const auto& [stiffness, limit] : elements)
    laws.push_back(modified(ContactCompliance(limit, limit, stiffness, 0.0), values));
  return laws;
}

LawEntry iwan_entry() {
  return {.name = "iwan",
          .summary = "springs with Coulomb sliders in parallel, which slide one after the other",
          .equation = "F = sum of stiffness (x - a) over stuck elements, of +-limit over sliding ones",
          .states = "turning points that are remembered",
          .sources = "iwan1966, masing1926",
          .modifiers = Iwan::modifiers(),
          .parameters = Iwan::parameters(),
          .make = [](const ParameterValues& p) { return Iwan::laws(Iwan::elements(p), p); }};
}

}  // namespace dualdamp::friction
