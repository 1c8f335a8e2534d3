#include "cli/command_output.hpp"

#include <algorithm>
#include <iostream>
#include <string_view>
#include <utility>

namespace dualdamp::cli {

namespace {

/// The text without control characters. Messages quote names and lines of files, in which a terminal could find
/// commands.
std::string for_terminal(const std::string& text) {
  static constexpr std::string_view replacement = "\xEF\xBF\xBD";
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool is_low = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F;
    const bool is_high = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // U+0080 to U+009F
    if (is_low || is_high)
      result += replacement;
    else
      result += text[i];
    if (is_high) ++i;
  }
  return result;
}

}  // namespace

void print(const CommandOutput& output, const Style& style) {
  if (!style.json && !output.text.empty()) std::cout << for_terminal(output.text) << std::flush;
  std::cerr << for_terminal(output.errors);
  if (!style.quiet) std::cerr << for_terminal(output.messages);
}

InOrder::InOrder(std::size_t count, Style style) : outputs_(count), ready_(count, false), style_(style) {}

void InOrder::put(std::size_t index, CommandOutput output) {
  const std::lock_guard lock(mutex_);
  outputs_[index] = std::move(output);
  ready_[index] = true;
  for (; next_ < outputs_.size() && ready_[next_]; ++next_) {
    const bool has_text = !style_.json && !outputs_[next_].text.empty();
    if (has_text && has_printed_) std::cout << "\n";
    has_printed_ = has_printed_ || has_text;
    print(outputs_[next_], style_);
  }
}

void InOrder::write_json(std::ostream& out) const {
  if (outputs_.size() == 1) return outputs_.front().json(out);
  out << "[\n";
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    out << (i == 0 ? "" : ",\n");
    outputs_[i].json(out);
  }
  out << "]\n";
}

core::ExitStatus InOrder::worst() const {
  return std::ranges::max_element(outputs_, {}, &CommandOutput::status)->status;
}

}  // namespace dualdamp::cli
