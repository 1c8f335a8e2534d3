// Sets up an interval: the forces of the laws, the mode, the motion and the guards. exact_engine.cpp uses them.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sim/engine/exact_engine.hpp"

namespace dualdamp::sim {

using core::ModeFunction;
using friction::Affine;
using friction::Direction;

/// Asks every law once for its force in this interval; while the mass sticks also for the limits of the laws that
/// hold it; and for the guards.
void ExactEngine::collect(bool with_guards) {
  const int index = static_cast<int>(direction_) + 1;
  total_ = &totals_[static_cast<std::size_t>(index)];
  // Laws without modes have the same force in every interval of one direction.
  if (total_->lasting) return;
  total_->lasting = !some_memory_;
  const friction::Instant at = now();
  const bool sticks = direction_ == Direction::none;
  total_->force = total_->limit = {};
  total_->degree = drive_.degree();
  total_->transients.clear();
  total_->decays.clear();
  law_guards_.clear();
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    const friction::Law& law = model_.friction[i];
    if (sticks && holds_mass_[i]) add_limit(law.affine_limit(memories_[i], at));
    add_force(law.affine_force(memories_[i], at, direction_));
    if (!with_guards || !has_memory_[i]) continue;
    const std::size_t before = law_guards_.size();
    law.affine_guards(memories_[i], at, direction_, law_guards_);
    law_guard_counts_[i] = law_guards_.size() - before;
  }
  for (const Affine& guard : law_guards_) {
    if (guard.rate != 0.0) total_->degree = std::max(total_->degree, 1);
    if (guard.transient != 0.0) add_transient(0.0, guard.decay);
  }
}

void ExactEngine::add_force(const Affine& part) {
  total_->force.constant += part.constant;
  total_->force.rate += part.rate;
  total_->force.position += part.position;
  total_->force.velocity += part.velocity;
  if (part.rate != 0.0) total_->degree = std::max(total_->degree, 1);
  if (part.transient != 0.0) add_transient(part.transient, part.decay);
}

void ExactEngine::add_limit(const Affine& part) {
  assert(part.transient == 0.0);
  total_->limit.constant += part.constant + part.position * x_;
  total_->limit.position += part.position;
  total_->limit.rate += part.rate;
  if (part.rate != 0.0) total_->degree = std::max(total_->degree, 1);
}

void ExactEngine::add_transient(double size, double decay) {
  const auto known = std::find(total_->decays.begin(), total_->decays.end(), decay);
  if (known != total_->decays.end()) {
    total_->transients[static_cast<std::size_t>(known - total_->decays.begin())] += size;
    return;
  }
  total_->transients.push_back(size);
  total_->decays.push_back(decay);
}

const LinearMode& ExactEngine::mode_for(double damping, double stiffness) {
  const double mass = model_.oscillator.mass;
  // Most pieces of a drive are short beside the oscillator's own times.
  const bool is_brief = drive_.has_pieces() &&
                        drive_.period() * (std::abs(damping) / mass + std::sqrt(std::abs(stiffness) / mass)) <= 1.0;
  const auto fits = [&](const LinearMode& mode) {
    const LinearMode::Layout& layout = mode.layout();
    return mode.damping() == damping && mode.stiffness() == stiffness && layout.degree == total_->degree &&
           layout.is_brief == is_brief && layout.decays == total_->decays;
  };
  if (mode_ != nullptr && fits(*mode_)) return *mode_;
  key_.damping = damping;
  key_.stiffness = stiffness;
  key_.layout.degree = total_->degree;
  key_.layout.is_brief = is_brief;
  key_.layout.decays = total_->decays;
  const auto known = modes_.find(key_);
  if (known != modes_.end()) return known->second;
  // A law whose stiffness varies continuously would fill the list. Then all modes except the present one are
  // dropped.
  if (modes_.size() > 4096) std::erase_if(modes_, [&](const auto& entry) { return &entry.second != mode_; });
  return modes_.try_emplace(key_, mass, damping, stiffness, drive_.frequencies(), key_.layout).first->second;
}

