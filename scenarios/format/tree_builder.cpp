#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

#include "core/utf8.hpp"
#include "scenarios/format/text_checks.hpp"
#include "scenarios/format/tree.hpp"

namespace dualdamp::scenarios {

using core::Diagnostic;
using core::InputError;

namespace {

constexpr std::size_t max_problems = 50;

/// A fault of the YAML in terms that a user of scenario files knows.
struct YamlFault {
  std::string message;
  bool is_unclosed = false;  ///< a bracket or a quote that is open above is what is wrong
};

YamlFault in_plain_words(const std::string& message, std::string_view text, std::size_t at) {
  if (message == "end of map flow not found" && at > 0 && at < text.size() && text[at] == '[' &&
      text[at - 1] != ' ')
    return {"between { and } a text with brackets, such as points[0].x, needs quotes"};
  struct Translation {
    std::string_view theirs;
    std::string_view ours;
    bool is_unclosed = false;
  };
  static constexpr std::array<Translation, 9> translations = {{
      {"end of map not found",
       "this does not fit what stands above: check the indentation and a missing ':' or quote"},
      {"end of sequence not found", "this does not fit the list above: check the indentation and the '-'"},
      {"illegal map value",
       "a ':' is out of place here: one key a line, and quotes around text that contains ': '"},
      {"end of map flow not found", "this '{' is not closed by '}'", true},
      {"end of sequence flow not found", "this '[' is not closed by ']'", true},
      {"illegal EOF in scalar", "the text ends inside quotes that are not closed", true},
      {"illegal flow end", "this bracket closes nothing"},
      {"unknown token", "a value cannot begin with this character: put the text in quotes"},
      {"the referenced anchor is not defined", "anchors (&) and aliases (*) are not allowed"},
  }};
  for (const Translation& each : translations)
    if (message == each.theirs) return {std::string(each.ours), each.is_unclosed};
  return {"this is not YAML: " + message};
}

constexpr std::string_view decimal_comma =
    "a comma between two digits: write numbers with a decimal point, and a space behind a comma that separates";

/// Offset of a `%` that begins a directive: one at the start of a line above the content.
std::optional<std::size_t> find_directive(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '%') return at;
    const std::size_t content = text.find_first_not_of(' ', at);
    if (content == std::string_view::npos || (text[content] != '#' && text[content] != '\n')) return std::nullopt;
    at = std::min(text.find('\n', content), text.size() - 1) + 1;
  }
  return std::nullopt;
}

}  // namespace

