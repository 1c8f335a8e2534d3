#pragma once
/// The law contract: what a friction law provides, and what the driver does for it.
///
/// A law is a force; a law with modes also has guards and a jump. It is pure: it holds its parameters only, and its
/// memory (`memory.hpp`) belongs to the driver. The driver owns the motion of the mass: position x and velocity v
/// are continuous across every event, and the direction of slip is constant in an interval, from one event to the
/// next.
///
///   force       F(memory, now, direction) [N], F > 0 opposes v > 0. A law writes `direction` for sgn v:
///               so the formula stays smooth across the event that ends the interval.
///   guards      values that are > 0 while the law's mode holds; the mode ends when one reaches 0 from above.
///   jump        the mode change: at a guard of the law (`trigger` = its index), when the mass reverses, stops or
///               is released (`Trigger::direction_change`), or at a time of the law's own schedule. It is called
///               again while a guard is violated in the new mode, `max_repeats` times at most. It decides by the
///               mode and the trigger, not by values.
///
/// Sticking belongs to the driver. A law that can make the mass stick gives its static limit: how far its force can
/// differ from its force of direction none. That force is 0 for a law that holds the mass equally in both
/// directions. With v = 0 the mass sticks while |pull| <= the sum of the static limits, where pull is the sum of
/// all forces on the mass, those of the laws for direction none; otherwise it slips in the direction of the pull.
/// At v = 0 every law first sees a change of direction to none.
///
/// A law gets its force limits from the instant, `now.force_limit(kinetic)`. Modifiers
/// (`modifiers/modifiers.hpp`) act there; the law has no code for them.
///
/// To write a law: `law_concepts.hpp`. To run one: `Law` below. Its abilities as interfaces: `law_model.hpp`.
/// `docs/decisions/002-law-contract.md` shows contact compliance, Iwan and LuGre in this contract.

#include <algorithm>
#include <concepts>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "friction_models/law_adapter.hpp"
#include "friction_models/law_concepts.hpp"
#include "friction_models/law_model.hpp"

namespace dualdamp::friction {

/// Jumps in succession, at most: after them a mode change that did not come to an end is given up.
inline constexpr int max_repeats = 32;

/// Any law as a value, for choice at run time. Parameters are shared and immutable, so a copy is cheap. Functions
/// of an ability that the law lacks return the value stated here, without a call.
class Law {
 public:
  // Not for Law itself: whether it is copyable must not depend on this constructor.
  template <class L>
    requires(!std::same_as<L, Law> && FrictionLaw<L>)
  explicit Law(L law) : Law(std::make_shared<const LawAdapter<L>>(std::move(law))) {}
  explicit Law(std::shared_ptr<const LawModel> model) : model_(std::move(model)), abilities_(model_->abilities()) {}

  [[nodiscard]] const Abilities& abilities() const { return abilities_; }
  /// Of a law from a plugin; else empty.
  [[nodiscard]] std::string_view name() const { return model_->name(); }

  /// Friction force [N]; > 0 opposes v > 0. `direction`: of slip, in place of sgn v.
  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const {
    return model_->force(memory, now, direction);
  }

  /// The memory holds the path of the mass: a slow motion loads it, as it does a contact spring.
  [[nodiscard]] bool remembers_path() const { return abilities_.remembers_path; }
  /// False: the law remembers nothing; start, guards, jump and advance do nothing and need not be called.
  [[nodiscard]] bool has_memory() const { return abilities_.memory != nullptr; }
  [[nodiscard]] Memory start(const Instant& now) const {
    return abilities_.memory != nullptr ? abilities_.memory->start(now) : Memory{};
  }
  void guards(const Memory& memory, const Instant& now, Direction direction, std::vector<double>& values) const {
    if (abilities_.memory != nullptr) abilities_.memory->guards(memory, now, direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
    if (abilities_.memory != nullptr) abilities_.memory->jump(memory, trigger, now, direction);
  }

  /// Whether the law can make the mass stick.
  [[nodiscard]] bool holds_mass() const { return abilities_.sticking != nullptr; }
  /// How far the force can differ from that of direction none before the mass slips [N]; 0 for a law that does not
  /// hold the mass.
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const {
    return abilities_.sticking != nullptr ? abilities_.sticking->static_limit(memory, now) : 0.0;
  }

  [[nodiscard]] bool is_affine() const { return abilities_.affine != nullptr; }
  // The three below need is_affine().
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const {
    return abilities_.affine->affine_force(memory, now, direction);
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const {
    abilities_.affine->affine_guards(memory, now, direction, guards);
  }
  [[nodiscard]] Affine affine_limit(const Memory& memory, const Instant& now) const {
    return abilities_.affine->affine_limit(memory, now);
  }

  /// False: states are constant between events.
  [[nodiscard]] bool has_rates() const { return abilities_.states != nullptr; }
  /// Fills in the rates, zero for constant states, and returns the force [N].
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const {
    if (abilities_.states != nullptr) return abilities_.states->respond(memory, now, direction, rates);
    std::ranges::fill(rates, 0.0);
    return force(memory, now, direction);
  }
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const {
    static_cast<void>(respond(memory, now, direction, rates));
  }
  /// The size of each state; 0 for a position.
  void scales(const Memory& memory, std::span<double> scales) const {
    std::ranges::fill(scales, 0.0);
    if (abilities_.states != nullptr) abilities_.states->scales(memory, scales);
  }

  /// The law also depends on the velocity this long ago [s]; 0: it does not.
  [[nodiscard]] double delay() const { return abilities_.delay != nullptr ? abilities_.delay->delay() : 0.0; }

  /// Power turned to heat [W]; force times velocity, unless the law stores energy.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const {
    if (abilities_.dissipation != nullptr) return abilities_.dissipation->dissipation(memory, now, direction);
    return force(memory, now, direction) * now.v;
  }

  /// False: `advance` does nothing.
  [[nodiscard]] bool advances() const { return abilities_.advance != nullptr; }
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const {
    if (abilities_.advance != nullptr) abilities_.advance->advance(memory, begin, end, duration, direction);
  }

  /// Time of the next scheduled mode change [s]; infinite without a schedule.
  [[nodiscard]] double next_change(const Memory& memory) const {
    return abilities_.schedule != nullptr ? abilities_.schedule->next_change(memory)
                                          : std::numeric_limits<double>::infinity();
  }
  /// Why no motion is periodic; empty: a motion may be periodic.
  [[nodiscard]] std::string_view aperiodic() const {
    return abilities_.aperiodic != nullptr ? abilities_.aperiodic->aperiodic() : std::string_view{};
  }
  /// Whether its force limits grow or fall with time.
  [[nodiscard]] bool drifts() const { return abilities_.aperiodic != nullptr && abilities_.aperiodic->drifts(); }

 private:
  std::shared_ptr<const LawModel> model_;
  Abilities abilities_;
};

}  // namespace dualdamp::friction
