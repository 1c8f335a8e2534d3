#include "friction_models/laws/generalized_maxwell_slip.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/numbers.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

namespace {

/// Shares written with a dozen digits add to 1 within this.
constexpr double rounding_of_shares = 1e-9;

std::vector<GeneralizedMaxwellSlip::Element> elements_of(const ParameterValues& values) {
  std::vector<GeneralizedMaxwellSlip::Element> elements;
  for (const ParameterValues& element : values.list("elements"))
    elements.push_back({element.number("stiffness"), element.number("share")});
  return elements;
}

}  // namespace

const std::vector<Parameter>& GeneralizedMaxwellSlip::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = StribeckCurve::parameters(positive);
    list.insert(
        list.begin(),
        {.name = "elements",
         .kind = ParameterKind::list,
         .fields = {{.name = "stiffness", .unit = "N/m", .range = positive, .meaning = "stiffness of the spring"},
                    {.name = "share",
                     .unit = "1",
                     .range = {.low = 0.0, .high = 1.0, .low_open = true},
                     .sums_to_one = true,
                     .meaning = "share of the level at which it slips"}},
         .meaning = "springs that slip, in any order; their shares add to 1"});
    list.push_back({.name = "attraction",
                    .unit = "N/s",
                    .range = positive,
                    .meaning = "rate at which slipping elements approach the friction level"});
    return list;
  }();
  return table;
}

std::vector<ParameterFault> GeneralizedMaxwellSlip::check(const ParameterValues& values) {
  double sum = 0.0;
  for (const Element& element : elements_of(values)) sum += element.share;
  if (std::abs(sum - 1.0) <= rounding_of_shares) return {};
  return {{.name = "elements",
           .message = "the shares of 'elements' do not add to 1",
           .allowed = "shares whose sum is 1",
           .found = "a sum of " + core::format_number(sum)}};
}

std::vector<std::string> GeneralizedMaxwellSlip::warnings(const ParameterValues& values) {
  if (values.number("static") == values.number("kinetic")) return {};
  return {"it may give out more work than it took in: static is above kinetic"};
}

GeneralizedMaxwellSlip::GeneralizedMaxwellSlip(std::vector<Element> elements, const StribeckCurve& curve,
                                               double attraction)
    : elements_(std::move(elements)), curve_(curve), attraction_(attraction) {}

GeneralizedMaxwellSlip::GeneralizedMaxwellSlip(const ParameterValues& values)
    : GeneralizedMaxwellSlip(elements_of(values), StribeckCurve(values), values.number("attraction")) {}

Memory GeneralizedMaxwellSlip::start(const Instant&) const {
  return {.indices = std::vector<int>(elements_.size(), stuck), .state = std::vector<double>(elements_.size())};
}

double GeneralizedMaxwellSlip::force(const Memory& memory, const Instant&, Direction) const {
  return std::accumulate(memory.state.begin(), memory.state.end(), 0.0);
}

void GeneralizedMaxwellSlip::rates(const Memory& memory, const Instant& now, Direction direction,
                                   std::span<double> rates) const {
  const double level = curve_.divisor(now, sign(direction) * now.v);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto& [stiffness, share] = elements_[i];
    rates[i] = memory.indices[i] == stuck ? stiffness * now.v
                                          : attraction_ * (share * sign(direction) - memory.state[i] / level);
  }
}

void GeneralizedMaxwellSlip::guards(const Memory& memory, const Instant& now, Direction direction,
                                    std::vector<double>& values) const {
  if (direction == Direction::none) return;
  const double level = curve_.level(now, sign(direction) * now.v);
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (memory.indices[i] == stuck)
      values.push_back(elements_[i].share * level - sign(direction) * memory.state[i]);
}

void GeneralizedMaxwellSlip::jump(Memory& memory, Trigger trigger, const Instant& now, Direction) const {
  // Where there was no force limit no spring is stretched. F_i is set to zero, since it would be a quotient of two
  // vanishing numbers.
  if (trigger.cause == Trigger::limit_change && curve_.level(now, 0.0) == 0.0) memory = start(now);
  if (trigger.cause == Trigger::direction_change) std::ranges::fill(memory.indices, stuck);
  if (trigger.cause < 0) return;
  int guard = trigger.cause;
  for (int& mode : memory.indices)
    if (mode == stuck && guard-- == 0) {
      mode = slipping;
      return;
    }
}

void GeneralizedMaxwellSlip::scales(const Memory&, std::span<double> scales) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) scales[i] = elements_[i].share * curve_.kinetic();
}

double GeneralizedMaxwellSlip::dissipation(const Memory& memory, const Instant& now, Direction direction) const {
  std::vector<double> rate(elements_.size());
  rates(memory, now, direction, rate);
  double heat = 0.0;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (memory.indices[i] == slipping) heat += memory.state[i] * (now.v - rate[i] / elements_[i].stiffness);
  return heat;
}

double GeneralizedMaxwellSlip::stored_energy(const Memory& memory, const Instant&) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    energy += 0.5 * memory.state[i] * memory.state[i] / elements_[i].stiffness;
  return energy;
}

LawEntry generalized_maxwell_slip_entry() {
  return {.name = "generalized_maxwell_slip",
          .summary = "springs in parallel that slip one after the other at a level that falls with speed",
          .equation =
              "stuck: F_i' = stiffness v until sgn(v) F_i = share s(v);  slipping: F_i' = attraction (share sgn v "
              "- F_i/s(v));  F = sum of F_i, s(v) as g(v) of lugre",
          .engine = EngineKind::smooth,
          .states = "force of each element, and whether it slips",
          .is_passive = false,
          .sources = "lampaert2003, albender2005",
          // Where the load is lost the deflection would relax infinitely fast.
          .modifiers = all_modifiers_but("load_gradient"),
          .parameters = GeneralizedMaxwellSlip::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            return {modified(GeneralizedMaxwellSlip(p), p, {p.number("kinetic"), p.number("static")})};
          },
          .check = GeneralizedMaxwellSlip::check,
          .warnings = GeneralizedMaxwellSlip::warnings};
}

}  // namespace dualdamp::friction
