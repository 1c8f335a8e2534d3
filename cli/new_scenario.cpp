#include "cli/new_scenario.hpp"

#include <algorithm>

#include "bench/analyses.hpp"
#include "scenarios/commented.hpp"
#include "scenarios/format/tree.hpp"

namespace dualdamp::cli {

namespace {

bool asks_for(std::string_view text, const std::string& analysis) {
  const scenarios::Document document("template", std::string(text));
  const scenarios::Entry* section = document.root().find("analysis");
  const scenarios::Entry* type = section == nullptr ? nullptr : section->value.find("type");
  return type != nullptr && type->value.text == analysis;
}

}  // namespace

Listing new_scenario(const std::string& analysis) {
  const auto text =
      std::ranges::find_if(templates(), [&](std::string_view file) { return asks_for(file, analysis); });
  if (text == templates().end()) return {list_analyses(analysis).text, false};
  return {
      "# yaml-language-server: $schema=scenario.schema.json\n"
      "# An editor knows the keys once `dualdamp schema > scenario.schema.json` has run beside this file.\n"
      "# Check: dualdamp check FILE. Run: dualdamp run FILE. Lines of which only the comment is left may be "
      "added.\n" +
      scenarios::commented(std::string(*text), bench::analyses())};
}

}  // namespace dualdamp::cli
