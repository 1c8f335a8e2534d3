#pragma once
/// A law of a plugin: the functions of its table as a law of the contract, with the abilities whose functions the
/// table has. What the interface forbids (an exception, NaN, a mode that is not declared, a status other than 0)
/// becomes a LawFault that names the law and the function.

#include <cstddef>
#include <optional>
#include <string>

#include "friction_models/dualdamp_law.h"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

inline constexpr std::size_t max_plugin_states = 64;
inline constexpr std::size_t max_plugin_guards = 16;
inline constexpr std::size_t max_plugin_text = 1000;

/// What create() answers to values in range.
struct Created {
  std::optional<Law> law;  ///< none: it refuses the values
  std::string message;     ///< why, or what it warns of
};

/// `table`, checked, must outlive the law; `values` complete.
[[nodiscard]] Created create_law(const dualdamp_law_table& table, const ParameterValues& values);

/// A text of a library, at most `size` characters, with every character that is not printable ASCII replaced.
[[nodiscard]] std::string printable(const char* text, std::size_t size);

}  // namespace dualdamp::friction
