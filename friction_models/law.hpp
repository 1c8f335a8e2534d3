#pragma once
/// The law contract: what a friction law tells the driver, and what the driver does for it.
///
/// A law is a force, and where it has modes: guards and a jump. It is pure: it holds its parameters; what it
/// remembers (`Memory`) belongs to the driver. The driver owns the motion of the mass: position x and velocity v
/// are continuous across every event, and the direction of slip is frozen between events.
///
///   force       F(memory, now, direction) [N], F > 0 opposes v > 0; the branch of sgn v is `direction`, so the
///               formula stays smooth across the event that ends the phase.
///   guards      values that are > 0 while the law's mode holds; the mode ends when one reaches 0 from above.
///   jump        the mode change at an own guard (`trigger` = its index), when the mass reverses, stops or is
///               released (`Trigger::direction_change`), or at a time of the law's own schedule. Called again while
///               a guard is violated in the new mode. It decides by the mode and the trigger, not by values.
///
/// Sticking of the mass belongs to the driver: a law that can hold the mass at rest says by how much with
/// `static_limit`. With v = 0 the mass rests while |pull| <= the sum of the static limits, pull = all forces on
/// the mass except those of laws with a static limit; otherwise it slips in the direction of the pull. At v = 0
/// every law first sees a change of direction to rest.
///
/// A law asks the instant for its force limits, `now.limit(kinetic)`: modifiers (drift, fluctuation, a slope over
/// position) act there and stay out of the law.
///
/// Abilities are found by the compiler:
///   affine form    force, guards and limit as affine functions of time, position and velocity inside a mode: gives
///                  the exact engine (`affine_force`; `affine_limit`; `affine_guards`). A law states either this or
///                  `force`, `static_limit`, `guards`, which follow from it.
///   memory         `start`: the law remembers something. Modes: guards, `jump`.
///   static limit   the law holds the mass at rest.
///   own states     `rates`: d(state)/dt in a mode; without it states are held between events. `advance`: states at
///                  the end of a phase, in closed form, for an affine law whose states are not held. A law whose
///                  force needs those rates states both at once, `respond`. `scales`: the size of each state.
///   delay          `delay`: the law also sees the velocity that long ago, `Instant::past_velocity`.
///   dissipation    `dissipation`: power turned to heat, where that is not F v since the law stores energy.
///   schedule       `next_change`: the time at which the mode changes whatever the motion does.
///   aperiodic      `aperiodic`: why no motion under this law is periodic ("its friction is random").
///
/// Docs: `docs/decisions/002-law-contract.md` works contact compliance, Iwan and LuGre through this contract.

#include <concepts>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace dualdamp::friction {

/// Direction of slip in which a branch is frozen; none: the mass sticks.
enum class Direction : int { backward = -1, none = 0, forward = 1 };

[[nodiscard]] constexpr double sign(Direction direction) {
  return static_cast<double>(static_cast<int>(direction));
}

/// constant + rate s + position x + velocity v + transient exp(-decay s), s = time since the phase began [s].
struct Affine {
  double constant = 0.0;
  double rate = 0.0;
  double position = 0.0;
  double velocity = 0.0;
  double transient = 0.0;
  double decay = 0.0;
  double cancelled = 0.0;  ///< sum of the moduli of terms that the numbers above are small differences of, if any
};

/// Of parts without, or with the same, decay.
[[nodiscard]] constexpr Affine operator+(const Affine& a, const Affine& b) {
  return {a.constant + b.constant,  a.rate + b.rate,           a.position + b.position,
          a.velocity + b.velocity,  a.transient + b.transient, a.transient != 0.0 ? a.decay : b.decay,
          a.cancelled + b.cancelled};
}

[[nodiscard]] constexpr Affine operator*(double factor, const Affine& a) {
  return {factor * a.constant,
          factor * a.rate,
          factor * a.position,
          factor * a.velocity,
          factor * a.transient,
          a.decay,
          (factor < 0.0 ? -factor : factor) * a.cancelled};
}

[[nodiscard]] constexpr Affine operator-(const Affine& a, const Affine& b) { return a + -1.0 * b; }

/// What modifiers do to a law's force limits at one instant: limit = factor nominal + slope x, and 0 for nominal
/// limits up to `vanished`.
struct Modification {
  double factor = 1.0;
  double factor_rate = 0.0;  ///< 1/s
  double slope = 0.0;        ///< N/m, with the sign of x
  double vanished = -1.0;    ///< N; below zero: none vanishes
};