/// forcing_ = drive + extra - the parts of the laws that do not depend on the motion.
void ExactEngine::load_forcing(double extra_constant) {
  forcing_.polynomial = drive_.force_polynomial();
  forcing_.polynomial[0] += extra_constant - total_->force.constant;
  forcing_.polynomial[1] -= total_->force.rate;
  for (std::size_t j = 0; j < forcing_.phasors.size(); ++j) forcing_.phasors[j] = drive_.force_phasor(j);
  forcing_.transients.resize(total_->transients.size());
  for (std::size_t j = 0; j < total_->transients.size(); ++j) forcing_.transients[j] = -total_->transients[j];
}

double ExactEngine::force_scale() const {
  return drive_.force_scale() + std::abs(total_->force.constant) +
         (model_.oscillator.stiffness + std::abs(total_->force.position)) * std::abs(x_);
}

/// The pull while the mass sticks here, as a function of time.
const LinearMode& ExactEngine::pull_on_mode(ModeFunction& pull) {
  const Oscillator& o = model_.oscillator;
  const double stiffness = o.stiffness + total_->force.position;
  const LinearMode& mode = mode_for(o.damping + total_->force.velocity, stiffness);
  load_forcing(-stiffness * x_);
  mode.represent(forcing_, pull);
  return mode;
}

/// limit - direction * pull
void ExactEngine::limit_guard(const ModeFunction& pull, double direction, ModeFunction& guard) const {
  const core::ExponentialBasis& basis = mode_->basis();
  ModeFunction level;
  mode_->represent({.polynomial = {total_->limit.constant, total_->limit.rate}}, level);
  core::assign(basis, -direction, pull, guard);
  core::accumulate(basis, 1.0, level, guard);
}

/// The pull at this instant; total_ holds the laws for direction none.
double ExactEngine::pull_now() const {
  double pull = drive_.force_polynomial()[0] - total_->force.constant -
                (model_.oscillator.stiffness + total_->force.position) * x_;
  for (std::size_t j = 0; j < drive_.frequencies().size(); ++j) pull += drive_.force_phasor(j).real();
  for (const double transient : total_->transients) pull -= transient;
  return pull;
}

core::Guard& ExactEngine::new_guard(const Watch& watch) {
  if (guard_count_ == guards_.size()) {
    guards_.emplace_back();
    watches_.emplace_back();
  }
  watches_[guard_count_] = watch;
  guards_[guard_count_].known_zeros = 0;
  return guards_[guard_count_++];
}

void ExactEngine::build_stick() {
  ModeFunction pull;
  mode_ = &pull_on_mode(pull);
  const core::ExponentialBasis& basis = mode_->basis();
  core::clear(basis, motion_);
  mode_->represent({.polynomial = {x_}}, motion_);
  force_scale_ = force_scale();
  if (!can_stick_) return;
  const double stiffness = model_.oscillator.stiffness + total_->force.position;
  for (const Direction release : {Direction::forward, Direction::backward}) {
    const double direction = friction::sign(release);
    core::Guard& guard = new_guard({.ending = StickEnd{release},
                                    .by_position = direction * stiffness + total_->limit.position,
                                    .tolerance = rounding * force_scale_});
    limit_guard(pull, direction, guard.value);
    core::prepare(basis, guard);
  }
}

/// Rounding of forces, over all intervals that meet at this instant: if a law lets go, its large forces vanish, but
/// not their rounding.
double ExactEngine::force_rounding() const { return rounding * std::max(force_scale_, instant_scale_); }

/// Rounding of the velocity in a slip. The forces of this interval cancel in the acceleration; their rounding over
/// the fastest rate is that of the velocity.
double ExactEngine::velocity_rounding() const {
  return rounding * force_scale_ / model_.oscillator.mass / mode_->basis().fastest();
}

