#include "scenarios/format/json_text.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/diagnostics.hpp"

using dualdamp::scenarios::Json;
using dualdamp::scenarios::JsonBuilder;
using dualdamp::scenarios::parse_json;
using dualdamp::scenarios::parse_json_file;

namespace {

std::string times(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

struct JsonTextFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("dualdamp-json-" + std::to_string(::getpid()));
  explicit JsonTextFile(const std::string& text) { std::ofstream(path) << text; }
  ~JsonTextFile() { std::filesystem::remove(path); }
};

/// Leaves out the objects of lists after the second one.
class TwoOfEach : public JsonBuilder {
  [[nodiscard]] std::size_t most_in_list() const override { return 4; }
  [[nodiscard]] Use use_of(bool is_object) const override {
    return is_object && depth() > 0 && parent().is_array() && parent().size() >= 2 ? Use::leave_out : Use::keep;
  }
};

/// Ends at the second member.
class FirstMember : public JsonBuilder {
  [[nodiscard]] Use use_of(bool /*is_object*/) const override {
    return depth() == 1 && key_at(0) != "a" ? Use::stop : Use::keep;
  }
};

}  // namespace

TEST_CASE("JSON text: what the parser of the library reads is read the same") {
  for (const char* text : {"{}", "[]", "null", "1", "-0.0", "\"x\"", "[1,-2,3.5e-300,true,false,null,\"\\u00e9\"]",
                           R"({"b":{"a":[{},[],[[1]]],"":""},"a":18446744073709551615})", " \n[ ] "})
    CHECK(parse_json(text) == Json::parse(text));
  for (const char* text : {"", "[", "[1,]", "{\"a\"}", "[] []", "nan", "\"\xff\"", "{\"a\":1"})
    CHECK(parse_json(text).is_discarded());
}

TEST_CASE("JSON text: depth and size are limited, and keys cost no search") {
  CHECK_FALSE(parse_json(times(64, "[") + times(64, "]")).is_discarded());
  CHECK(parse_json(times(65, "[") + times(65, "]")).is_discarded());
  CHECK(parse_json(times(1'000'000, "{\"a\":")).is_discarded());
  CHECK_FALSE(parse_json("[" + times(9, "1,") + "1]", 15).is_discarded());
  CHECK(parse_json("[" + times(10, "1,") + "1]", 15).is_discarded());
  std::string members;
  for (int i = 0; i < 100'000; ++i) members += "\"k" + std::to_string(i) + "\":1,";
  CHECK(parse_json("{" + members + "\"last\":2}").at("last") == 2);  // a search for each takes a minute
}

TEST_CASE("JSON text: a file is read as far as it is wanted") {
  const JsonTextFile file(R"({"a":[{"i":0},{"i":1},{"i":[{}]},5,{"i":3}],"b":{"c":[1,"2",3,4,5,"6",[]]},"d":[)");
  TwoOfEach cut;
  CHECK_FALSE(parse_json_file(file.path, cut));  // the end is missing
  CHECK_FALSE(cut.is_beyond_limits());
  CHECK(cut.take() == Json::parse(R"({"a":[{"i":0},{"i":1},5],"b":{"c":[1,"2",3,4,[]]},"d":[]})"));
  FirstMember first;
  CHECK_FALSE(parse_json_file(file.path, first));
  CHECK(first.take() == Json::parse(R"({"a":[{"i":0},{"i":1},{"i":[{}]},5,{"i":3}]})"));
  JsonBuilder none;
  CHECK_THROWS_AS(parse_json_file(file.path.string() + ".none", none), dualdamp::core::InputError);
}

TEST_CASE("JSON text: a text of more than 8 MiB in a file ends the reading") {
  const JsonTextFile file("{\"a\":\"" + std::string(std::size_t{12} << 20U, 'x') + "\"}");
  JsonBuilder builder;
  CHECK_FALSE(parse_json_file(file.path, builder));
}
