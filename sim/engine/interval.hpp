#pragma once
/// An interval: the motion between two events, as a function of time.
///
/// Both engines give a stream of intervals. Sampling, extremes, energy and event lists are observers of the stream
/// (`sim/motion/observers.hpp`). Within an interval the velocity keeps one sign or the mass sticks, so
/// extremes of x lie at interval ends only.

#include <optional>
#include <string_view>

#include "friction_models/law.hpp"

namespace dualdamp::sim {

struct ClosedForm;

enum class EventKind {
  reversal,   ///< the velocity changes sign and the mass moves on
  stop,       ///< a slip ends and the mass sticks
  release,    ///< a stick ends and the mass slips
  grazing,    ///< a guard touches zero within rounding and does not cross
  switching,  ///< a law changes its mode, and the mass goes on as before
};

/// "reversal", "stop", "release", "grazing", "switching".
[[nodiscard]] std::string_view name_of(EventKind kind);

/// All quantities of the motion at one time.
struct Sample {
  double t = 0.0;         ///< s
  double y = 0.0;         ///< base position [m]; 0 for a force-driven oscillator
  double y_rate = 0.0;    ///< base velocity [m/s]
  double x = 0.0;         ///< m
  double v = 0.0;         ///< m/s
  double a = 0.0;         ///< m/s^2
  double force = 0.0;     ///< friction force on the mass, F > 0 opposing v > 0 [N]
  double external = 0.0;  ///< external force f(t) [N]
};

class Interval {
 public:
  Interval() = default;
  Interval(const Interval&) = delete;
  Interval& operator=(const Interval&) = delete;
  virtual ~Interval() = default;

  double begin = 0.0;     ///< s
  double duration = 0.0;  ///< s
  friction::Direction direction = friction::Direction::none;
  std::optional<EventKind> ending;  ///< none: the end of a period, of a drive's piece, or the horizon

  /// The motion at `begin + s`, 0 <= s <= duration.
  [[nodiscard]] virtual Sample at(double s) const = 0;
  /// x alone, in less time where the forces cost most.
  [[nodiscard]] virtual double position(double s) const { return at(s).x; }
  /// The width [s] of a panel from `begin + s` on in which a polynomial of low degree represents the motion well;
  /// it grows where fast transients have died out.
  [[nodiscard]] virtual double resolution(double s) const = 0;
  /// The motion as functions that can be integrated (`sim/engine/closed_form.hpp`), or a null pointer if the engine
  /// does not have them: then use at(). Valid as long as the interval.
  [[nodiscard]] virtual const ClosedForm* closed_form() const { return nullptr; }

  [[nodiscard]] double end() const { return begin + duration; }
  [[nodiscard]] Sample state_at(double t) const { return at(t - begin); }
};

}  // namespace dualdamp::sim
