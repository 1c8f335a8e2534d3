#include "friction_models/bouc_wen.hpp"

#include "friction_models/smooth.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& BoucWen::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "limit",
       .unit = "N",
       .range = {.low = 0.0, .low_open = true},
       .meaning = "force at which a spring of this stiffness yields"},
      {.name = "stiffness",
       .unit = "N/m",
       .range = {.low = 0.0, .low_open = true},
       .meaning = "stiffness before yielding"},
      {.name = "exponent", .unit = "1", .range = {.low = 1.0}, .meaning = "sharpness of yielding"},
      {.name = "ratio",
       .unit = "1",
       .fallback = 0.0,
       .range = {.low = 0.0, .high = 1.0, .high_open = true},
       .meaning = "share of the stiffness that does not yield"},
      {.name = "beta_share",
       .unit = "1",
       .fallback = 0.5,
       .range = {.low = 0.0},
       .meaning = "beta/(beta + gamma), the share of |z|^exponent that changes its sign with v z"},
  };
  return table;
}

std::vector<std::string> BoucWen::warnings(const ParameterValues& values) {
  if (values.number("beta_share") >= 0.5) return {};
  return {"it gives out work in unloading: beta_share is below 0.5"};
}

void BoucWen::rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const {
  const double yield = divisor(now.limit_now(limit_), limit_) / stiffness_;
  const double power = continued_power(memory.mode * memory.state[0] / yield, exponent_);
  rates[0] = now.v * (1.0 - power * (beta_share_ * sign(direction) * memory.mode + 1.0 - beta_share_));
}

void BoucWen::jump(Memory& memory, Trigger trigger, const Instant&, Direction direction) const {
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

}  // namespace dualdamp::friction
