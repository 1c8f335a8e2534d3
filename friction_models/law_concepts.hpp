#pragma once
/// How to write a law: a copyable class with a force, and the member functions of its abilities. The compiler finds
/// them by the concepts below; nothing is registered and nothing is inherited. Every member is const and pure: the
/// same arguments give the same results.
///
///     class Coulomb {
///      public:
///       [[nodiscard]] Affine affine_force(const Memory&, const Instant& now, Direction direction) const;
///       [[nodiscard]] Affine affine_limit(const Memory&, const Instant& now) const;
///     };
///
/// A law has either the affine members (affine_force, affine_limit, affine_guards) or the plain ones (force,
/// static_limit, guards). The plain values of an affine law follow from its affine members.

#include <concepts>
#include <span>
#include <string_view>
#include <vector>

#include "friction_models/affine.hpp"
#include "friction_models/instant.hpp"
#include "friction_models/memory.hpp"

namespace dualdamp::friction {

/// A force that is affine in every mode [N].
template <class L>
concept AffineForce = requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
  { law.affine_force(memory, now, direction) } -> std::same_as<Affine>;
};
/// A force of any other kind [N].
template <class L>
concept OwnForce = requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
  { law.force(memory, now, direction) } -> std::same_as<double>;
};
/// A force that contains the rates of the law's own states. Fills in the rates [unit of the state per s] and
/// returns the force [N].
template <class L>
concept RespondingLaw =
    requires(const L& law, const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) {
      { law.respond(memory, now, direction, rates) } -> std::same_as<double>;
    };

/// What every law provides: a force in one of these forms.
template <class L>
concept FrictionLaw = std::copyable<L> && (AffineForce<L> || OwnForce<L> || RespondingLaw<L>);

/// Has a memory of modes or states. Returns the memory at the start.
template <class L>
concept LawWithMemory = requires(const L& law, const Instant& now) {
  { law.start(now) } -> std::same_as<Memory>;
};

/// Changes its mode. `trigger` is the reason. It decides by mode, trigger and direction, not by values.
template <class L>
concept JumpingLaw =
    requires(const L& law, Memory& memory, const Instant& now, Direction direction, Trigger trigger) {
      { law.jump(memory, trigger, now, direction) } -> std::same_as<void>;
    };

/// Has guards, each > 0 while the mode holds. Appends them.
template <class L>
concept AffineGuards = requires(const L& law, const Memory& memory, const Instant& now, Direction direction,
                                std::vector<Affine>& guards) {
  { law.affine_guards(memory, now, direction, guards) } -> std::same_as<void>;
};
template <class L>
concept Guards = requires(const L& law, const Memory& memory, const Instant& now, Direction direction,
                          std::vector<double>& values) {
  { law.guards(memory, now, direction, values) } -> std::same_as<void>;
};

/// Makes the mass stick. Returns the static limit [N]: how far its force can differ from that of direction none.
template <class L>
concept AffineLimit = requires(const L& law, const Memory& memory, const Instant& now) {
  { law.affine_limit(memory, now) } -> std::same_as<Affine>;
};
template <class L>
concept StaticLimit = requires(const L& law, const Memory& memory, const Instant& now) {
  { law.static_limit(memory, now) } -> std::same_as<double>;
};
template <class L>
concept HoldsMass = AffineLimit<L> || StaticLimit<L>;

/// Affine in every mode: the exact engine can run it.
template <class L>
concept AffineLaw = AffineForce<L> && (!HoldsMass<L> || AffineLimit<L>) && (!Guards<L> || AffineGuards<L>);

/// Has states that move between events. Fills in their rates [unit of the state per s].
template <class L>
concept StateLaw =
    requires(const L& law, const Memory& frozen, const Instant& now, Direction direction, std::span<double> rates) {
      { law.rates(frozen, now, direction, rates) } -> std::same_as<void>;
    };

/// Gives the size of each moving state in a motion that slips, > 0; local errors are relative to it. A state whose
/// size is left at 0 is a position and has the size of the motion; a velocity has `size_of_velocity`
/// (state_sizes.hpp).
template <class L>
concept ScaledLaw = requires(const L& law, const Memory& memory, std::span<double> scales) {
  { law.scales(memory, scales) } -> std::same_as<void>;
};

/// Has a memory that a slow motion loads: of the path of the mass, as a contact spring has, not of times or speeds.
template <class L>
concept PathMemory = LawWithMemory<L> && requires { requires L::remembers_path; };

/// Depends on the velocity a fixed time ago. Returns this time [s], > 0.
template <class L>
concept DelayedLaw = requires(const L& law) {
  { law.delay() } -> std::same_as<double>;
};

/// Stores energy. Returns the power that it turns to heat [W], which is then not force times velocity.
template <class L>
concept DissipatingLaw = requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
  { law.dissipation(memory, now, direction) } -> std::same_as<double>;
};

/// Is affine and has states that move. Moves them to the end of an interval of `duration` [s].
template <class L>
concept AdvancingLaw =
    requires(const L& law, Memory& memory, const Instant& now, double duration, Direction direction) {
      { law.advance(memory, now, now, duration, direction) } -> std::same_as<void>;
    };

/// Changes its mode at times that are known in advance. Returns the next time [s].
template <class L>
concept ScheduledLaw = requires(const L& law, const Memory& memory) {
  { law.next_change(memory) } -> std::same_as<double>;
};

/// Returns the reason why no motion under this law is periodic; empty when a motion may be periodic.
template <class L>
concept AperiodicLaw = requires(const L& law) {
  { law.aperiodic() } -> std::convertible_to<std::string_view>;
};

}  // namespace dualdamp::friction
