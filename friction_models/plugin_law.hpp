#pragma once
/// A law of a plugin: wraps the functions of its table in the law contract. The law has the abilities whose
/// functions the table has. A breach of the interface (an exception, NaN, a mode that is not declared, a status
/// other than 0) becomes a LawFault that names the law and the function.

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

/// The result of create() for values in range.
struct Created {
  std::optional<Law> law;  ///< none: create() refused the values
  std::string message;     ///< the reason of the refusal, or a warning
};

/// `table`, checked, must outlive the law; `values` complete.
[[nodiscard]] Created create_law(const dualdamp_law_table& table, const ParameterValues& values);

/// A text of a library, at most `size` characters, with every character that is not printable ASCII replaced.
[[nodiscard]] std::string printable(const char* text, std::size_t size);

}  // namespace dualdamp::friction
