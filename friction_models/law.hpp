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
///   jump        the mode change at an own guard (`trigger` = its index) or when the mass reverses, stops or is
///               released (`Trigger::direction_change`). Called again while a guard is violated in the new mode.
///
/// Sticking of the mass belongs to the driver: a law that can hold the mass at rest says by how much with
/// `static_limit`. With v = 0 the mass rests while |pull| <= the sum of the static limits, pull = all forces on
/// the mass except those of laws with a static limit; otherwise it slips in the direction of the pull.
///
/// Only the force is required. Abilities are found by the compiler:
///   modes          `start`, `guards`, `jump`: the law remembers something.
///   static limit   `static_limit`: the law holds the mass at rest.
///   affine form    force, guards and limit as affine functions of time, position and velocity inside a mode: gives
///                  the exact engine (`affine_force`; `affine_limit`; `affine_guards` and `advance`).
///   own states     `rates`: d(state)/dt of a mode, for the smooth engine.
///
/// Docs: `docs/decisions/002-law-contract.md` works contact compliance, Iwan and LuGre through this contract.

#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace dualdamp::friction {

/// Direction of slip in which a branch is frozen.
enum class Direction : int { backward = -1, rest = 0, forward = 1 };

[[nodiscard]] constexpr double sign(Direction direction) {
  return static_cast<double>(static_cast<int>(direction));
}

/// The mass at one instant.
struct Instant {
  double t = 0.0;  ///< s
  double x = 0.0;  ///< m
  double v = 0.0;  ///< m/s
};

/// What a law remembers: its mode and its own continuous states. The meaning is the law's.
struct Memory {
  int mode = 0;
  std::vector<double> state;
};

/// Why `jump` is called.
struct Trigger {
  static constexpr int direction_change = -1;
  int guard = direction_change;  ///< index into the law's guards, or direction_change
};

/// constant + rate s + position x + velocity v + transient exp(-decay s), s = time since the phase began [s].
struct Affine {
  double constant = 0.0;
  double rate = 0.0;
  double position = 0.0;
  double velocity = 0.0;
  double transient = 0.0;
  double decay = 0.0;
};

/// What every law provides.
template <class L>
concept FrictionLaw =
    std::copyable<L> && requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
      { law.force(memory, now, direction) } -> std::same_as<double>;
    };

/// Ability: modes or states of its own, with guards and a jump. Without it a law remembers nothing.
template <class L>
concept ModalLaw = requires(const L& law, const Memory& frozen, Memory& memory, const Instant& now,
                            Direction direction, Trigger trigger, std::vector<double>& values) {
  { law.start(now) } -> std::same_as<Memory>;
  { law.guards(frozen, now, direction, values) } -> std::same_as<void>;  // appends
  { law.jump(memory, trigger, now, direction) } -> std::same_as<void>;
};

/// Ability: holds the mass at rest up to a limit [N].
template <class L>
concept HoldsMass = requires(const L& law, const Memory& memory, const Instant& now) {
  { law.static_limit(memory, now) } -> std::same_as<double>;
};

/// Ability: affine in every mode. A law that holds the mass adds `affine_limit`, a modal one `affine_guards` and
/// `advance`, which brings its states from the start of a phase to its end.
template <class L>
concept AffineLaw =
    requires(const L& law, const Memory& memory, const Instant& now, Direction direction) {
      { law.affine_force(memory, now, direction) } -> std::same_as<Affine>;
    } &&
    (!HoldsMass<L> ||
     requires(const L& law, const Memory& memory, const Instant& now) {
       { law.affine_limit(memory, now) } -> std::same_as<Affine>;
     }) &&
    (!ModalLaw<L> || requires(const L& law, const Memory& frozen, Memory& memory, const Instant& now,
                              Direction direction, std::vector<Affine>& guards) {
      { law.affine_guards(frozen, now, direction, guards) } -> std::same_as<void>;  // appends
      { law.advance(memory, now, now, direction) } -> std::same_as<void>;
    });

/// Ability: own continuous states for the smooth engine.
template <class L>
concept StateLaw =
    requires(const L& law, const Memory& frozen, const Instant& now, Direction direction, std::span<double> rates) {
      { law.rates(frozen, now, direction, rates) } -> std::same_as<void>;
    };

