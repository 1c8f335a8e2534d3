#pragma once
/// The law contract at run time. `LawModel` is the interface of every law: a force, and a list of its abilities.
/// Each ability is a small interface of its own; a law inherits the interfaces of its abilities and lists them in
/// `abilities()`. The caller gets the list once and then calls these interfaces.
///
/// To write a law in this tree, write a class (`law_concepts.hpp`); `LawAdapter` gives it the interfaces. Laws
/// whose abilities are known only at run time, plugins and modified laws, implement them directly.

#include <span>
#include <string_view>
#include <vector>

#include "friction_models/affine.hpp"
#include "friction_models/instant.hpp"
#include "friction_models/memory.hpp"

namespace dualdamp::friction {

class Ability {
 public:
  virtual ~Ability() = default;
};

/// The law has a memory: modes or states.
class MemoryAbility : public Ability {
 public:
  [[nodiscard]] virtual Memory start(const Instant& now) const = 0;
  /// Appends values that are > 0 while the mode holds.
  virtual void guards(const Memory& memory, const Instant& now, Direction direction,
                      std::vector<double>& values) const = 0;
  virtual void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const = 0;
};

/// Static friction: the law makes the mass stick.
class StickingAbility : public Ability {
 public:
  /// N, >= 0
  [[nodiscard]] virtual double static_limit(const Memory& memory, const Instant& now) const = 0;
};

/// Force, static force limit and guards that are affine in every mode. The limit of a law that does not make the
/// mass stick is 0; a law without guards appends none.
class AffineAbility : public Ability {
 public:
  [[nodiscard]] virtual Affine affine_force(const Memory& memory, const Instant& now,
                                            Direction direction) const = 0;
  [[nodiscard]] virtual Affine affine_limit(const Memory& memory, const Instant& now) const = 0;
  virtual void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                             std::vector<Affine>& guards) const = 0;
};

/// States that move between events.
class StateAbility : public Ability {
 public:
  /// Fills in all rates and returns the force [N].
  [[nodiscard]] virtual double respond(const Memory& memory, const Instant& now, Direction direction,
                                       std::span<double> rates) const = 0;
  /// Fills in the size of each state. `scales` is 0 before the call; a state that is left at 0 is a position.
  virtual void scales(const Memory& memory, std::span<double> scales) const = 0;
};

/// States at the end of an interval in closed form.
class AdvanceAbility : public Ability {
 public:
  virtual void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
                       Direction direction) const = 0;
};

/// A dissipation that is not force times velocity.
class DissipationAbility : public Ability {
 public:
  /// W
  [[nodiscard]] virtual double dissipation(const Memory& memory, const Instant& now, Direction direction) const = 0;
};

/// A force that depends on the velocity a fixed time ago.
class DelayAbility : public Ability {
 public:
  /// s, > 0
  [[nodiscard]] virtual double delay() const = 0;
};

/// Mode changes at times that are known in advance.
class ScheduleAbility : public Ability {
 public:
  /// s; infinite: no more.
  [[nodiscard]] virtual double next_change(const Memory& memory) const = 0;
};

/// A reason why no motion is periodic.
class AperiodicAbility : public Ability {
 public:
  /// Empty: a motion may be periodic.
  [[nodiscard]] virtual std::string_view aperiodic() const = 0;
  /// Whether its force limits grow or fall with time.
  [[nodiscard]] virtual bool drifts() const { return false; }
};

/// The abilities of a law beside its force; a null pointer where the law lacks one. The pointers live as long as
/// the law that returned them.
struct Abilities {
  const MemoryAbility* memory = nullptr;
  const StickingAbility* sticking = nullptr;
  const AffineAbility* affine = nullptr;
  const StateAbility* states = nullptr;
  const AdvanceAbility* advance = nullptr;
  const DissipationAbility* dissipation = nullptr;
  const DelayAbility* delay = nullptr;
  const ScheduleAbility* schedule = nullptr;
  const AperiodicAbility* aperiodic = nullptr;
  bool remembers_path = false;  ///< a slow motion loads the law, as it does a contact spring
};

/// The interface of every law.
class LawModel {
 public:
  LawModel() = default;
  LawModel(const LawModel&) = delete;
  LawModel& operator=(const LawModel&) = delete;
  virtual ~LawModel() = default;

  /// Friction force [N]; > 0 opposes v > 0.
  [[nodiscard]] virtual double force(const Memory& memory, const Instant& now, Direction direction) const = 0;
  /// What the law can do; every call returns the same.
  [[nodiscard]] virtual Abilities abilities() const { return {}; }
  /// Of a law from a plugin; else empty.
  [[nodiscard]] virtual std::string_view name() const { return {}; }
};

}  // namespace dualdamp::friction
