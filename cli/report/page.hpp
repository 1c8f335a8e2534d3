#pragma once
/// A page of results: one HTML file that opens offline, with its data and the scripts that draw them.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace dualdamp::cli {

/// `scripts`: what puts the page together, behind charts and elements.
void write_page(std::ostream& out, const nlohmann::ordered_json& document, const nlohmann::ordered_json& tables,
                const std::vector<std::string_view>& scripts);

}  // namespace dualdamp::cli
