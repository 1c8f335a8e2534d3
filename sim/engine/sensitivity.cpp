#include "sim/engine/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::sim {

using friction::Affine;
using friction::Direction;
using friction::Instant;
using friction::Law;
using friction::Memory;

namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

void Sensitivity::begin(const Memories& memories, bool with_memory, const std::vector<double>& units) {
  units_ = units;
  std::size_t columns = 2;
  for (const Memory& memory : memories) columns += memory.state.size();
  motion_.assign(columns, Eigen::Vector2d::Zero());
  motion_[0].x() = units_[0];
  motion_[1].y() = units_[1];
  states_.resize(memories.size());
  std::size_t first = 2;
  for (std::size_t i = 0; i < memories.size(); ++i) {
    const std::size_t count = memories[i].state.size();
    states_[i].setZero(at(count), at(columns));
    for (std::size_t k = 0; k < count; ++k) states_[i](at(k), at(first + k)) = units_[first + k];
    first += count;
  }
  guard_.assign(columns, 0.0);
  shift_.assign(columns, 0.0);
  with_states_ = with_memory;
  crossing_ = false;
}

bool Sensitivity::perturbed(std::size_t law, std::size_t column) const {
  return states_[law].rows() > 0 && !states_[law].col(at(column)).isZero(0.0);
}

/// The difference of state `k` of a perturbed memory (`probe_`, before its change `unchanged_`) from the present
/// one, after both changed. Where both kept their values, as a slider that stays stuck does, so does the
/// difference: a new subtraction would round it, and the state would not count as one that a period never changes.
double Sensitivity::difference(std::size_t law, std::size_t k, std::size_t column, const Memory& before,
                               const Memory& after) const {
  const bool kept =
      k < before.state.size() && after.state[k] == before.state[k] && probe_.state[k] == unchanged_.state[k];
  return kept ? states_[law](at(k), at(column)) : probe_.state[k] - after.state[k];
}

const Memory& Sensitivity::displaced(const Memory& memory, std::size_t law, std::size_t column) {
  probe_ = memory;
  for (std::size_t k = 0; k < probe_.state.size(); ++k) probe_.state[k] += states_[law](at(k), at(column));
  return probe_;
}

Instant Sensitivity::displaced(const Instant& now, std::size_t column) const {
  return {now.t, now.x + motion_[column].x(), now.v + motion_[column].y(), now.modification};
}

void Sensitivity::begin_interval(Laws laws, const Memories& memories, const Instant& now, Direction direction,
                                 const std::vector<double>& decays) {
  begin_ = motion_;
  if (!with_states_) return;
  force_.assign(motion_.size(), Eigen::VectorXd::Zero(at(1 + decays.size())));
  for (std::size_t i = 0; i < laws.size(); ++i) {
    if (memories[i].state.empty()) continue;
    const Affine base = laws[i].affine_force(memories[i], now, direction);
    for (std::size_t c = 0; c < motion_.size(); ++c) {
      if (!perturbed(i, c)) continue;
      const Affine change = laws[i].affine_force(displaced(memories[i], i, c), now, direction) - base;
      force_[c][0] -= change.constant;
      const auto decay = std::find(decays.begin(), decays.end(), change.decay);
      if (change.transient != 0.0 && decay != decays.end())
        force_[c][1 + (decay - decays.begin())] -= change.transient;
    }
  }
}

void Sensitivity::slip(const Eigen::Matrix2d& propagator, std::span<const Eigen::Vector2d> responses) {
  for (std::size_t c = 0; c < motion_.size(); ++c) {
    motion_[c] = (propagator * motion_[c]).eval();
    if (!with_states_) continue;
    for (std::size_t j = 0; j < responses.size(); ++j) motion_[c] += force_[c][at(j)] * responses[j];
  }
}

void Sensitivity::stick() {
  for (Eigen::Vector2d& column : motion_) column.y() = 0.0;
}

void Sensitivity::perturb_guard(Laws laws, const Memories& memories, const Instant& begin, Direction direction,
                                std::size_t law, std::size_t guard, double duration) {
  if (memories[law].state.empty()) return;
  const auto form = [&](const Memory& memory) {
    forms_.clear();
    laws[law].affine_guards(memory, begin, direction, forms_);
    return forms_[guard];
  };
  const Affine base = form(memories[law]);
  for (std::size_t c = 0; c < motion_.size(); ++c) {
    if (!perturbed(law, c)) continue;
    const Affine change = form(displaced(memories[law], law, c)) - base;
    guard_[c] = change.constant + change.transient * std::exp(-change.decay * duration);
  }
}

