#pragma once
/// Contact compliance: a massless slider with Coulomb friction in series with a contact spring, and a damper in
/// parallel with the spring (Jenkins, Prandtl; elastic-perfectly-plastic). The slider is at a, the stretch of the
/// spring is u.
///
///   stuck      u = x - a, a held        f = contact_stiffness u + contact_damping v,   |f| < static      [N]
///   slipping   f = s kinetic, s = +-1
///     without damping   u = s kinetic/contact_stiffness; ends when v = 0
///     with damping      u' = (s kinetic - contact_stiffness u)/contact_damping; ends when the slider's speed
///                       v - u' is 0, not when v is
///
/// With static > kinetic the slider jumps at break-away: the force falls to kinetic, x and v do not change. The
/// spring starts unstretched. Under force limits that vary with time or position the slip ends when the slider
/// stops, which is not the instant at which the mass stops. A step of the force limits upward halts a slider that
/// slides; it breaks away again at the kinetic limit, because no time has passed in which static friction could
/// build up. Holds for contacts whose asperities deform elastically before sliding.
///
/// Source: liang2004identifying, jenkins1962 in `docs/refs.bib`. Exact engine; with damping not under
/// limits that vary with position. Cost: two events a stroke.

#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class ContactCompliance {
 public:
  static const std::vector<Parameter>& parameters();

  /// N, N, N/m, N.s/m; 0 <= kinetic <= static_level, 0 < stiffness, 0 <= damping.
  ContactCompliance(double kinetic, double static_level, double stiffness, double damping)
      : kinetic_(kinetic), static_(static_level), stiffness_(stiffness), damping_(damping) {}

  [[nodiscard]] Memory start(const Instant& now) const { return {.state = {now.x}}; }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction) const;
  void affine_guards(const Memory& memory, const Instant& now, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;
  void rates(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const;
  /// Of the slider and the damper.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction) const;
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration, Direction) const;

 private:
  /// Modes; slipping and halted are multiplied by the direction of the force, +1 or -1. State: a when stuck or
  /// halted; u when slipping with damping; none when slipping without.
  enum : int { stuck = 0, slipping = 1, halted = 2 };
  /// The stretch of the spring of a damped contact that slips, as a function of time s since the interval began:
  /// settled + rate s + relaxing exp(-decay s).
  struct Relaxation {
    double settled = 0.0;
    double rate = 0.0;
    double relaxing = 0.0;
    double decay = 0.0;
  };

  [[nodiscard]] bool is_damped() const { return damping_ > 0.0; }
  [[nodiscard]] bool slider_stops_by_itself(const Instant& now) const;
  [[nodiscard]] Affine break_away(const Memory& memory, const Instant& now, int side) const;
  [[nodiscard]] Relaxation relaxation(const Memory& memory, const Instant& now) const;
  [[nodiscard]] Affine slider_speed(const Memory& memory, const Instant& now) const;
  void slide(Memory& memory, const Instant& now, int side) const;
  void stop_slider(Memory& memory, const Instant& now, int next_mode) const;

  double kinetic_;
  double static_;
  double stiffness_;
  double damping_;
};

}  // namespace dualdamp::friction