void ExactEngine::build_slip() {
  const Oscillator& o = model_.oscillator;
  mode_ = &mode_for(o.damping + total_->force.velocity, o.stiffness + total_->force.position);
  load_forcing(0.0);
  const core::ExponentialBasis& basis = mode_->basis();
  mode_->solve(forcing_, x_, v_, motion_);
  force_scale_ = force_scale();
  const double sign = friction::sign(direction_);
  core::Guard& guard =
      new_guard({.ending = SlipEnd{}, .by_velocity = sign, .tolerance = velocity_rounding(), .is_speed = true});
  core::differentiate(basis, motion_, guard.value);
  if (sign < 0.0) core::assign(basis, -1.0, guard.value, guard.value);
  core::differentiate(basis, guard.value, guard.slope);
  core::prepare_with_slope(basis, guard);
}

void ExactEngine::add_law_guards() {
  const core::ExponentialBasis& basis = mode_->basis();
  std::size_t next = 0;
  for (std::size_t i = 0; i < model_.friction.size(); ++i) {
    for (std::size_t j = 0; j < law_guard_counts_[i]; ++j) {
      const Affine& g = law_guards_[next++];
      core::Guard& guard = new_guard({.ending = LawGuard{i, static_cast<int>(j)},
                                      .by_position = g.position,
                                      .by_velocity = g.velocity,
                                      .tolerance = rounding * (std::abs(g.constant) + std::abs(g.position * x_) +
                                                               std::abs(g.velocity * v_) + g.cancelled)});
      if (direction_ != Direction::none) {
        Watch& watch = watches_[guard_count_ - 1];
        watch.tolerance += velocity_rounding() * (std::abs(g.velocity) + std::abs(g.position) / basis.fastest());
        watch.is_speed = g.velocity * friction::sign(direction_) > 0.0 && g.constant == 0.0 && g.rate == 0.0 &&
                         g.position == 0.0 && g.transient == 0.0;
        watch.is_position = g.position != 0.0 && g.velocity == 0.0 && g.rate == 0.0 && g.transient == 0.0;
      }
      ModeForcing own{.polynomial = {g.constant, g.rate},
                      .transients = std::vector<double>(mode_->decays().size())};
      for (std::size_t d = 0; d < mode_->decays().size(); ++d) {
        if (mode_->decays()[d] == g.decay) own.transients[d] = g.transient;
      }
      mode_->represent(own, guard.value);
      core::accumulate(basis, g.position, motion_, guard.value);
      if (direction_ != Direction::none)
        core::accumulate(basis, g.velocity * friction::sign(direction_), speed(), guard.value);
      core::prepare(basis, guard);
    }
  }
}

void ExactEngine::build_interval() {
  guard_count_ = 0;
  collect(true);
  if (direction_ == Direction::none) {
    build_stick();
  } else {
    build_slip();
  }
  add_law_guards();
}

/// The germ of the velocity in a slip that begins at v = 0. The sum of forces, known to `rounding` of its parts,
/// has decided between stick and slip. The acceleration is the same sum; within rounding it must not change the
/// decision.
core::Germ ExactEngine::slip_germ(const core::Guard& guard, double tolerance) const {
  const double push = friction::sign(direction_) * pull_now();
  const double stiffness = model_.oscillator.stiffness + total_->force.position;
  const double error = force_rounding() + std::abs(stiffness) * x_rounding_;
  if (push > 0.5 * error) return {1, 1};
  if (push < -4.0 * error) return {-1, 1};
  return core::germ(mode_->basis(), guard, tolerance, 2);
}

/// Whether a guard below zero rises above zero within the rounding of the time of the events at this instant.
bool ExactEngine::rises_in_time(const core::Guard& guard, double tolerance) const {
  const core::ExponentialBasis& basis = mode_->basis();
  const double value = core::at_start(basis, guard.value);
  const double slope = core::at_start(basis, guard.slope);
  const double late = std::min(time_rounding_, parabolic / basis.fastest());
  const double rise = late * (slope + 0.5 * late * core::at_start(basis, guard.curvature));
  return value > -clearly * core::start_amplitude(basis, guard.value) - tolerance && value + tolerance + rise > 0.0;
}

