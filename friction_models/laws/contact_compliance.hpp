#pragma once
/// Contact compliance: a massless slider with Coulomb friction in series with a contact spring, and a damper in
/// parallel with the spring (Jenkins, Prandtl; elastic-perfectly-plastic). The slider is at a, the stretch of the
/// spring is u.
///
///   stuck      u = x - a, a held        f = contact_stiffness u + contact_damping v,   |f| < static      [N]
///   slipping   f = s kinetic, s = +-1
///     without damping   u = s kinetic/contact_stiffness; ends when v = 0
///     with damping      u' = q, contact_damping q = s kinetic - contact_stiffness u; ends when the slider's speed
///                       v - q is 0, not when v is
///
/// Beside a mass at rest the speed of a damped slider falls towards 0 and never reaches it: the slider creeps. It
/// counts as stopped when the spring pulls it with less than 1e-12 static beyond kinetic, that is at the speed
/// 1e-12 static/contact_damping. So the next release must overcome static friction, and for vanishing damping the
/// motion tends to that without damping.
///
/// With static > kinetic the slider jumps at break-away: the force falls to kinetic, x and v do not change. The
/// spring starts unstretched. Under force limits that vary with time or position the slip ends when the slider
/// stops, which is not the instant at which the mass stops. A step of the force limits upward halts a sliding
/// slider; it breaks away again at the kinetic limit, because static friction had no time to build up. Holds for
/// contacts whose asperities deform elastically before sliding.
///
/// Source: liang2004identifying, jenkins1962, iwan1966 in `docs/refs.bib`. Exact engine; with damping not under
/// limits that vary with position. Cost: two events a stroke.

#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class ContactCompliance {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();

  /// N, N, N/m, N.s/m; 0 <= kinetic <= static_level, 0 < stiffness, 0 <= damping.
  ContactCompliance(double kinetic, double static_level, double stiffness, double damping)
      : kinetic_(kinetic), static_(static_level), stiffness_(stiffness), damping_(damping) {}

  [[nodiscard]] Memory start(const Instant& now) const { return {.state = {now.x}}; }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction) const;
  void affine_guards(const Memory& memory, const Instant& now, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;
  void rates(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const;
  /// Heat of the slider and the damper [W].
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction) const;
  /// J in the spring.
  [[nodiscard]] double stored_energy(const Memory& memory, const Instant& now) const;
  /// Size of a: the stretch at break-away. Size of q: that of v; for a creeping slider, the speed at which it
  /// counts as stopped.
  void scales(const Memory& memory, std::span<double> scales) const;
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration, Direction) const;

 private:
  /// Modes; all but stuck are multiplied by the direction of the force, +1 or -1. Creeping: the slider of a damped
  /// contact slides beside a mass at rest. State: a when stuck or halted; q = u' when slipping with damping and
  /// when creeping, because from u the rate would be known only to the rounding of u times
  /// contact_stiffness/contact_damping; none when slipping without damping.
  enum : int { stuck = 0, slipping = 1, halted = 2, creeping = 3 };
  /// The rate q [m/s] at which the spring of a damped contact that slips is stretched, as a function of time s
  /// since the interval began: settled + relaxing exp(-decay s).
  struct Relaxation {
    double settled = 0.0;
    double relaxing = 0.0;
    double decay = 0.0;
  };

  /// The direction in which the slider slides, +1 or -1; 0 if it does not slide.
  [[nodiscard]] static int sliding_side(const Memory& memory);
  [[nodiscard]] int sliding_mode(Direction direction) const {
    return is_damped() && direction == Direction::none ? creeping : slipping;
  }
  [[nodiscard]] bool is_damped() const { return damping_ > 0.0; }
  [[nodiscard]] bool slider_stops_by_itself(const Instant& now) const;
  [[nodiscard]] Affine break_away(const Memory& memory, const Instant& now, int side) const;
  [[nodiscard]] Relaxation relaxation(const Memory& memory, const Instant& now) const;
  [[nodiscard]] Affine slider_speed(const Memory& memory, const Instant& now) const;
  [[nodiscard]] double slowest_creep(double static_level) const;
  [[nodiscard]] double stretching_at_break_away(const Memory& memory, const Instant& now, int side) const;
  void slide(Memory& memory, const Instant& now, int side, Direction direction) const;
  [[nodiscard]] double stretch(const Memory& memory, const Instant& now) const;
  void stop_slider(Memory& memory, const Instant& now, int next_mode) const;

  double kinetic_;
  double static_;
  double stiffness_;
  double damping_;
};

}  // namespace dualdamp::friction
