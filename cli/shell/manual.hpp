#pragma once
/// The manual page dualdamp(1).

#include <string>

#include "cli/shell/command_table.hpp"

namespace dualdamp::cli {

/// The text of the page, in troff with the macros of man(7).
[[nodiscard]] std::string manual_page(const CommandTable& table);

}  // namespace dualdamp::cli
