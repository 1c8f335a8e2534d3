#include "sim/engine/smooth/guards.hpp"

namespace dualdamp::sim {

using friction::Direction;

Guards::Guards(const Model& model, const Flow& flow) : model_(model), flow_(flow) {
  for (const friction::Law& law : model.friction) {
    has_memory_.push_back(law.has_memory());
    some_memory_ = some_memory_ || law.has_memory();
    can_stick_ = can_stick_ || law.holds_mass();
  }
}

void Guards::list(std::span<const double> X, double t) {
  endings_.clear();
  if (flow_.direction() != Direction::none) {
    endings_.emplace_back(SlipEnd{});
  } else if (can_stick_) {
    for (const Direction release : {Direction::forward, Direction::backward})
      endings_.emplace_back(StickEnd{release});
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (!has_memory_[i]) continue;
    values_.clear();
    flow_.guards(i, X, t, values_);
    for (std::size_t j = 0; j < values_.size(); ++j) endings_.emplace_back(LawGuard{i, static_cast<int>(j)});
  }
}

void Guards::evaluate(std::span<const double> X, double t, std::vector<double>& values) const {
  values.clear();
  if (flow_.direction() != Direction::none) {
    values.push_back(friction::sign(flow_.direction()) * X[1]);
  } else if (can_stick_) {
    const double pull = flow_.pull(X, t);
    const double limit = flow_.limit(X, t);
    values.push_back(limit - pull);
    values.push_back(limit + pull);
  }
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    if (has_memory_[i]) flow_.guards(i, X, t, values);
  }
}

double Guards::value(std::size_t guard, std::span<const double> X, double t) const {
  evaluate(X, t, values_);
  return values_[guard];
}

double Guards::rate(std::size_t guard, std::span<const double> X, double t, double length) const {
  rates_.resize(X.size());
  flow_.evaluate(X, t, rates_);
  if (is<SlipEnd>(endings_[guard])) return friction::sign(flow_.direction()) * rates_[1];
  const double step = part_of_rate * length;
  const auto value_after = [&](double s) {
    displaced_.assign(X.begin(), X.end());
    for (std::size_t k = 0; k < displaced_.size(); ++k) displaced_[k] += s * rates_[k];
    return value(guard, displaced_, t + s);
  };
  const double above = value_after(step);
  return (above - value_after(-step)) / (2.0 * step);
}

}  // namespace dualdamp::sim
