#pragma once
/// The contract of an identification method: a record in, an estimate out. A header of a method declares its
/// `MethodEntry`; `methods.cpp` lists them.

#include <span>
#include <string>
#include <string_view>

#include "identify/assumption.hpp"
#include "identify/estimate.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// What a method reads.
enum class RecordKind {
  pairs,     ///< amplitude pairs at one frequency
  states,    ///< amplitude pairs at any frequencies, with phases or without
  phases,    ///< amplitude pairs with phases, at any frequencies
  decay,     ///< extremes of a free vibration
  readings,  ///< `states` or `decay`
  history,   ///< sampled signals
};

/// "x-Y pairs", "extremes of a free vibration", ...
[[nodiscard]] std::string_view describe(RecordKind kind);
[[nodiscard]] constexpr bool reads_pairs(RecordKind kind) {
  return kind != RecordKind::decay && kind != RecordKind::history;
}

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
  std::string_view name;      ///< as users write it: files and scripts rely on it, so it never changes
  std::string_view summary;   ///< one line
  std::string_view assumes;   ///< what must hold, and how the method checks it
  std::string_view equation;  ///< plain text
  std::string_view sources;   ///< keys in docs/refs.bib
  RecordKind needs;
  /// Why this record does not hold what the method needs; empty when it does.
  std::string (*lacks)(const Record&);
  MethodCall call;
  AssumptionSet rests_on;  ///< assumptions; the estimate is wrong if one of them fails
  /// It takes seconds. Campaigns run it only if it is named, and it is not run again for the uncertainties of
  /// constants.
  bool takes_seconds = false;

  [[nodiscard]] std::span<const Option* const> options() const { return call.options; }
  [[nodiscard]] bool has(const Option& option) const;
  /// The values that belong to options of the method.
  [[nodiscard]] OptionValues own(const OptionValues& values) const;

  /// If the pairs or the constants are not sound (validate.hpp), or the record lacks something or has too few
  /// usable data, `outcome` is not ok() and has the reason. The methods themselves check the histories and extremes
  /// that they read, and leave out those that they cannot use. Values that do not belong to the method's options
  /// throw a `core::InputError`.
  [[nodiscard]] Estimate run(const Record& record, const KnownConstants& constants,
                             const OptionValues& values = {}) const;
};

/// `lacks` of the methods without further conditions: "the record holds no x-Y pairs". `lacks_resonance_pairs`
/// requires that all pairs are at one frequency.
[[nodiscard]] std::string lacks_pairs(const Record& record);
[[nodiscard]] std::string lacks_resonance_pairs(const Record& record);
[[nodiscard]] std::string lacks_decay(const Record& record);

}  // namespace dualdamp::identify