/// The mass at one instant.
struct Instant {
  double t = 0.0;  ///< s
  double x = 0.0;  ///< m
  double v = 0.0;  ///< m/s
  Modification modification{};
  double past_velocity = 0.0;  ///< velocity one `delay` of the law ago [m/s]; that of the start before it

  /// A force limit of `nominal` [N] from now on, modifiers included.
  [[nodiscard]] constexpr Affine limit(double nominal) const {
    if (nominal <= modification.vanished) return {};
    return {.constant = modification.factor * nominal,
            .rate = modification.factor_rate * nominal,
            .position = modification.slope};
  }
  /// The same now [N].
  [[nodiscard]] constexpr double limit_now(double nominal) const {
    if (nominal <= modification.vanished) return 0.0;
    return modification.factor * nominal + modification.slope * x;
  }
};

/// The value of an affine form at the instant at which its phase begins.
[[nodiscard]] constexpr double value(const Affine& a, const Instant& now) {
  return a.constant + a.position * now.x + a.velocity * now.v + a.transient;
}

/// What a law remembers: its mode and its own continuous states. The meaning is the law's.
struct Memory {
  int mode = 0;
  std::vector<int> indices{};   ///< what the mode holds beyond its number, e.g. which elements hang together
  std::vector<double> state{};  ///< enters force and guards as an affine function in every mode of an affine law

  friend bool operator==(const Memory&, const Memory&) = default;
};

/// Why `jump` is called.
struct Trigger {
  static constexpr int direction_change = -1;
  static constexpr int limit_change = -2;  ///< a modifier is about to change the force limits by a step
  static constexpr int scheduled = -3;     ///< the time of `next_change` has come
  int cause = direction_change;            ///< index into the law's guards, or one of the above
};

/// Ability: affine force in every mode.
template <class L>
concept AffineForce = requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
  { law.affine_force(memory, now, direction) } -> std::same_as<Affine>;
};
template <class L>
concept OwnForce = requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
  { law.force(memory, now, direction) } -> std::same_as<double>;
};

/// Ability: own continuous states whose rates the force contains. Fills in the rates and returns the force [N].
template <class L>
concept RespondingLaw =
    requires(const L& law, const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) {
      { law.respond(memory, now, direction, rates) } -> std::same_as<double>;
    };

/// What every law provides: a force in one of these forms.
template <class L>
concept FrictionLaw = std::copyable<L> && (AffineForce<L> || OwnForce<L> || RespondingLaw<L>);

/// Ability: modes or states of its own. Without it a law remembers nothing.
template <class L>
concept ModalLaw = requires(const L& law, const Instant& now) {
  { law.start(now) } -> std::same_as<Memory>;
};

/// Ability: mode changes.
template <class L>
concept JumpingLaw =
    requires(const L& law, Memory& memory, const Instant& now, Direction direction, Trigger trigger) {
      { law.jump(memory, trigger, now, direction) } -> std::same_as<void>;
    };

/// Ability: guards on the modes, each > 0 while the mode holds; appended to `guards`.
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

/// Ability: holds the mass at rest up to a limit [N].
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

/// Ability: affine in every mode, which gives the exact engine.
template <class L>
concept AffineLaw = AffineForce<L> && (!HoldsMass<L> || AffineLimit<L>) && (!Guards<L> || AffineGuards<L>);

/// Ability: own continuous states that move between events.
template <class L>
concept StateLaw =
    requires(const L& law, const Memory& frozen, const Instant& now, Direction direction, std::span<double> rates) {
      { law.rates(frozen, now, direction, rates) } -> std::same_as<void>;
    };

/// Ability: the size of each state in a motion that slips, > 0: what errors of it are measured against. Without it
/// states are positions, of the size of the motion.
template <class L>
concept ScaledLaw = requires(const L& law, const Memory& memory, std::span<double> scales) {
  { law.scales(memory, scales) } -> std::same_as<void>;
};

/// Ability: sees the velocity a fixed time ago. That time [s], > 0.
template <class L>
concept DelayedLaw = requires(const L& law) {
  { law.delay() } -> std::same_as<double>;
};

/// Ability: power that the law turns to heat [W]. Without it: force times velocity.
template <class L>
concept DissipatingLaw = requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
  { law.dissipation(memory, now, direction) } -> std::same_as<double>;
};

/// Ability: the states of an affine law at the end of a phase of `duration` [s].
template <class L>
concept AdvancingLaw =
    requires(const L& law, Memory& memory, const Instant& now, double duration, Direction direction) {
      { law.advance(memory, now, now, duration, direction) } -> std::same_as<void>;
    };

