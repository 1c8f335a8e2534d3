#pragma once
/// The files of the page (HTML, CSS, scripts), which the build embeds in the program.

#include <string_view>

namespace dualdamp::cli::assets {

extern const std::string_view page_html;
extern const std::string_view page_css;
extern const std::string_view data_js;
extern const std::string_view elements_js;
extern const std::string_view export_js;
extern const std::string_view chart_js;
extern const std::string_view views_js;
extern const std::string_view sweep_js;
extern const std::string_view views_of_analyses_js;
extern const std::string_view page_js;
extern const std::string_view compare_js;
extern const std::string_view d3_min_js;

}  // namespace dualdamp::cli::assets
