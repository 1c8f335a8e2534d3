#pragma once
/// Tells early that a motion will have more events than a history may hold, so that a hopeless one is not followed
/// up to there.
///
/// Laws that count the way (`bristle`, a fluctuation over position) have equally many events on each piece of it.
/// So the number of events to come is at least their density, seen so far, times a lower bound of the way to come:
///
/// free       from x to the zone in which friction can hold the mass: |x| less some friction over k
/// ramp       from here to that zone at the end of the ramp
/// harmonic   2 X in each half period, where |k + i w c - m w^2| <= k + |c| w + m w^2 gives
///            X >= (drive - friction)/(k + |c| w + m w^2)
///
/// No forecast is made where the spring is not linear, under other drives, or where the density changes.

#include <array>

#include "sim/engine/interval.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

class EventForecast {
 public:
  EventForecast(const Model& model, double duration, long most_events);

  /// An event: the motion there. `count`: of the events so far.
  void observe(const Sample& now, long count);
  /// Whether the motion will certainly have more than the most events; examined at few events only.
  [[nodiscard]] bool is_hopeless() const { return hopeless_; }

 private:
  [[nodiscard]] double way_left(const Sample& now) const;
  void examine(const Sample& now, long count);

  /// The end of a part of the motion.
  struct Mark {
    double way = 0.0;
    long count = 0;
  };

  Oscillator rig_;
  Excitation drive_;
  double duration_;
  double most_;
  bool possible_;
  bool hopeless_ = false;
  long next_;
  double x_ = 0.0;         ///< at the event before [m]
  double way_ = 0.0;       ///< so far [m]
  double friction_ = 0.0;  ///< the largest so far [N]
  std::array<Mark, 2> marks_{};
};

}  // namespace dualdamp::sim
