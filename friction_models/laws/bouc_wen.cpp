#include "friction_models/laws/bouc_wen.hpp"

#include "friction_models/formulas/smooth.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& BoucWen::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "limit",
       .unit = "N",
       .range = positive,
       .meaning = "force at which a spring of this stiffness yields"},
      {.name = "stiffness", .unit = "N/m", .range = positive, .meaning = "stiffness before yielding"},
      {.name = "exponent", .unit = "1", .range = {.low = 1.0}, .meaning = "sharpness of yielding"},
      {.name = "ratio",
       .unit = "1",
       .fallback = 0.0,
       .range = {.low = 0.0, .high = 1.0, .high_open = true},
       .meaning = "share of the stiffness that does not yield"},
      {.name = "beta_share",
       .unit = "1",
       .fallback = 0.5,
       .range = not_negative,
       .meaning = "beta/(beta + gamma), the share of |z|^exponent that changes its sign with v z"},
  };
  return table;
}

std::vector<std::string> BoucWen::warnings(const ParameterValues& values) {
  if (values.number("beta_share") >= 0.5) return {};
  return {"it gives out work in unloading: beta_share is below 0.5"};
}

void BoucWen::rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const {
  const double yield = divisor(now.force_limit_now(limit_), limit_) / stiffness_;
  const double power = continued_power(memory.mode * memory.state[0] / yield, exponent_);
  rates[0] = now.v * (1.0 - power * (beta_share_ * sign(direction) * memory.mode + 1.0 - beta_share_));
}

void BoucWen::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  // Where there was no force limit the spring starts unstretched.
  if (trigger.cause == Trigger::limit_change && now.force_limit_now(limit_) == 0.0) memory = start(now);
  if (trigger.cause >= 0) {
    memory.mode = -memory.mode;
  } else if (memory.mode == unmoved) {
    memory.mode = static_cast<int>(direction);
  }
}

double BoucWen::dissipation(const Memory& memory, const Instant& now, Direction direction) const {
  double rate = 0.0;
  rates(memory, now, direction, {&rate, 1});
  return (1.0 - ratio_) * stiffness_ * memory.state[0] * (now.v - rate);
}

LawEntry bouc_wen_entry() {
  return {.name = "bouc_wen",
          .summary = "hysteretic spring that yields gradually (Bouc and Wen)",
          .equation =
              "F = stiffness (ratio x + (1 - ratio) z);  z' = v (1 - |z/z0|^exponent (b sgn(v z) + 1 - b)), z0 "
              "= limit/stiffness, b = beta_share",
          .engine = EngineKind::smooth,
          .states = "hysteretic deflection z",
          .is_passive = false,
          .caution = "A loop does not close where it began: it has no return-point memory.",
          .sources = "bouc1967, wen1976, erlicher2004",
          .modifiers = {"drift", "fluctuation", "warming"},
          .parameters = BoucWen::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const BoucWen law(p.number("limit"), p.number("stiffness"), p.number("exponent"), p.number("ratio"),
                              p.number("beta_share"));
            return {modified(law, p, {}, {.stiffness = p.number("ratio") * p.number("stiffness")})};
          },
          .warnings = BoucWen::warnings};
}

}  // namespace dualdamp::friction