/// Ability: mode changes at times [s] that are known beforehand.
template <class L>
concept ScheduledLaw = requires(const L& law, const Memory& memory) {
  { law.next_change(memory) } -> std::same_as<double>;
};

/// Ability: says why no motion under this law is periodic; empty when it may be.
template <class L>
concept AperiodicLaw = requires(const L& law) {
  { law.aperiodic() } -> std::convertible_to<std::string_view>;
};

/// The contract at run time; `Law` holds one. Abilities that a law lacks do nothing.
class LawModel {
 public:
  LawModel() = default;
  LawModel(const LawModel&) = delete;
  LawModel& operator=(const LawModel&) = delete;
  virtual ~LawModel() = default;

  [[nodiscard]] virtual double force(const Memory&, const Instant&, Direction) const = 0;

  [[nodiscard]] virtual bool is_modal() const = 0;
  [[nodiscard]] virtual Memory start(const Instant&) const = 0;
  virtual void guards(const Memory&, const Instant&, Direction, std::vector<double>&) const = 0;
  virtual void jump(Memory&, Trigger, const Instant&, Direction) const = 0;

  [[nodiscard]] virtual bool holds_mass() const = 0;
  [[nodiscard]] virtual double static_limit(const Memory&, const Instant&) const = 0;

  [[nodiscard]] virtual bool is_affine() const = 0;
  [[nodiscard]] virtual Affine affine_force(const Memory&, const Instant&, Direction) const = 0;
  [[nodiscard]] virtual Affine affine_limit(const Memory&, const Instant&) const = 0;
  virtual void affine_guards(const Memory&, const Instant&, Direction, std::vector<Affine>&) const = 0;

  [[nodiscard]] virtual bool has_rates() const = 0;
  virtual void rates(const Memory&, const Instant&, Direction, std::span<double>) const = 0;
  [[nodiscard]] virtual double respond(const Memory&, const Instant&, Direction, std::span<double>) const = 0;
  virtual void scales(const Memory&, std::span<double>) const = 0;
  [[nodiscard]] virtual double delay() const = 0;
  [[nodiscard]] virtual double dissipation(const Memory&, const Instant&, Direction) const = 0;
  [[nodiscard]] virtual bool advances() const = 0;
  virtual void advance(Memory&, const Instant& begin, const Instant& end, double duration, Direction) const = 0;

  [[nodiscard]] virtual double next_change(const Memory&) const = 0;
  [[nodiscard]] virtual std::string_view aperiodic() const = 0;
};

/// Any law as a value, for choice at run time. Cheap to copy; parameters are shared and immutable.
class Law {
 public:
  // Not for Law itself: whether it is copyable must not depend on this constructor.
  template <class L>
    requires(!std::same_as<L, Law> && FrictionLaw<L>)
  explicit Law(L law) : model_(std::make_shared<const Model<L>>(std::move(law))) {}
  explicit Law(std::shared_ptr<const LawModel> model) : model_(std::move(model)) {}

  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const {
    return model_->force(memory, now, direction);
  }