/// The germ of a function of x alone that is zero at the start of a slip: x moves in the direction of the slip. The
/// forces that start it may be within rounding, and would then not say so. The guard of the speed is the first.
core::Germ ExactEngine::position_germ(const Watch& watch) const {
  return {watch.by_position * friction::sign(direction_) > 0.0 ? 1 : -1, guards_.front().known_zeros + 1};
}

/// The guards of two modes of a law may have the same zero by different formulas with different rounding. Each
/// could then send the law to the other mode. The time of the event is known to its rounding: a guard that rises
/// through zero within that time begins at zero. A slider that lets go of a mass at rest has the speed of the mass,
/// so it cannot stop before the mass does.
core::Germ ExactEngine::start_germ(const core::Guard& guard, const Watch& watch, double tolerance) const {
  if (watch.is_speed && v_ == 0.0) return slip_germ(guard, tolerance);
  const core::Germ germ = core::germ(mode_->basis(), guard, tolerance);
  if (watch.is_position && germ.zeros > 0) return position_germ(watch);
  if (germ.sign >= 0 || germ.zeros > 0 || !rises_in_time(guard, tolerance)) return germ;
  const core::Germ from_zero = core::germ(mode_->basis(), guard, tolerance, 1);
  return from_zero.sign > 0 ? from_zero : germ;
}

/// No examined derivative says whether the speed of a slip rises: rounding would end the slip at once, or begin one
/// in the other direction, without end where a contact lets go each time. If the speed does rise later, it is taken
/// to be larger by its rounding until then, so that the slip goes on. False: it does not rise.
bool ExactEngine::lift_speed(core::Guard& guard, double tolerance) const {
  const Later later = clear_of_rounding(guard.value, tolerance);
  if (!(later.value > 0.0)) return false;
  ModeFunction rounding_of_speed;
  mode_->represent({.polynomial = {later.error}}, rounding_of_speed);
  core::accumulate(mode_->basis(), 1.0, rounding_of_speed, guard.value);
  core::prepare_with_slope(mode_->basis(), guard);
  guard.known_zeros = 0;
  return true;
}

/// Counts the zeros of each guard at the start. True if a guard is negative just after it; crossing_ has its index.
bool ExactEngine::find_violated() {
  const core::ExponentialBasis& basis = mode_->basis();
  std::size_t i = 0;
  while (i < guard_count_) {
    core::Guard& guard = guards_[i];
    const Watch& watch = watches_[i++];
    const double tolerance =
        watch.tolerance + std::abs(watch.by_position) * x_rounding_ + std::abs(watch.by_velocity) * v_rounding_;
    if (core::at_start(basis, guard.value) > clearly * core::start_amplitude(basis, guard.value) + tolerance)
      continue;
    const core::Germ germ = start_germ(guard, watch, tolerance);
    if (germ.sign < 0) {
      if (germ.zeros > 0) {
        keep_time_rounding(tolerance + std::abs(core::at_start(basis, guard.value)),
                           core::at_start(basis, guard.slope), core::at_start(basis, guard.curvature));
      }
      crossing_.found = true;
      crossing_.guard = static_cast<int>(i) - 1;
      crossing_.s = 0.0;
      basis.evaluate(0.0, crossing_.values);
      return true;
    }
    if (germ.sign == 0 && follows_at_once_ && is<SlipEnd>(watch.ending) && lift_speed(guard, tolerance)) continue;
    guard.known_zeros = std::min(germ.zeros, 3);
    if (germ.sign == 0 && direction_ == Direction::none) drop_guard(--i);
  }
  return false;
}

/// While the mass sticks, a guard that is zero to every examined order stays zero. A search would report its
/// rounding as crossings.
void ExactEngine::drop_guard(std::size_t i) {
  --guard_count_;
  std::swap(guards_[i], guards_[guard_count_]);
  std::swap(watches_[i], watches_[guard_count_]);
}

}  // namespace dualdamp::sim