/// Any law as a value, for choice at run time. Cheap to copy; parameters are shared and immutable.
class Law {
 public:
  // Not for Law itself: whether it is copyable must not depend on this constructor.
  template <class L>
    requires(!std::same_as<L, Law> && FrictionLaw<L>)
  explicit Law(L law) : model_(std::make_shared<const Model<L>>(std::move(law))) {}

  [[nodiscard]] Memory start(const Instant& now) const { return model_->start(now); }
  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const {
    return model_->force(memory, now, direction);
  }
  void guards(const Memory& memory, const Instant& now, Direction direction, std::vector<double>& values) const {
    model_->guards(memory, now, direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
    model_->jump(memory, trigger, now, direction);
  }

  /// False: start, guards, jump and advance do nothing and need not be called.
  [[nodiscard]] bool is_modal() const { return model_->is_modal(); }

  [[nodiscard]] bool holds_mass() const { return model_->holds_mass(); }
  /// 0 for a law without the ability.
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const {
    return model_->static_limit(memory, now);
  }

  [[nodiscard]] bool is_affine() const { return model_->is_affine(); }
  [[nodiscard]] bool has_rates() const { return model_->has_rates(); }
  // The four below need is_affine().
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
  void advance(Memory& memory, const Instant& begin, const Instant& end, Direction direction) const {
    model_->advance(memory, begin, end, direction);
  }
  /// Needs has_rates().
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const {
    model_->rates(memory, now, direction, rates);
  }

 private:
  struct Interface {
    Interface() = default;
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    virtual ~Interface() = default;
    virtual Memory start(const Instant&) const = 0;
    virtual double force(const Memory&, const Instant&, Direction) const = 0;
    virtual void guards(const Memory&, const Instant&, Direction, std::vector<double>&) const = 0;
    virtual void jump(Memory&, Trigger, const Instant&, Direction) const = 0;
    virtual bool is_modal() const = 0;
    virtual bool holds_mass() const = 0;
    virtual double static_limit(const Memory&, const Instant&) const = 0;
    virtual bool is_affine() const = 0;
    virtual bool has_rates() const = 0;
    virtual Affine affine_force(const Memory&, const Instant&, Direction) const = 0;
    virtual void affine_guards(const Memory&, const Instant&, Direction, std::vector<Affine>&) const = 0;
    virtual Affine affine_limit(const Memory&, const Instant&) const = 0;
    virtual void advance(Memory&, const Instant&, const Instant&, Direction) const = 0;
    virtual void rates(const Memory&, const Instant&, Direction, std::span<double>) const = 0;
  };

  template <class L>
  struct Model;

  std::shared_ptr<const Interface> model_;
};

template <class L>
struct Law::Model final : Law::Interface {
  explicit Model(L value) : law(std::move(value)) {}

  Memory start(const Instant& now) const override {
    if constexpr (ModalLaw<L>) return law.start(now);
    return {};
  }
  double force(const Memory& memory, const Instant& now, Direction direction) const override {
    return law.force(memory, now, direction);
  }
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const override {
    if constexpr (ModalLaw<L>) law.guards(memory, now, direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const override {
    if constexpr (ModalLaw<L>) law.jump(memory, trigger, now, direction);
  }
  bool is_modal() const override { return ModalLaw<L>; }
  bool holds_mass() const override { return HoldsMass<L>; }
  double static_limit(const Memory& memory, const Instant& now) const override {
    if constexpr (HoldsMass<L>) return law.static_limit(memory, now);
    return 0.0;
  }
  bool is_affine() const override { return AffineLaw<L>; }
  bool has_rates() const override { return StateLaw<L>; }
  Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const override {
    if constexpr (AffineLaw<L>) return law.affine_force(memory, now, direction);
    return {};
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const override {
    if constexpr (AffineLaw<L> && ModalLaw<L>) law.affine_guards(memory, now, direction, guards);
  }
  Affine affine_limit(const Memory& memory, const Instant& now) const override {
    if constexpr (AffineLaw<L> && HoldsMass<L>) return law.affine_limit(memory, now);
    return {};
  }
  void advance(Memory& memory, const Instant& begin, const Instant& end, Direction direction) const override {
    if constexpr (AffineLaw<L> && ModalLaw<L>) law.advance(memory, begin, end, direction);
  }
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> out) const override {
    if constexpr (StateLaw<L>) law.rates(memory, now, direction, out);
  }

  L law;
};

}  // namespace dualdamp::friction
