#pragma once
/// The manual page dualdamp(1).

#include <string>

#include "cli/command_table.hpp"

namespace dualdamp::cli {

/// In the language of troff with the macros man(7).
[[nodiscard]] std::string manual_page(const CommandTable& table);

}  // namespace dualdamp::cli
