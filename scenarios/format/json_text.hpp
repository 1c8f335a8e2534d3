#pragma once
/// JSON from outside the program: the value of a key, the result of a fit, the result of an earlier run.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// Builds a document while it is read, and leaves out what is not asked for. Ends the reading of a text that nests
/// deeper, or holds more, than any document that the program writes: a level costs a hundred bytes of memory for a
/// byte of the text.
class JsonBuilder : public nlohmann::json_sax<Json> {
 public:
  /// 32 MB. The long lists of a result are tables, of which few rows are kept (`cli/report/stored_run.cpp`).
  static constexpr std::size_t usual_cost = 2'000'000;

  /// `most_cost` of the kept values: 1 a number, more for what takes more memory.
  explicit JsonBuilder(std::size_t most_cost = usual_cost) : most_cost_(most_cost) {}

  [[nodiscard]] Json take() { return std::move(root_); }
  /// Whether the reading has ended because the text is too deep or too large.
  [[nodiscard]] bool is_beyond_limits() const { return is_beyond_limits_; }
  /// Values that were seen, kept or not.
  [[nodiscard]] std::size_t seen() const { return seen_; }

  bool null() override { return scalar(nullptr); }
  bool boolean(bool value) override { return scalar(value); }
  bool number_integer(number_integer_t value) override { return scalar(value); }
  bool number_unsigned(number_unsigned_t value) override { return scalar(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return scalar(value); }
  bool string(string_t& value) override;
  bool binary(binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
  bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
  bool key(string_t& name) override;
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t /*place*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    return false;
  }

 protected:
  /// What to do with an object or a list that begins.
  enum class Use { keep, leave_out, stop };
  [[nodiscard]] virtual Use use_of(bool /*is_object*/) const { return Use::keep; }
  /// How many numbers and texts of a list to keep.
  [[nodiscard]] virtual std::size_t most_in_list() const { return static_cast<std::size_t>(-1); }

  /// Objects and lists around the place of reading.
  [[nodiscard]] std::size_t depth() const { return around_.size(); }
  [[nodiscard]] const Json& parent() const { return *around_.back().value; }
  /// The key in the object at this depth; empty in a list.
  [[nodiscard]] const std::string& key_at(std::size_t depth) const { return around_[depth].key; }

 private:
  struct Level {
    Json* value;
    std::string key;
  };

  [[nodiscard]] bool is_left_out() const;
  bool scalar(Json value);
  bool open(Json value);
  bool close();
  bool spend(std::size_t cost);
  Json* add(Json value);

  Json root_ = Json::value_t::discarded;
  std::vector<Level> around_;
  std::size_t left_out_ = 0;  ///< levels below one that is left out
  std::size_t cost_ = 0;
  std::size_t most_cost_;
  std::size_t seen_ = 0;
  bool is_beyond_limits_ = false;
};

/// Discarded (`is_discarded`) if the text is not a complete document, or beyond the limits of `JsonBuilder`.
[[nodiscard]] Json parse_json(std::string_view text, std::size_t most_cost = JsonBuilder::usual_cost);

/// Reads a file piece by piece. False if it is not a complete document, or the builder has ended the reading.
/// Errors: as of `core::fail_to_read`.
[[nodiscard]] bool parse_json_file(const std::string& path, JsonBuilder& builder);

}  // namespace dualdamp::scenarios
