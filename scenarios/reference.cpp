#include <cctype>
#include <set>

#include "core/units.hpp"
#include "scenarios/scenario_format.hpp"
#include "scenarios/schema.hpp"

namespace dualdamp::scenarios {

namespace {

/// Markdown of the tables, section by section.
class Page {
 public:
  void heading(int level, const std::string& title) {
    text_ += "\n" + std::string(static_cast<std::size_t>(level), '#') + " " + title + "\n";
  }

  void paragraph(const std::string& text) { text_ += "\n" + text + "\n"; }

  void keys(const Section& section, const std::string& discriminator = {}) {
    if (section.fields.empty()) {
      paragraph(discriminator.empty() ? "No keys." : "No further keys.");
      return;
    }
    text_ += "\n| key | values | default | meaning |\n|---|---|---|---|\n";
    for (const Field& field : section.fields)
      row({"`" + field.name + "`", describe_values(field), default_of(section, field), field.meaning});
    for (const Alternatives& alternatives : section.alternatives)
      paragraph(std::string(alternatives.is_required ? "Exactly one of " : "At most one of ") +
                joined(alternatives.names) + ".");
  }

  /// A section and those inside it; sections under `level`.
  void choice(int level, const std::string& path, const Choice& choice) {
    if (choice.key.empty()) {
      keys(choice.variants.front().section);
      nested(level, path, choice.variants.front().section);
      return;
    }
    for (const Variant& variant : choice.variants) {
      heading(level, "`" + path + "` with `" + choice.key + ": " + variant.name + "`");
      paragraph(capitalised(variant.summary) + ".");
      keys(variant.section, choice.key);
      if (!variant.equation.empty()) paragraph("`" + variant.equation + "`");
      results(variant.results);
      nested(level + 1, path, variant.section);
    }
  }

  void nested(int level, const std::string& path, const Section& section) {
    for (const Field& field : section.fields) {
      const std::string inner = path.empty() ? field.name : path + "." + field.name;
      if (field.kind != Kind::choice || !said_.insert(inner).second) continue;
      heading(level, "`" + inner + (field.only_listed ? "[]`" : "`"));
      paragraph(capitalised(field.meaning) + "." +
                (field.listed ? " " + capitalised(describe_values(field)) + "." : ""));
      choice(level + 1, inner, *field.choice);
    }
  }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  static std::string capitalised(std::string text) {
    if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
  }

  static std::string default_of(const Section& section, const Field& field) {
    const std::string others = joined(section.instead_of(field.name));
    if (field.is_required && !field.instead_of.empty()) return "required without `" + field.instead_of + "`";
    if (field.is_required) return others.empty() ? "required" : "required, or " + others;
    if (!field.fallback.is_null())
      return field.fallback.is_string() ? field.fallback.get<std::string>() : field.fallback.dump();
    return field.fallback_words;
  }

  void row(const std::vector<std::string>& cells) {
    text_ += "|";
    for (const std::string& cell : cells) {
      text_ += " ";
      for (const char c : cell) text_ += c == '|' ? "\\|" : std::string(1, c);
      text_ += " |";
    }
    text_ += "\n";
  }

  void results(const std::vector<ResultField>& fields) {
    if (fields.empty()) return;
    paragraph("Its result:");
    text_ += "\n| path | unit | meaning |\n|---|---|---|\n";
    for (const ResultField& field : fields)
      row({"`" + field.path + "`", field.unit == "1" ? "-" : field.unit, field.meaning});
  }

  std::string text_;
  std::set<std::string> said_;
};

}  // namespace

std::string reference_page(const AnalysisList& list) {
  const Section format = scenario_format(list);
  Page page;
  page.paragraph(
      "Made by `dualdamp schema --markdown` from the tables of the scenario reader; a test keeps it fresh.");
  page.heading(2, "The file");
  page.keys(format);
  page.nested(2, "", format);
  return "# Scenario reference\n" + page.take();
}

}  // namespace dualdamp::scenarios
