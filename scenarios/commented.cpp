#include "scenarios/commented.hpp"

#include <algorithm>

#include "scenarios/format/keys.hpp"
#include "scenarios/format/tree.hpp"
#include "scenarios/scenario_format.hpp"

namespace dualdamp::scenarios {

namespace {

std::string quoted(const std::string& text) { return Json(text).dump(); }

/// A value on one line.
std::string flow(const Node& node) {
  std::string text;
  if (node.kind == Node::Kind::sequence) {
    for (const Node& item : node.items) text += (text.empty() ? "" : ", ") + flow(item);
    return "[" + text + "]";
  }
  if (node.kind == Node::Kind::map) {
    for (const Entry& entry : node.entries)
      text += (text.empty() ? "" : ", ") +
              (entry.key.find('[') == std::string::npos ? entry.key : quoted(entry.key)) + ": " + flow(entry.value);
    return "{" + text + "}";
  }
  const bool is_plain = !node.quoted && node.text.find_first_of(",[]{}#:\n\"'") == std::string::npos;
  return is_plain ? node.text : quoted(node.text);
}

/// The default as a value of the file; empty: none.
std::string fallback_of(const Field& field) {
  if (field.fallback.is_null()) return {};
  if (field.fallback.is_string()) return field.fallback.get<std::string>();
  std::string text = field.fallback.dump();
  if (field.fallback.is_number() && !field.units.empty() && !field.units.front().empty() &&
      field.units.front() != "1")
    text += " " + field.units.front();
  return text;
}

class CommentedWriter {
 public:
  void section(const Node& node, const Section& section, const std::string& indent) {
    for (const Field& field : section.fields) {
      if (field.name == "expect" && indent.empty()) continue;
      const Entry* entry = node.find(field.name);
      if (entry != nullptr)
        given(entry->value, field, indent);
      else if (!is_replaced(node, section, field))
        left_out(field, indent);
    }
  }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  /// Another key is used in its place.
  static bool is_replaced(const Node& node, const Section& section, const Field& field) {
    const auto stands = [&](const std::string& name) { return node.find(name) != nullptr; };
    if (!field.instead_of.empty() && stands(field.instead_of)) return true;
    return std::ranges::any_of(section.instead_of(field.name), stands);
  }

  void line(const std::string& code, const std::string& comment) {
    text_ += code + (comment.empty() ? "" : "  # " + comment) + "\n";
  }

  void given(const Node& node, const Field& field, const std::string& indent) {
    if (field.kind != Kind::choice || node.kind != Node::Kind::map)
      return line(indent + field.name + ": " + flow(node), field.meaning);
    line(indent + field.name + ":", field.meaning);
    const Choice& choice = *field.choice;
    const std::string deeper = indent + "  ";
    if (choice.key.empty()) return section(node, choice.variants.front().section, deeper);
    const Entry* name = node.find(choice.key);
    const Variant* variant = name == nullptr ? nullptr : choice.find(name->value.text);
    if (variant == nullptr) return;
    line(deeper + choice.key + ": " + variant->name, variant->summary);
    section(node, variant->section, deeper);
  }

  void left_out(const Field& field, const std::string& indent) {
    const std::string fallback = fallback_of(field);
    const std::string values = describe_values(field);
    line(indent + "# " + field.name + ":" + (fallback.empty() ? "" : " " + fallback),
         field.meaning + (values.empty() ? "" : "; " + values));
  }

  std::string text_;
};

}  // namespace

std::string commented(const std::string& text, const AnalysisList& analyses) {
  const Document document("template", text);
  CommentedWriter writer;
  writer.section(document.root(), scenario_format(analyses), "");
  return writer.take();
}

}  // namespace dualdamp::scenarios
