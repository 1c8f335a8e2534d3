#include "sim/motion/free_decay.hpp"

#include <algorithm>

#include "sim/engine/engine.hpp"
#include "sim/motion/lasting_stick.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

namespace {

using friction::Direction;

/// Follows one motion from extreme to extreme.
class Decay {
 public:
  Decay(const Model& model, int count)
      : model_(valid_free(model, "free_decay")),
        count_(static_cast<std::size_t>(std::max(count, 0))),
        engine_(make_engine(model_)),
        period_(natural_period(model_.oscillator)) {
    if (engine_->velocity() == 0.0) decay_.extremes.push_back({0.0, engine_->position()});
  }

  FreeDecay run() {
    while (wants_more() && (is_held() ? follow_stick() : follow_slip())) {
    }
    decay_.outcome = engine_->outcome();
    decay_.accuracy = engine_->accuracy();
    decay_.work = engine_->work();
    return std::move(decay_);
  }

 private:
  [[nodiscard]] bool is_held() const { return engine_->direction() == Direction::none; }
  [[nodiscard]] bool is_complete() const { return decay_.extremes.size() >= count_; }
  /// Whether the last extreme is an extreme shows only when the mass is released.
  [[nodiscard]] bool wants_more() const { return !is_complete() || stopped_ != Direction::none; }

  /// A motion that creeps without reversals (strong damping, friction that never quite holds the mass) has no
  /// further extreme. If damping is so close to critical that a swing lasts a hundred natural periods, the swing
  /// ends at exp(-628) of its start.
  bool follow_slip() {
    decay_.came_to_rest = rests_for_good(model_, *engine_, 0.0);
    if (decay_.came_to_rest) return false;
    const Interval* interval = engine_->next(since_ + FreeDecay::patience * period_);
    if (interval == nullptr) {
      const bool moves = engine_->velocity() != 0.0;
      decay_.creeps = engine_->outcome().ok() && moves;
      decay_.pauses = engine_->outcome().ok() && !moves;
      return false;
    }
    if (interval->ending == EventKind::reversal || interval->ending == EventKind::stop) {
      since_ = interval->end();
      decay_.extremes.push_back({since_, engine_->position()});
      if (interval->ending == EventKind::stop) stopped_ = interval->direction;
    }
    return true;
  }

  /// Looks at once whether the mass never moves again, and after 1, 2, 4, ... natural periods of the stick.
  bool follow_stick() {
    const double last = FreeDecay::patience * period_;
    for (double look = 0.0;; look = std::min(std::max(period_, 2.0 * look), last)) {
      while (const Interval* interval = engine_->next(since_ + look)) {
        if (is_held()) continue;
        since_ = interval->end();
        if (stopped_ != Direction::none && engine_->direction() == stopped_) decay_.extremes.pop_back();
        stopped_ = Direction::none;
        return true;
      }
      if (!engine_->outcome().ok()) return false;
      const bool lasts = rests_for_good(model_, *engine_, look);
      if (!lasts && look < last) continue;
      decay_.came_to_rest = lasts && !is_complete();
      decay_.pauses = !lasts && !is_complete();
      return false;
    }
  }

  const Model& model_;
  std::size_t count_;
  std::unique_ptr<Engine> engine_;
  double period_;  ///< natural period [s]
  FreeDecay decay_;
  double since_ = 0.0;  ///< the last reversal, stop or release [s]
  /// While the mass is held: the direction in which it stopped; none if it has not moved yet.
  Direction stopped_ = Direction::none;
};

}  // namespace

FreeDecay free_decay(const Model& model, int count) { return Decay(model, count).run(); }

}  // namespace dualdamp::sim
