#include "friction_models/plugin_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <span>

#include "core/numbers.hpp"
#include "friction_models/law_fault.hpp"

namespace dualdamp::friction {

namespace {

using Table = dualdamp_law_table;

[[noreturn]] void fail(const Table& table, const std::string& what) {
  throw LawFault("law '" + std::string(table.name) + "' of a plugin: " + what);
}

/// Calls a function of the library and returns its status. The interface forbids exceptions; one becomes a
/// LawFault.
template <class Function, class... Arguments>
int status_of(const Table& table, const char* name, Function function, Arguments... arguments) {
  try {
    return function(arguments...);
  } catch (const std::exception& error) {
    fail(table, std::string(name) + "() threw an exception, which no C function may: " + error.what());
  } catch (...) {
    fail(table, std::string(name) + "() threw an exception, which no C function may");
  }
}

template <class Function, class... Arguments>
void call(const Table& table, const char* name, Function function, Arguments... arguments) {
  const int status = status_of(table, name, function, arguments...);
  if (status != DUALDAMP_OK) fail(table, std::string(name) + "() returned status " + std::to_string(status));
}

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

struct Destroyer {
  void (*destroy)(void* law);
  void operator()(void* law) const noexcept {
    try {
      destroy(law);
    } catch (...) {
      return;  // a destructor can report to nobody
    }
  }
};

/// One law of the library with its parameters. It has the abilities whose functions the table has.
class PluginLaw final : public LawModel,
                        public MemoryAbility,
                        public StickingAbility,
                        public StateAbility,
                        public DissipationAbility {
 public:
  PluginLaw(const Table& table, void* law) : table_(table), owned_(law, Destroyer{table.destroy}) {}

  [[nodiscard]] Abilities abilities() const override {
    return {.memory = table_.states > 0 || table_.jump != nullptr ? this : nullptr,
            .sticking = table_.static_limit != nullptr ? this : nullptr,
            .states = table_.states > 0 ? this : nullptr,
            .dissipation = table_.dissipation != nullptr ? this : nullptr};
  }

  [[nodiscard]] std::string_view name() const override { return table_.name; }
  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const override {
    std::array<double, max_plugin_states> rates{};
    return respond(memory, now, direction, std::span(rates).first(table_.states));
  }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const override {
    double force = 0.0;
    const dualdamp_instant instant = outside(now, direction);
    call(table_, "respond", table_.respond, law(), memory.mode, memory.state.data(), &instant, &force,
         rates.data());
    // An infinite value is no fault: the step went too far ahead and is made shorter.
    const bool is_number =
        !std::isnan(force) && std::ranges::none_of(rates, [](double r) { return std::isnan(r); });
    if (!is_number) refuse_nan("respond", memory, now);
    return force;
  }
  void scales(const Memory&, std::span<double> out) const override {
    call(table_, "scales", table_.scales, law(), out.data());
    const auto is_size = [](double scale) { return std::isfinite(scale) && scale > 0.0; };
    if (!std::ranges::all_of(out, is_size)) fail(table_, "scales() gave a size that is not above 0");
  }

  [[nodiscard]] Memory start(const Instant& now) const override {
    Memory memory{.state = std::vector<double>(table_.states)};
    if (table_.start != nullptr) {
      const dualdamp_instant instant = outside(now, Direction::none);
      call(table_, "start", table_.start, law(), &instant, &memory.mode, memory.state.data());
      check_memory("start", memory);
    }
    return memory;
  }
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const override {
    if (table_.guards == 0) return;
    std::array<double, max_plugin_guards> room{};
    const dualdamp_instant instant = outside(now, direction);
    call(table_, "guard", table_.guard, law(), memory.mode, memory.state.data(), &instant, room.data());
    const std::span<const double> own(room.data(), table_.guards);
    if (!all_finite(own)) refuse_nan("guard", memory, now);
    values.insert(values.end(), own.begin(), own.end());
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const override {
    if (table_.jump == nullptr) return;
    const dualdamp_instant instant = outside(now, direction);
    call(table_, "jump", table_.jump, law(), trigger.cause, &instant, &memory.mode, memory.state.data());
    check_memory("jump", memory);
  }

  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const override {
    double limit = 0.0;
    const dualdamp_instant instant = outside(now, Direction::none);
    call(table_, "static_limit", table_.static_limit, law(), memory.mode, memory.state.data(), &instant, &limit);
    if (!std::isfinite(limit)) refuse_nan("static_limit", memory, now);
    if (limit < 0.0) fail(table_, "static_limit() gave " + core::format_number(limit) + ", which is below 0");
    return limit;
  }

  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const override {
    double power = 0.0;
    const dualdamp_instant instant = outside(now, direction);
    call(table_, "dissipation", table_.dissipation, law(), memory.mode, memory.state.data(), &instant, &power);
    if (std::isnan(power)) refuse_nan("dissipation", memory, now);
    return power;
  }

 private:
  static dualdamp_instant outside(const Instant& now, Direction direction) {
    const Modification& m = now.modification;
    return {.t = now.t,
            .x = now.x,
            .v = now.v,
            .direction = static_cast<int>(direction),
            .limit_factor = m.factor + m.factor_slope * now.x,
            .limit_offset = m.slope * now.x,
            .limit_vanished = m.vanished};
  }

  /// A result from arguments that are not finite is not the law's fault.
  void refuse_nan(const char* function, const Memory& memory, const Instant& now) const {
    const std::array<double, 3> place = {now.t, now.x, now.v};
    if (!all_finite(memory.state) || !all_finite(place)) return;
    fail(table_, std::string(function) + "() gave a value that is no number, at t = " +
                     core::format_number(now.t, 6) + ", x = " + core::format_number(now.x, 6) +
                     " and v = " + core::format_number(now.v, 6) + " in SI units");
  }
  void check_memory(const char* function, const Memory& memory) const {
    if (memory.mode < 0 || memory.mode >= static_cast<int>(table_.modes))
      fail(table_, std::string(function) + "() went to mode " + std::to_string(memory.mode) +
                       ", but the table declares modes 0 to " + std::to_string(table_.modes - 1));
    if (!all_finite(memory.state)) fail(table_, std::string(function) + "() left a state that is no number");
  }

  [[nodiscard]] void* law() const { return owned_.get(); }

  const Table& table_;
  std::shared_ptr<void> owned_;  // destroyed even if null, which is a law too
};

}  // namespace

std::string printable(const char* text, std::size_t size) {
  std::string result(text, strnlen(text, size));
  std::ranges::replace_if(result, [](unsigned char c) { return c < 0x20 || c > 0x7E; }, '?');
  return result;
}

Created create_law(const Table& table, const ParameterValues& values) {
  std::vector<double> numbers;
  for (const dualdamp_parameter& parameter : std::span(table.parameters, table.parameter_count))
    numbers.push_back(values.number(parameter.name));
  std::array<char, max_plugin_text> message{};
  void* law = nullptr;
  const int status = status_of(table, "create", table.create, numbers.data(), &law, message.data(),
                               static_cast<unsigned>(message.size()));
  Created result{.message = printable(message.data(), message.size())};
  if (status == DUALDAMP_OK) {
    result.law = Law(std::make_shared<const PluginLaw>(table, law));
  } else if (result.message.empty()) {
    result.message = "status " + std::to_string(status) + ", without a reason";
  }
  return result;
}

}  // namespace dualdamp::friction
