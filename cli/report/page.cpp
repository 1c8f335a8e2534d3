#include "cli/report/page.hpp"

#include <map>
#include <ostream>
#include <string>
#include <string_view>

#include "cli/report/assets.hpp"
#include "core/provenance.hpp"

namespace dualdamp::cli {

namespace {

using Json = nlohmann::ordered_json;

/// JSON inside a script element, escaped so that nothing looks like the end of the element.
std::string embedded(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  }
  return result;
}

/// The digest of `core::sha256` in base 64, as a content security policy states it.
std::string base64_of(const std::string& hexadecimal) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  // Three hexadecimal digits are two digits of base 64. Of 64 digits, one with four bits is left.
  std::string result;
  for (std::size_t i = 0; i < hexadecimal.size(); i += 3) {
    const std::string group = (hexadecimal.substr(i, 3) + "00").substr(0, 3);
    const unsigned long value = std::stoul(group, nullptr, 16);
    result += digits[value >> 6U];
    result += digits[value & 63U];
  }
  result.back() = '=';
  return result;
}

/// The template with its placeholders replaced. Replaced text is not searched again.
void fill(std::ostream& out, const std::map<std::string, std::string>& fillings) {
  std::string_view page = assets::page_html;
  while (true) {
    const std::size_t open = page.find('@');
    const std::size_t close = open == std::string_view::npos ? open : page.find('@', open + 1);
    if (close == std::string_view::npos) break;
    out << page.substr(0, open) << fillings.at(std::string(page.substr(open + 1, close - open - 1)));
    page.remove_prefix(close + 1);
  }
  out << page;
}

}  // namespace

void write_page(std::ostream& out, const Json& document, const Json& tables,
                const std::vector<std::string_view>& scripts) {
  std::string script;
  for (const std::string_view part :
       {assets::d3_min_js, assets::data_js, assets::elements_js, assets::export_js, assets::chart_js})
    script += std::string(part) + "\n";
  for (const std::string_view part : scripts) script += std::string(part) + "\n";
  fill(out, {{"style", std::string(assets::page_css)},
             {"document", embedded(document)},
             {"tables", embedded(tables)},
             {"script_sha256", base64_of(core::sha256(script))},
             {"script", script}});
}

}  // namespace dualdamp::cli
