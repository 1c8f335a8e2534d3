#include "scenarios/format/json_text.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <istream>
#include <memory>
#include <streambuf>
#include <utility>

#include "core/input_file.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr std::size_t most_levels = 64;
// In numbers: a list or an object with its first element, a string with the bytes that it has of its own.
constexpr std::size_t cost_of_level = 5;
constexpr std::size_t cost_of_string = 3;
constexpr std::size_t bytes_of_number = sizeof(Json);

/// The bytes of a file. Ends within a text or a number of more than 8 MiB, which the parser would keep twice.
class FileBuffer : public std::streambuf {
 public:
  FileBuffer(const std::string& path, const JsonBuilder& builder)
      : path_(path), builder_(builder), file_(std::fopen(path.c_str(), "rbe"), std::fclose) {
    if (!file_) core::fail_to_read(path, "cannot be opened", errno);
  }

 protected:
  int_type underflow() override {
    constexpr int most_pieces = 128;
    pieces_ = builder_.seen() == seen_ ? pieces_ + 1 : 0;
    seen_ = builder_.seen();
    const std::size_t count = pieces_ > most_pieces ? 0 : std::fread(piece_.data(), 1, piece_.size(), file_.get());
    if (std::ferror(file_.get()) != 0) core::fail_to_read(path_, "cannot be read", errno);
    setg(piece_.data(), piece_.data(), piece_.data() + count);
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(piece_.front());
  }

 private:
  const std::string& path_;
  const JsonBuilder& builder_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::size_t seen_ = 0;  ///< values at the last piece
  int pieces_ = 0;        ///< without a new value
  std::array<char, 1U << 16U> piece_{};
};

}  // namespace

bool JsonBuilder::spend(std::size_t cost) {
  cost_ += cost;
  if (cost_ > most_cost_) is_beyond_limits_ = true;
  return !is_beyond_limits_;
}

/// Two members of one name stay: a search for each would take a time that grows with the square of their number,
/// and the first one is found.
Json* JsonBuilder::add(Json value) {
  if (around_.empty()) {
    root_ = std::move(value);
    return &root_;
  }
  Level& level = around_.back();
  if (level.value->is_array()) {
    level.value->push_back(std::move(value));
    return &level.value->back();
  }
  auto& members = level.value->get_ref<Json::object_t&>();
  members.emplace_back(level.key, std::move(value));
  return &members.back().second;
}

bool JsonBuilder::is_left_out() const {
  return left_out_ > 0 || (!around_.empty() && parent().is_array() && parent().size() >= most_in_list());
}

bool JsonBuilder::scalar(Json value) {
  ++seen_;
  if (is_left_out()) return true;
  if (!spend(1)) return false;
  add(std::move(value));
  return true;
}

bool JsonBuilder::string(string_t& value) {
  return (is_left_out() || spend(cost_of_string + value.size() / bytes_of_number)) && scalar(std::move(value));
}

bool JsonBuilder::key(string_t& name) {
  ++seen_;
  if (left_out_ > 0) return true;
  around_.back().key = std::move(name);
  return spend(cost_of_string + around_.back().key.size() / bytes_of_number);
}

bool JsonBuilder::open(Json value) {
  ++seen_;
  if (depth() + left_out_ >= most_levels) {
    is_beyond_limits_ = true;
    return false;
  }
  const Use use = left_out_ > 0 ? Use::leave_out : use_of(value.is_object());
  if (use == Use::stop) return false;
  if (use == Use::leave_out) {
    ++left_out_;
    return true;
  }
  if (!spend(cost_of_level)) return false;
  around_.push_back({add(std::move(value)), {}});
  return true;
}

bool JsonBuilder::close() {
  if (left_out_ > 0)
    --left_out_;
  else
    around_.pop_back();
  return true;
}

Json parse_json(std::string_view text, std::size_t most_cost) {
  JsonBuilder builder(most_cost);
  return Json::sax_parse(text, &builder) ? builder.take() : Json(Json::value_t::discarded);
}

bool parse_json_file(const std::string& path, JsonBuilder& builder) {
  FileBuffer buffer(path, builder);
  std::istream text(&buffer);
  return Json::sax_parse(text, &builder);
}

}  // namespace dualdamp::scenarios
