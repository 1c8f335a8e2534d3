#pragma once
/// A record whose sum of squares over the sought parameters is a function that a test states.

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "friction_models/law.hpp"
#include "identify/experiments/experiment.hpp"

namespace dualdamp::test {

/// Of `viscous_saturating` in `SumOfSquares`.
inline constexpr double saturating_coefficient = 2.0;  // N.s/m

/// Readings with a sum of squares of 60 + the squares of three parts, and a noise of 1. The parts are functions of
/// t = ln(saturation velocity / (1 m/s)) of the law `viscous_saturating`, and of the oscillator; nothing: no
/// motion.
class SumOfSquares final : public identify::Experiment {
 public:
  using Parts = std::function<std::optional<std::array<double, 3>>(double t, const sim::Oscillator& oscillator)>;

  explicit SumOfSquares(Parts parts) : parts_(std::move(parts)) {
    label = "stated sum of squares";
    identify::Signal signal{
        .name = "x", .unit = "m", .at_name = "t", .at_unit = "s", .noise = 1.0, .is_stated = true};
    for (Eigen::Index i = 0; i < 3 * group; ++i) {
      signal.measured.push_back(i % 2 == 0 ? 1.0 : -1.0);
      signal.at.push_back(static_cast<double>(i));
    }
    signals.push_back(std::move(signal));
  }

  [[nodiscard]] bool predict(const sim::Model& model, const identify::RecordValues& /*of_record*/,
                             Eigen::VectorXd& outputs) const override {
    // At this speed the law's force is its limit.
    const friction::Instant fast{.v = 1e12};
    const double limit = model.friction.front().force({}, fast, friction::Direction::forward);
    const auto parts = parts_(std::log(limit / saturating_coefficient), model.oscillator);
    if (!parts) return false;
    outputs.resize(3 * group);
    for (Eigen::Index part = 0; part < 3; ++part)
      outputs.segment(part * group, group)
          .setConstant((*parts)[static_cast<std::size_t>(part)] / std::sqrt(static_cast<double>(group)));
    return true;
  }

 private:
  static constexpr Eigen::Index group = 20;  ///< readings of one part

  Parts parts_;
};

}  // namespace dualdamp::test
