#pragma once
/// A page of results: one HTML file with its data and the scripts that draw them. It needs no network.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace dualdamp::cli {

/// Writes the page. `scripts`: the scripts that build the page; they follow those for charts and elements.
void write_page(std::ostream& out, const nlohmann::ordered_json& document, const nlohmann::ordered_json& tables,
                const std::vector<std::string_view>& scripts);

}  // namespace dualdamp::cli
