#pragma once
/// The contract of an identification method: a record in, an estimate out. A header of a method defines its
/// `MethodEntry`; `methods.cpp` lists them.

#include <span>
#include <string>
#include <string_view>

#include "identify/assumption.hpp"
#include "identify/estimate.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// What a method works on.
enum class RecordKind {
  pairs,    ///< amplitude pairs at one frequency
  states,   ///< amplitude pairs with phases, or at several frequencies
  decay,    ///< extremes of a free vibration
  history,  ///< sampled signals
};

/// "x-Y pairs", "extremes of a free vibration", ...
[[nodiscard]] std::string_view describe(RecordKind kind);

/// The options that a method declares, and how it is run.
struct MethodCall {
  std::span<const Option* const> options;
  Estimate (*run)(const Record&, const KnownConstants&, const OptionValues&) = nullptr;
};

template <auto method>
struct CallOf;

template <class Options, Estimate (*method)(const Record&, const KnownConstants&, const Options&)>
struct CallOf<method> {
  static Estimate run(const Record& record, const KnownConstants& constants, const OptionValues& values) {
    return method(record, constants, taken_from<Options>(values));
  }
  static constexpr MethodCall value{declarations_of<Options>, run};
};

template <Estimate (*method)(const Record&, const KnownConstants&)>
struct CallOf<method> {
  static Estimate run(const Record& record, const KnownConstants& constants, const OptionValues& /*none*/) {
    return method(record, constants);
  }
  static constexpr MethodCall value{{}, run};
};

/// The call of a method: a function of a record, constants and, where it has options, the struct of their values.
template <auto method>
inline constexpr MethodCall call_of = CallOf<method>::value;

struct MethodEntry {
  std::string_view name;      ///< contract
  std::string_view summary;   ///< one line
  std::string_view assumes;   ///< what must hold, and how the method checks it
  std::string_view equation;  ///< plain text
  std::string_view sources;   ///< keys in docs/refs.bib
  RecordKind needs;
  /// Why this record does not hold what the method needs; empty when it does.
  std::string (*lacks)(const Record&);
  MethodCall call;
  AssumptionSet rests_on;  ///< what a departure from makes the estimate wrong
  /// It takes seconds: campaigns run it where it is named only, and uncertainties of constants are not found by
  /// running it again.
  bool takes_seconds = false;

  [[nodiscard]] std::span<const Option* const> options() const { return call.options; }
  [[nodiscard]] bool has(const Option& option) const;
  /// Those of the values that are of the method's options.
  [[nodiscard]] OptionValues own(const OptionValues& values) const;

  /// A record or constants that are not sound (validate.hpp), a record that lacks something or has not enough
  /// usable data: `outcome` not ok() with the reason. Values that are not those of the method's options throw a
  /// `core::InputError`.
  [[nodiscard]] Estimate run(const Record& record, const KnownConstants& constants,
                             const OptionValues& values = {}) const;
};

/// `lacks` of the methods that ask for no more: "the record holds no x-Y pairs". `lacks_resonance_pairs` wants them
/// all at one frequency.
[[nodiscard]] std::string lacks_pairs(const Record& record);
[[nodiscard]] std::string lacks_resonance_pairs(const Record& record);
[[nodiscard]] std::string lacks_decay(const Record& record);

}  // namespace dualdamp::identify
