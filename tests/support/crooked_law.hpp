#pragma once
/// A planted fault: Coulomb friction whose affine form, which the exact engine uses, is 0.1 % larger than its
/// force, which the smooth engine uses.

#include "friction_models/registry.hpp"

namespace dualdamp::test {

class Crooked {
 public:
  explicit Crooked(double kinetic) : kinetic_(kinetic) {}

  [[nodiscard]] double force(const friction::Memory&, const friction::Instant&,
                             friction::Direction direction) const {
    return friction::sign(direction) * kinetic_;
  }
  [[nodiscard]] double static_limit(const friction::Memory&, const friction::Instant&) const { return kinetic_; }
  [[nodiscard]] friction::Affine affine_force(const friction::Memory&, const friction::Instant&,
                                              friction::Direction direction) const {
    return {.constant = 1.001 * friction::sign(direction) * kinetic_};
  }
  [[nodiscard]] friction::Affine affine_limit(const friction::Memory&, const friction::Instant&) const {
    return {.constant = kinetic_};
  }

 private:
  double kinetic_;
};

/// Registers `law: crooked` for this process.
inline void add_crooked_law() {
  if (friction::find_law("crooked") != nullptr) return;
  friction::add_law({.name = "crooked",
                     .summary = "a planted fault",
                     .equation = "F = kinetic sgn v, or a little more",
                     .parameters = {{.name = "kinetic", .unit = "N", .range = {.low = 0.0}}},
                     .make = [](const friction::ParameterValues& p) -> std::vector<friction::Law> {
                       return {friction::Law(Crooked(p.number("kinetic")))};
                     }});
}

}  // namespace dualdamp::test