/// Builds the tree from yaml-cpp's events, and checks each event against the text it came from: the text still
/// contains details that the events have lost.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const Document& document, int source, std::size_t begin)
      : document_(document), source_(source), begin_(begin), text_(document.sources_[index()].text) {}

  [[nodiscard]] const std::vector<Diagnostic>& problems() const { return problems_; }
  [[nodiscard]] Node take_root() { return std::move(root_); }

  void complain(std::size_t offset, std::string message, std::string allowed = {}, std::string found = {}) {
    if (problems_.size() >= max_problems) throw InputError(problems_);
    problems_.push_back({document_.locate(document_.place_at(source_, offset)),
                         std::move(message),
                         std::move(allowed),
                         std::move(found),
                         {}});
  }

  /// Reports in plain words what yaml-cpp could not read, and throws.
  [[noreturn]] void fail(const YAML::Exception& error) {
    const YamlFault fault = in_plain_words(error.msg, text_, offset(error.mark));
    const auto opener = std::find_if(stack_.rbegin(), stack_.rend(), [&](const Frame& frame) {
      return at(frame.offset) == '{' || at(frame.offset) == '[';
    });
    complain(fault.is_unclosed && opener != stack_.rend() ? opener->offset : offset(error.mark), fault.message);
    throw InputError(problems_);
  }

  /// Reports what is wrong with the text at `mark`, and throws.
  [[noreturn]] void fail(const YAML::Mark& mark, std::string message) {
    complain(offset(mark), std::move(message));
    throw InputError(problems_);
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (has_root_)
      fail(mark,
           "a second document begins here: a scenario is one document (check the indentation if none was meant)");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    Node node;
    node.place = place(mark);
    if (awaits_key()) fail(mark, "a key is missing before ':'");
    if (is_null_word(offset(mark)))
      complain(offset(mark), "null is not a value: leave the key out");
    else if (!stack_.empty() && stack_.back().node.kind == Node::Kind::map)
      complain_about_missing_value();
    else if (!stack_.empty())
      complain(offset(mark), "an item of the list is empty");
    attach(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    complain(offset(mark), "anchors (&) and aliases (*) are not allowed: write the value out");
    Node node;
    node.place = place(mark);
    attach(std::move(node));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_properties(mark, tag, anchor);
    const std::size_t where = offset(mark);
    Node node;
    node.kind = Node::Kind::scalar;
    node.place = place(mark);
    node.text = value;
    const char first = at(where);
    if (first == '"' || first == '\'') {
      node.quoted = true;
      check_quote(where, first);
    } else if (first == '|' || first == '>') {
      node.quoted = true;
      node.text.erase(node.text.find_last_not_of('\n') + 1);
    } else if (first != '!' && first != '&' && text_.compare(where, value.size(), value) != 0) {
      complain(where, "this value runs on into the next line",
               "a value on one line: check the indentation and the ':' of the next line, or put text in quotes");
      node.kind = Node::Kind::null;
    } else if (!awaits_key() && follows_comma_in_number(where) &&
               value.find_first_not_of("0123456789.eE+-") != std::string::npos) {
      complain(where, std::string(decimal_comma));
    }
    if (node.text.find('\n') != std::string::npos) {
      complain(where, "this text has several lines", "a text on one line");
      node.kind = Node::Kind::null;
    } else if (const std::vector<TextFault> faults = text_faults(node.text); !faults.empty()) {
      // An escape, such as "\e", stands for what the file itself must not hold.
      complain(where, faults.front().message + ", written as an escape");
      node.kind = Node::Kind::null;
    }
    if (awaits_key())
      begin_entry(std::move(node), where);
    else
      attach(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, Node::Kind::sequence);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, tag, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    Node node;
    std::size_t offset = 0;  ///< where it opens
    bool has_key = false;    ///< the key of a map was read, its value not yet
    std::string key;
    Place key_place;
    std::size_t key_offset = 0;
  };

  [[nodiscard]] std::size_t index() const { return static_cast<std::size_t>(source_); }
  [[nodiscard]] std::size_t offset(const YAML::Mark& mark) const {
    return std::min(begin_ + static_cast<std::size_t>(std::max(mark.pos, 0)), text_.size());
  }
  /// Events come in order of the text: counting on from the last place keeps a long line linear.
  [[nodiscard]] Place place(const YAML::Mark& mark) {
    const std::size_t where = offset(mark);
    const bool forward = last_place_.line > 0 && where >= last_offset_;
    const std::string_view between =
        std::string_view(text_).substr(last_offset_, forward ? where - last_offset_ : 0);
    if (forward && between.find('\n') == std::string_view::npos)
      last_place_.column += static_cast<int>(core::count_characters(between));
    else
      last_place_ = document_.place_at(source_, where);
    last_offset_ = where;
    return last_place_;
  }
  [[nodiscard]] char at(std::size_t where) const { return where < text_.size() ? text_[where] : '\0'; }
  [[nodiscard]] bool awaits_key() const {
    return !stack_.empty() && stack_.back().node.kind == Node::Kind::map && !stack_.back().has_key;
  }

  [[nodiscard]] bool is_null_word(std::size_t where) const {
    const std::string_view rest = std::string_view(text_).substr(where);
    const std::string_view word = rest.substr(0, rest.find_first_of(" \n,]}#"));
    return word == "~" || word == "null" || word == "Null" || word == "NULL";
  }

  void refuse_properties(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (anchor != 0) complain(offset(mark), "anchors (&) and aliases (*) are not allowed: write the value out");
    const bool plain = tag.empty() || tag == "?";
    if (!plain && (tag != "!" || at(offset(mark)) == '!')) complain(offset(mark), "tags (!) are not allowed");
  }

  /// A digit, a comma and a digit: [4,5 mm] is 4 and 5 mm for YAML, but many readers mean 4.5 mm.
  [[nodiscard]] bool follows_comma_in_number(std::size_t where) const {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return where >= 2 && is_digit(at(where)) && at(where - 1) == ',' && is_digit(at(where - 2));
  }

  /// yaml-cpp continues an open quote to the end of the file.
  void check_quote(std::size_t where, char quote) {
    for (std::size_t i = where + 1; i < text_.size() && text_[i] != '\n'; ++i) {
      if (quote == '"' && text_[i] == '\\') {
        ++i;
      } else if (text_[i] == quote) {
        if (quote != '\'' || at(i + 1) != '\'') return;
        ++i;
      }
    }
    // The rest of the file is inside the quote: nothing more can be checked.
    complain(where, "this quote is not closed on its line");
    throw InputError(problems_);
  }

  void complain_about_missing_value() {
    const Frame& frame = stack_.back();
    const std::size_t after = text_.find_first_not_of("\"' ", frame.key_offset + frame.key.size());
    if (after != std::string::npos && text_[after] == ':')
      complain(frame.key_offset, "'" + shortened(frame.key) + "' has no value");
    else if (follows_comma_in_number(frame.key_offset))
      complain(frame.key_offset, std::string(decimal_comma));
    else if (frame.key.find(':') != std::string::npos)
      complain(frame.key_offset, "'" + shortened(frame.key) + "': a space is missing after the ':'");
    else
      complain(frame.key_offset, "'" + shortened(frame.key) + "' stands alone: a ':' and a value are missing");
  }

  void begin_entry(Node key, std::size_t where) {
    Frame& frame = stack_.back();
    frame.has_key = true;
    frame.key = std::move(key.text);
    frame.key_place = key.place;
    frame.key_offset = where;
    if (frame.key == "<<") complain(where, "merge keys (<<) are not allowed: write the values out");
    if (const Entry* first = frame.node.find(frame.key))
      complain(where, "the key '" + shortened(frame.key) + "' is given twice",
               "one of them; the first is in line " + std::to_string(first->place.line));
  }

  void attach(Node node) {
    if (stack_.empty()) {
      root_ = std::move(node);
      has_root_ = true;
      return;
    }
    Frame& frame = stack_.back();
    if (frame.node.kind == Node::Kind::sequence) {
      frame.node.items.push_back(std::move(node));
      return;
    }
    frame.has_key = false;
    if (frame.key == "<<") return;
    node.key_place = frame.key_place;
    constexpr std::size_t max_keys = 1000;
    if (frame.node.entries.size() >= max_keys) {
      complain(frame.key_offset, "a map has more than " + std::to_string(max_keys) + " keys");
      throw InputError(problems_);
    }
    if (frame.node.find(frame.key) == nullptr)
      frame.node.entries.push_back({std::move(frame.key), frame.key_place, std::move(node)});
  }

  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, Node::Kind kind) {
    if (awaits_key()) fail(mark, "a key must be a word");
    if (stack_.size() >= static_cast<std::size_t>(max_depth))
      fail(mark, "this is nested deeper than " + std::to_string(max_depth) + " levels");
    refuse_properties(mark, tag, anchor);
    Frame frame;
    frame.offset = offset(mark);
    frame.node.kind = kind;
    frame.node.place = place(mark);
    stack_.push_back(std::move(frame));
  }

  void close() {
    Node node = std::move(stack_.back().node);
    stack_.pop_back();
    attach(std::move(node));
  }

  const Document& document_;
  int source_;
  std::size_t begin_;
  const std::string& text_;
  std::size_t last_offset_ = 0;
  Place last_place_;
  std::vector<Frame> stack_;
  Node root_;
  bool has_root_ = false;
  std::vector<Diagnostic> problems_;
};

Node Document::parse(int source, std::size_t begin) {
  const std::string& text = sources_[static_cast<std::size_t>(source)].text;
  TreeBuilder builder(*this, source, begin);
  for (TextFault& fault : text_faults(text)) builder.complain(fault.offset, std::move(fault.message));
  if (const auto directive = find_directive(text)) builder.complain(*directive, "directives (%) are not allowed");
  // A text with such faults is not parsed: yaml-cpp would only report consequences.
  if (!builder.problems().empty()) throw InputError(builder.problems());

  std::istringstream stream(text.substr(begin));
  YAML::Parser parser(stream);
  try {
    while (parser.HandleNextDocument(builder)) continue;
  } catch (const YAML::Exception& error) {
    builder.fail(error);
  }
  problems_.insert(problems_.end(), builder.problems().begin(), builder.problems().end());
  return builder.take_root();
}

}  // namespace dualdamp::scenarios
