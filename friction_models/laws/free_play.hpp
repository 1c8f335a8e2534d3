#pragma once
/// Coulomb friction behind free play: the mass carries a friction element along, but only after it has crossed the
/// play between two stops of the element.
///
///   free      |x - a| < play/2                  F = 0                                            [N]
///   pushing   x = a + s play/2, s = +-1         F = s kinetic while slipping in direction s
///             at v = 0 the mass sticks while 0 <= s pull <= static
///
/// a is the position of the element, which has no mass and moves with the mass while it is pushed. At a reversal
/// the mass leaves the stop under a pull of any size and crosses the play without friction. The element starts in
/// the middle of its play. For play -> 0 the law is `coulomb`.
///
/// Holds for backlash in a coupling to a damper, a seal in a wide groove, a worn pin. Loop of amplitude A > play/2:
/// work 4 kinetic (A - play/2). Source: tao1996 in `docs/refs.bib`. Exact engine. Cost: two events a stroke.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class FreePlay {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();

  /// N, N, m; 0 <= kinetic <= static_level, 0 < play.
  FreePlay(double kinetic, double static_level, double play)
      : kinetic_(kinetic), static_(static_level), half_(0.5 * play) {}

  [[nodiscard]] Memory start(const Instant& now) const { return {.state = {now.x}}; }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const;
  [[nodiscard]] Affine affine_limit(const Memory& memory, const Instant& now) const;
  void affine_guards(const Memory& memory, const Instant&, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;

 private:
  // Mode: 0 free, with a as the state; s pushing in direction s, without a state.
  double kinetic_;
  double static_;
  double half_;
};

}  // namespace dualdamp::friction