void Sensitivity::perturb_limit(double factor, const std::vector<double>& decays, double duration) {
  if (!with_states_) return;
  for (std::size_t c = 0; c < motion_.size(); ++c) {
    guard_[c] = factor * force_[c][0];
    for (std::size_t j = 0; j < decays.size(); ++j)
      guard_[c] += factor * force_[c][at(1 + j)] * std::exp(-decays[j] * duration);
  }
}

void Sensitivity::advance(const Law& law, std::size_t index, const Memory& before, const Memory& after,
                          const Instant& begin, const Instant& end, double duration, Direction direction) {
  for (std::size_t c = 0; c < motion_.size() && !after.state.empty(); ++c) {
    unchanged_ = displaced(before, index, c);
    const Instant from{begin.t, begin.x + begin_[c].x(), begin.v + begin_[c].y(), begin.modification};
    law.advance(probe_, from, displaced(end, c), duration, direction);
    for (std::size_t k = 0; k < after.state.size(); ++k)
      states_[index](at(k), at(c)) = difference(index, k, c, before, after);
  }
}

/// Moves the states of every perturbation along the present motion by `factor` times its own shift. The caller
/// moves position and velocity.
void Sensitivity::flow(double factor, Laws laws, const Memories& memories, const Instant& now,
                       Direction direction) {
  for (std::size_t i = 0; i < laws.size() && with_states_; ++i) {
    if (!laws[i].has_rates() || memories[i].state.empty()) continue;
    rates_.assign(memories[i].state.size(), 0.0);
    laws[i].rates(memories[i], now, direction, rates_);
    for (std::size_t c = 0; c < motion_.size(); ++c) {
      for (std::size_t k = 0; k < rates_.size(); ++k) states_[i](at(k), at(c)) += factor * shift_[c] * rates_[k];
    }
  }
}

void Sensitivity::enter(const Event& event, Laws laws, const Memories& memories, const Instant& now,
                        Direction direction) {
  crossing_ = true;
  for (std::size_t c = 0; c < motion_.size(); ++c) {
    const double change = event.by_position * motion_[c].x() + event.by_velocity * motion_[c].y() + guard_[c];
    guard_[c] = 0.0;
    // A guard that only touches zero has no crossing that could be shifted.
    shift_[c] = event.slope != 0.0 ? -change / event.slope : 0.0;
    motion_[c] += shift_[c] * Eigen::Vector2d(event.velocity, event.acceleration);
  }
  flow(1.0, laws, memories, now, direction);
}

void Sensitivity::jump(const Law& law, std::size_t index, const Memory& before, const Memory& after,
                       friction::Trigger trigger, const Instant& now, Direction direction) {
  if (before.state.empty() && after.state.empty()) return;
  Eigen::MatrixXd changed(at(after.state.size()), at(motion_.size()));
  for (std::size_t c = 0; c < motion_.size(); ++c) {
    unchanged_ = displaced(before, index, c);
    law.jump(probe_, trigger, displaced(now, c), direction);
    for (std::size_t k = 0; k < after.state.size(); ++k)
      changed(at(k), at(c)) = difference(index, k, c, before, after);
  }
  states_[index] = std::move(changed);
}

void Sensitivity::leave(double acceleration, Laws laws, const Memories& memories, const Instant& now,
                        Direction direction) {
  if (!crossing_) return;
  crossing_ = false;
  for (std::size_t c = 0; c < motion_.size(); ++c) motion_[c] -= shift_[c] * Eigen::Vector2d(now.v, acceleration);
  flow(-1.0, laws, memories, now, direction);
}

Eigen::MatrixXd Sensitivity::matrix() const {
  Eigen::Index rows = 2;
  for (const Eigen::MatrixXd& states : states_) rows += states.rows();
  Eigen::MatrixXd result(rows, at(motion_.size()));
  for (std::size_t c = 0; c < motion_.size(); ++c) result.col(at(c)).head<2>() = motion_[c];
  Eigen::Index row = 2;
  for (const Eigen::MatrixXd& states : states_) {
    result.middleRows(row, states.rows()) = states;
    row += states.rows();
  }
  for (std::size_t c = 0; c < motion_.size(); ++c) result.col(at(c)) /= units_[c];
  return result;
}

}  // namespace dualdamp::sim
