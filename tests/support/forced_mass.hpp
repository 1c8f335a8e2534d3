#pragma once
/// A free mass under a given force and one law, by Runge and Kutta's fourth order with a fixed step. Direction and
/// mode are those at the beginning of a step: if they change within the step, the error is of the order of the
/// step.

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "friction_models/law.hpp"

namespace dualdamp::test {

class ForcedMass {
 public:
  /// kg; load [N] over time [s]. The mass begins at rest at x = 0.
  ForcedMass(friction::Law law, double mass, std::function<double(double)> load)
      : law_(std::move(law)), mass_(mass), load_(std::move(load)), memory_(law_.start({})) {}

  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] double x() const { return z_[0]; }
  [[nodiscard]] double v() const { return z_[1]; }
  [[nodiscard]] double force() const { return law_.force(memory_at(z_), {t_, z_[0], z_[1]}, direction_); }

  void step(double h) {
    settle();
    const std::vector<double> k1 = rates(z_, t_);
    const std::vector<double> k2 = rates(moved(k1, h / 2.0), t_ + h / 2.0);
    const std::vector<double> k3 = rates(moved(k2, h / 2.0), t_ + h / 2.0);
    const std::vector<double> k4 = rates(moved(k3, h), t_ + h);
    for (std::size_t i = 0; i < z_.size(); ++i) z_[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    t_ += h;
  }

 private:
  [[nodiscard]] friction::Memory memory_at(const std::vector<double>& z) const {
    friction::Memory memory = memory_;
    memory.state.assign(z.begin() + 2, z.end());
    return memory;
  }
  [[nodiscard]] std::vector<double> rates(const std::vector<double>& z, double t) const {
    std::vector<double> slope(z.size());
    const double friction =
        law_.respond(memory_at(z), {t, z[0], z[1]}, direction_, {slope.data() + 2, z.size() - 2});
    slope[0] = z[1];
    slope[1] = (load_(t) - friction) / mass_;
    return slope;
  }
  [[nodiscard]] std::vector<double> moved(const std::vector<double>& slope, double h) const {
    std::vector<double> z = z_;
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += h * slope[i];
    return z;
  }
  /// Direction and mode of the next step.
  void settle() {
    memory_ = memory_at(z_);
    const friction::Instant now{t_, z_[0], z_[1]};
    const double ahead = z_[1] != 0.0 ? z_[1] : load_(t_) - law_.force(memory_, now, direction_);
    const auto next = ahead < 0.0 ? friction::Direction::backward : friction::Direction::forward;
    if (next != direction_) law_.jump(memory_, {}, now, next);
    direction_ = next;
    std::vector<double> guards;
    law_.guards(memory_, now, direction_, guards);
    for (std::size_t i = 0; i < guards.size(); ++i)
      if (guards[i] < 0.0) return law_.jump(memory_, {static_cast<int>(i)}, now, direction_);
  }

  friction::Law law_;
  double mass_;
  std::function<double(double)> load_;
  friction::Memory memory_;
  friction::Direction direction_ = friction::Direction::none;
  double t_ = 0.0;
  std::vector<double> z_ = [this] {
    std::vector<double> z(2);
    z.insert(z.end(), memory_.state.begin(), memory_.state.end());
    return z;
  }();
};

}  // namespace dualdamp::test
