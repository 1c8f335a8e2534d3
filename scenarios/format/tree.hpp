#pragma once
/// A scenario file as a tree with places: every value has its line and column.
///
/// Constructs that YAML allows and that readers misunderstand are refused here, before keys are interpreted:
/// duplicate keys, keys without value, quotes that do not close on their line, values that run on over several
/// lines, anchors, aliases, tags, merge keys, directives, several documents, tabs, invisible characters, text that
/// is not UTF-8, nesting deeper than `max_depth`, files above `max_bytes`. Errors: `core::InputError` if nothing
/// more can be read; every other problem is kept in `problems()`, so that it is reported together with the problems
/// of the keys. Cost: linear in the length of the text.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/setting.hpp"

namespace dualdamp::scenarios {

inline constexpr std::size_t max_bytes = 1 << 20;
inline constexpr int max_depth = 16;

/// At most 60 bytes of `text`, for messages.
[[nodiscard]] std::string shortened(std::string_view text);

/// A position in one of the texts a document is made of. Lines and columns count from 1; a column is a character.
struct Place {
  int source = 0;
  int line = 0;
  int column = 0;
};

struct Entry;

struct Node {
  enum class Kind { null, scalar, sequence, map };  ///< null: a value that was already reported

  Kind kind = Kind::null;
  Place place;
  Place key_place;          ///< of the key it belongs to; line 0 when it belongs to none
  std::string text;         ///< scalar
  bool quoted = false;      ///< scalar: quoted or a block, so it is text and never a number or a word of the format
  std::vector<Node> items;  ///< sequence
  std::vector<Entry> entries;  ///< map, in order of the file, keys distinct

  /// Place for messages about something that is missing inside.
  [[nodiscard]] Place head() const { return key_place.line > 0 ? key_place : place; }
  /// nullptr when this is not a map or has no such key.
  [[nodiscard]] const Entry* find(std::string_view key) const;
};

struct Entry {
  std::string key;
  Place place;
  Node value;
};

/// The list of the names in a text, which commas separate. Another node remains as it is.
[[nodiscard]] Node list_of_names(const Node& node);

/// The map {key: value}, at the place of the value.
[[nodiscard]] Node map_of(const std::string& key, const Node& value);

/// The file and the overrides applied to it.
class Document {
 public:
  /// `name` is the name of the file in messages, `words` those for what a user may state.
  Document(std::string name, const std::string& text, core::SettingWords words = {});

  /// Applies `PATH=VALUE`, PATH like `system.friction[0].kinetic`, VALUE in YAML. Keys on the way that do not exist
  /// are created; list items must exist. `origin` is the name of the file in messages. A value that an
  /// earlier assignment states is refused.
  void set(std::string_view assignment, std::string origin);
  /// The assignment that states a value at this path or below it, with its origin; nothing if the file states it.
  [[nodiscard]] std::optional<std::string> assigned(std::string_view path) const;
  /// Whether an option or a sweep names exactly this path, and not a section that contains it.
  [[nodiscard]] bool is_chosen(std::string_view path) const;

  /// Sets the value at PATH to a node; `place` is that of PATH, for messages.
  void put(std::string_view path, Place place, Node value);
  /// Removes a key of the root, or of one of its sections (`analysis.methods`), and returns its value; nothing when
  /// there is no such key.
  std::optional<Entry> take(std::string_view path);
  /// A part of this document as a separate document without problems.
  [[nodiscard]] Document part(Node root) const;

  [[nodiscard]] const Node& root() const { return root_; }
  [[nodiscard]] const core::SettingWords& words() const { return words_; }
  [[nodiscard]] const std::vector<core::Diagnostic>& problems() const { return problems_; }
  [[nodiscard]] core::SourcePlace locate(Place place) const;
  /// The text of the file, line ends normalised.
  [[nodiscard]] const std::string& text() const { return sources_.front().text; }

 private:
  struct Source {
    std::string name;
    std::string text;
    std::vector<std::size_t> line_starts;
  };

  friend class TreeBuilder;

  [[nodiscard]] Place place_at(int source, std::size_t offset) const;
  /// `place_of`: place of the step that begins at this offset of the path.
  void put(std::string_view path, Node value, const std::function<Place(std::size_t)>& place_of);
  /// Parses `sources_[source]` from `begin` on.
  [[nodiscard]] Node parse(int source, std::size_t begin);

  std::vector<Source> sources_;
  Node root_;
  std::vector<core::Diagnostic> problems_;
  std::vector<std::string> chosen_;  ///< paths that options and sweeps name
  core::SettingWords words_;
};

}  // namespace dualdamp::scenarios
