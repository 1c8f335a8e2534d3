#pragma once
/// The host does for one law what an engine does for all laws; the mass moves along a given path. A law with a
/// delay gets the past velocity of the path; before the start, the initial velocity. A copy of the host is
/// independent, so that a step can be tried.

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "friction_models/law.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

/// The motion of the mass at a time. For a law with a delay the host keeps it, so the function must own its data.
using Path = std::function<friction::Instant(double t)>;

class LawHost {
 public:
  LawHost(const friction::Law& law, const friction::Instant& start);

  [[nodiscard]] const friction::Law& law() const { return law_; }
  [[nodiscard]] const friction::Memory& memory() const { return place_.memory; }
  [[nodiscard]] const friction::Instant& now() const { return place_.now; }
  [[nodiscard]] friction::Direction direction() const { return direction_; }
  [[nodiscard]] double force() const { return law_.force(place_.memory, place_.now, direction_); }
  [[nodiscard]] std::vector<double> guards() const;
  /// Number of mode changes at the law's own guards and times.
  [[nodiscard]] int events() const { return events_; }
  /// The instant of the last of them.
  [[nodiscard]] const friction::Instant& last_event() const { return last_event_; }
  /// Work against the law since the start [J]. Affine law: by the trapezoidal rule, which is exact if the force is
  /// affine in the position between events. Other law: integrated with the states.
  [[nodiscard]] double work() const { return place_.work; }
  /// The part of the work that became heat, as a law that is not affine states it [J].
  [[nodiscard]] double heat() const { return place_.heat; }
  /// Leaves work and heat of a law that is not affine at zero: without them a motion takes less time.
  void leave_out_energy() { has_energy_ = false; }
  /// Relative error of the states of each step; 1e-12 by default.
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }
  /// Faults of the law, in the order of the motion. If broken(), the motion cannot go on.
  [[nodiscard]] const std::vector<std::string>& faults() const { return place_.faults; }
  [[nodiscard]] bool broken() const { return place_.broken; }

  /// Steps of integration so far, and their largest number: beyond it the motion is broken.
  [[nodiscard]] long steps() const { return steps_; }
  void limit_steps(long most) { most_steps_ = most; }

  /// The mass stops and then moves in this direction, or sticks (none).
  void change_direction(friction::Direction direction);
  /// Moves the mass to time `end`, through the events of the law. The path must keep the present direction.
  void move_along(double end, const Path& path);
  /// The speed of the mass changes at once, as by a blow.
  void set_speed(double v) { place_.now.v = v; }
  /// Moves the mass to x at constant speed, in unit time.
  void move_to(double x);
  /// Advances the states from now to `end`; there must be no event between.
  void go(double end, const Path& path);

 private:
  struct Stroke {
    double begin = 0.0;
    Path path;
  };

  /// Where the motion is: what a step that is only tried must not change.
  struct Place {
    friction::Memory memory;
    friction::Instant now;
    double guard_size = 0.0;
    double work = 0.0;
    double heat = 0.0;
    std::vector<std::string> faults;
    bool broken = false;
  };

  /// The explicit stepper: each host has its own, because one in use cannot be shared.
  struct OwnStepper {
    OwnStepper() = default;
    OwnStepper(const OwnStepper& /*other*/) {}
    OwnStepper(OwnStepper&&) = default;
    OwnStepper& operator=(const OwnStepper& /*other*/) { return *this; }
    OwnStepper& operator=(OwnStepper&&) = default;
    ~OwnStepper() = default;
    std::unique_ptr<Stepper> stepper;
  };

  [[nodiscard]] Path with_past(const Path& path);
  void integrate(double end, const Path& path);
  [[nodiscard]] int worst_guard();
  [[nodiscard]] double depth_now();
  [[nodiscard]] double time_of_violation(double end, double depth, const Path& path);
  void go_to_violation(double end, const Path& path);
  void settle();
  void give_up(const std::string& fault);

  friction::Law law_;
  Place place_;
  double first_velocity_ = 0.0;
  std::vector<Stroke> strokes_;  ///< so far, for a law with a delay
  friction::Direction direction_ = friction::Direction::none;
  double tolerance_ = 1e-12;
  bool has_energy_ = true;
  OwnStepper explicit_;
  std::vector<double> guards_;
  int events_ = 0;
  long steps_ = 0;
  long most_steps_ = std::numeric_limits<long>::max();
  friction::Instant last_event_;
};

}  // namespace dualdamp::sim
