#pragma once
/// Gives a class that is written as a law (`law_concepts.hpp`) the interfaces of its abilities (`law_model.hpp`),
/// and no others. The compiler decides which. Cost: one virtual call for each call of a function.

#include <algorithm>
#include <concepts>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "friction_models/law_concepts.hpp"
#include "friction_models/law_model.hpp"

namespace dualdamp::friction {

template <FrictionLaw L>
class LawAdapter;

namespace adapters {

/// The law of type L inside the adapter that inherits `part`.
template <class L, class Part>
[[nodiscard]] const L& law_of(const Part& part) {
  return static_cast<const LawAdapter<L>&>(part).law();
}

template <class L>
class Remembering : public MemoryAbility {
 public:
  Memory start(const Instant& now) const final { return law_of<L>(*this).start(now); }
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const final {
    if constexpr (Guards<L>) {
      law_of<L>(*this).guards(memory, now, direction, values);
    } else if constexpr (AffineGuards<L>) {
      std::vector<Affine> forms;
      law_of<L>(*this).affine_guards(memory, now, direction, forms);
      for (const Affine& form : forms) values.push_back(value(form, now));
    }
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const final {
    if constexpr (JumpingLaw<L>) law_of<L>(*this).jump(memory, trigger, now, direction);
  }
};

template <class L>
class Sticking : public StickingAbility {
 public:
  double static_limit(const Memory& memory, const Instant& now) const final {
    if constexpr (StaticLimit<L>) {
      return law_of<L>(*this).static_limit(memory, now);
    } else {
      return value(law_of<L>(*this).affine_limit(memory, now), now);
    }
  }
};

template <class L>
class AllAffine : public AffineAbility {
 public:
  Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const final {
    return law_of<L>(*this).affine_force(memory, now, direction);
  }
  Affine affine_limit(const Memory& memory, const Instant& now) const final {
    if constexpr (AffineLimit<L>) return law_of<L>(*this).affine_limit(memory, now);
    return {};
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const final {
    if constexpr (AffineGuards<L>) law_of<L>(*this).affine_guards(memory, now, direction, guards);
  }
};

template <class L>
class States : public StateAbility {
 public:
  double respond(const Memory& memory, const Instant& now, Direction direction,
                 std::span<double> rates) const final {
    if constexpr (RespondingLaw<L>) {
      return law_of<L>(*this).respond(memory, now, direction, rates);
    } else {
      std::ranges::fill(rates, 0.0);
      law_of<L>(*this).rates(memory, now, direction, rates);
      return static_cast<const LawAdapter<L>&>(*this).force(memory, now, direction);
    }
  }
  void scales(const Memory& memory, std::span<double> scales) const final {
    if constexpr (ScaledLaw<L>) law_of<L>(*this).scales(memory, scales);
  }
};

template <class L>
class Advance : public AdvanceAbility {
 public:
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const final {
    law_of<L>(*this).advance(memory, begin, end, duration, direction);
  }
};

template <class L>
class Dissipation : public DissipationAbility {
 public:
  double dissipation(const Memory& memory, const Instant& now, Direction direction) const final {
    return law_of<L>(*this).dissipation(memory, now, direction);
  }
};

template <class L>
class Delay : public DelayAbility {
 public:
  double delay() const final { return law_of<L>(*this).delay(); }
};

template <class L>
class Schedule : public ScheduleAbility {
 public:
  double next_change(const Memory& memory) const final { return law_of<L>(*this).next_change(memory); }
};

template <class L>
class Aperiodic : public AperiodicAbility {
 public:
  std::string_view aperiodic() const final { return law_of<L>(*this).aperiodic(); }
};

/// In place of a base class that the law does not need.
template <class Base>
class Without {};

template <bool has, class Base>
using If = std::conditional_t<has, Base, Without<Base>>;

}  // namespace adapters

template <FrictionLaw L>
class LawAdapter final : public LawModel,
                         public adapters::If<LawWithMemory<L>, adapters::Remembering<L>>,
                         public adapters::If<HoldsMass<L>, adapters::Sticking<L>>,
                         public adapters::If<AffineLaw<L>, adapters::AllAffine<L>>,
                         public adapters::If<StateLaw<L> || RespondingLaw<L>, adapters::States<L>>,
                         public adapters::If<AdvancingLaw<L>, adapters::Advance<L>>,
                         public adapters::If<DissipatingLaw<L>, adapters::Dissipation<L>>,
                         public adapters::If<DelayedLaw<L>, adapters::Delay<L>>,
                         public adapters::If<ScheduledLaw<L>, adapters::Schedule<L>>,
                         public adapters::If<AperiodicLaw<L>, adapters::Aperiodic<L>> {
 public:
  explicit LawAdapter(L law) : law_(std::move(law)) {}

  [[nodiscard]] const L& law() const { return law_; }

  double force(const Memory& memory, const Instant& now, Direction direction) const override {
    if constexpr (OwnForce<L>) {
      return law_.force(memory, now, direction);
    } else if constexpr (RespondingLaw<L>) {
      std::vector<double> unused(memory.state.size());
      return law_.respond(memory, now, direction, unused);
    } else {
      return value(law_.affine_force(memory, now, direction), now);
    }
  }

  Abilities abilities() const override {
    return {.memory = as<MemoryAbility>(),
            .sticking = as<StickingAbility>(),
            .affine = as<AffineAbility>(),
            .states = as<StateAbility>(),
            .advance = as<AdvanceAbility>(),
            .dissipation = as<DissipationAbility>(),
            .delay = as<DelayAbility>(),
            .schedule = as<ScheduleAbility>(),
            .aperiodic = as<AperiodicAbility>(),
            .remembers_path = PathMemory<L>};
  }

 private:
  template <class Ability>
  [[nodiscard]] const Ability* as() const {
    if constexpr (std::derived_from<LawAdapter, Ability>) return this;
    return nullptr;
  }

  L law_;
};

}  // namespace dualdamp::friction