  /// False: start, guards, jump and advance do nothing and need not be called.
  [[nodiscard]] bool is_modal() const { return model_->is_modal(); }
  [[nodiscard]] Memory start(const Instant& now) const { return model_->start(now); }
  void guards(const Memory& memory, const Instant& now, Direction direction, std::vector<double>& values) const {
    model_->guards(memory, now, direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
    model_->jump(memory, trigger, now, direction);
  }

  [[nodiscard]] bool holds_mass() const { return model_->holds_mass(); }
  /// 0 for a law without the ability.
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const {
    return model_->static_limit(memory, now);
  }

  [[nodiscard]] bool is_affine() const { return model_->is_affine(); }
  // The three below need is_affine().
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const {
    return model_->affine_force(memory, now, direction);
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const {
    model_->affine_guards(memory, now, direction, guards);
  }
  [[nodiscard]] Affine affine_limit(const Memory& memory, const Instant& now) const {
    return model_->affine_limit(memory, now);
  }

  /// False: rates are zero.
  [[nodiscard]] bool has_rates() const { return model_->has_rates(); }
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const {
    model_->rates(memory, now, direction, rates);
  }
  /// Fills in the rates, zero where states are held, and returns the force [N].
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const {
    return model_->respond(memory, now, direction, rates);
  }
  /// The size of each state; 0 for a position.
  void scales(const Memory& memory, std::span<double> scales) const { model_->scales(memory, scales); }
  /// s; 0: none.
  [[nodiscard]] double delay() const { return model_->delay(); }
  /// W
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const {
    return model_->dissipation(memory, now, direction);
  }

  /// False: states are held between events.
  [[nodiscard]] bool advances() const { return model_->advances(); }
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const {
    model_->advance(memory, begin, end, duration, direction);
  }

  /// s; infinite without a schedule.
  [[nodiscard]] double next_change(const Memory& memory) const { return model_->next_change(memory); }
  /// Empty: motions may be periodic.
  [[nodiscard]] std::string_view aperiodic() const { return model_->aperiodic(); }

 private:
  template <class L>
  struct Model;

  std::shared_ptr<const LawModel> model_;
};

template <class L>
struct Law::Model final : LawModel {
  explicit Model(L value) : law(std::move(value)) {}

  double force(const Memory& memory, const Instant& now, Direction direction) const override {
    if constexpr (OwnForce<L>) {
      return law.force(memory, now, direction);
    } else if constexpr (RespondingLaw<L>) {
      std::vector<double> unused(memory.state.size());
      return law.respond(memory, now, direction, unused);
    } else {
      return value(law.affine_force(memory, now, direction), now);
    }
  }

  bool is_modal() const override { return ModalLaw<L>; }
  Memory start(const Instant& now) const override {
    if constexpr (ModalLaw<L>) return law.start(now);
    return {};
  }
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const override {
    if constexpr (Guards<L>) {
      law.guards(memory, now, direction, values);
    } else if constexpr (AffineGuards<L>) {
      std::vector<Affine> forms;
      law.affine_guards(memory, now, direction, forms);
      for (const Affine& form : forms) values.push_back(value(form, now));
    }
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const override {
    if constexpr (JumpingLaw<L>) law.jump(memory, trigger, now, direction);
  }

  bool holds_mass() const override { return HoldsMass<L>; }
  double static_limit(const Memory& memory, const Instant& now) const override {
    if constexpr (StaticLimit<L>) {
      return law.static_limit(memory, now);
    } else if constexpr (AffineLimit<L>) {
      return value(law.affine_limit(memory, now), now);
    }
    return 0.0;
  }

  bool is_affine() const override { return AffineLaw<L>; }
  Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const override {
    if constexpr (AffineLaw<L>) return law.affine_force(memory, now, direction);
    return {};
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const override {
    if constexpr (AffineGuards<L>) law.affine_guards(memory, now, direction, guards);
  }
  Affine affine_limit(const Memory& memory, const Instant& now) const override {
    if constexpr (AffineLimit<L>) return law.affine_limit(memory, now);
    return {};
  }

  bool has_rates() const override { return StateLaw<L> || RespondingLaw<L>; }
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> out) const override {
    if constexpr (StateLaw<L>) {
      law.rates(memory, now, direction, out);
    } else if constexpr (RespondingLaw<L>) {
      static_cast<void>(law.respond(memory, now, direction, out));
    }
  }
  double respond(const Memory& memory, const Instant& now, Direction direction,
                 std::span<double> out) const override {
    if constexpr (RespondingLaw<L>) {
      return law.respond(memory, now, direction, out);
    } else {
      for (double& rate : out) rate = 0.0;
      rates(memory, now, direction, out);
      return force(memory, now, direction);
    }
  }
  void scales(const Memory& memory, std::span<double> out) const override {
    for (double& scale : out) scale = 0.0;
    if constexpr (ScaledLaw<L>) law.scales(memory, out);
  }
  double delay() const override {
    if constexpr (DelayedLaw<L>) return law.delay();
    return 0.0;
  }
  double dissipation(const Memory& memory, const Instant& now, Direction direction) const override {
    if constexpr (DissipatingLaw<L>) return law.dissipation(memory, now, direction);
    return force(memory, now, direction) * now.v;
  }
  bool advances() const override { return AdvancingLaw<L>; }
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const override {
    if constexpr (AdvancingLaw<L>) law.advance(memory, begin, end, duration, direction);
  }

  double next_change(const Memory& memory) const override {
    if constexpr (ScheduledLaw<L>) return law.next_change(memory);
    return std::numeric_limits<double>::infinity();
  }
  std::string_view aperiodic() const override {
    if constexpr (AperiodicLaw<L>) return law.aperiodic();
    return {};
  }

  L law;
};

}  // namespace dualdamp::friction
