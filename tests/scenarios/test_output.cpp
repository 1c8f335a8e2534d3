// Tables are converted to JSON row by row; the text must equal that of a tree of JSON objects.
#include "scenarios/output.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "files.hpp"
#include "tests/support/written_files.hpp"

using namespace dualdamp;
using scenarios::CellKind;
using Tree = nlohmann::ordered_json;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string document_text(const scenarios::RunResult& result) {
  std::ostringstream text;
  scenarios::json_document(std::make_shared<scenarios::Scenario>(scenarios::Scenario{.resolved = "{}"}),
                           std::make_shared<scenarios::RunResult>(result))(text);
  return text.str();
}

scenarios::Table table_of_kinds() {
  return {.name = "curve",
          .columns = {{.name = "Y", .unit = "m", .numbers = {0.1, 1.0 / 3.0, 5e-324, 1.0}},
                      {.name = "stops", .numbers = {2.0, none, 0.0, 1e15}, .kind = CellKind::count},
                      {.name = "stable", .numbers = {1.0, none, 0.0, 1.0}, .kind = CellKind::truth},
                      {.name = "reason",
                       .texts = {"", "no \"state\"\nat all"},
                       .kind = CellKind::text,
                       .choices = {0, 1, 0, 0}}},
          .key = "points"};
}

}  // namespace

TEST_CASE("output: a table is written as the tree of its rows would be", "[scenarios][output]") {
  scenarios::RunResult result;
  result.result = R"({"before":{"list":[1,[]],"none":{}},"points":null,"empty":null,"after":[]})";
  result.tables = {table_of_kinds(), {.name = "empty", .columns = {{.name = "t", .unit = "s"}}, .key = "empty"}};
  const std::string text = document_text(result);
  const Tree document = Tree::parse(text);
  CHECK(text == document.dump(2) + "\n");
  const Tree points = {
      {{"Y", 0.1}, {"stops", 2}, {"stable", true}},
      {{"Y", 1.0 / 3.0}, {"stops", nullptr}, {"stable", nullptr}, {"reason", "no \"state\"\nat all"}},
      {{"Y", 5e-324}, {"stops", 0}, {"stable", false}},
      {{"Y", 1.0}, {"stops", 1000000000000000}, {"stable", true}}};
  CHECK(document.at("result").dump() == Tree({{"before", {{"list", {1, Tree::array()}}, {"none", Tree::object()}}},
                                              {"points", points},
                                              {"empty", Tree::array()},
                                              {"after", Tree::array()}})
                                            .dump());
}

TEST_CASE("output: a table that is no list of the result is a file only", "[scenarios][output]") {
  scenarios::RunResult result;
  result.result = R"({"points":null})";
  result.tables = {{.name = "points", .columns = {{.name = "t"}}}};
  CHECK(Tree::parse(document_text(result)).at("result").at("points").is_null());
}

TEST_CASE("output: a relative change that is rounding only is none, and one that does not exist has no number",
          "[scenarios][output]") {
  CHECK(scenarios::change_text(0.0312) == "+3.1 %");
  CHECK(scenarios::change_text(-0.5) == "-50 %");
  CHECK(scenarios::change_text(-9e-7) == "0 %");
  CHECK(scenarios::change_text(none) == "-");
}

TEST_CASE("output: a file that fails half way leaves the old one and no part of itself", "[scenarios][output]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() /
                          ("dualdamp-output-" + std::to_string(std::hash<std::string>()(testing::root.string())));
  fs::remove_all(folder);
  const std::string longer(200'000, 'x');  // more than any buffer
  const auto write = [&](const scenarios::Writer& writer) {
    testing::write_files(folder.string(), {{"a", writer}});
  };
  write([&](std::ostream& out) { out << longer << "end"; });
  CHECK(testing::text_of(folder / "a") == longer + "end");
  CHECK_THROWS_AS(write([&](std::ostream& out) {
                    out << longer;
                    throw std::bad_alloc();
                  }),
                  std::bad_alloc);
  CHECK(testing::text_of(folder / "a") == longer + "end");
  CHECK_THROWS_AS(testing::write_files(folder.string(), {{"a", [](std::ostream& out) { out << "new"; }},
                                                         {"b", [](std::ostream&) { throw std::bad_alloc(); }}}),
                  std::bad_alloc);
  CHECK(testing::text_of(folder / "a") == longer + "end");
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
  CHECK_THROWS_AS(testing::write_files((folder / "a").string(), {}), scenarios::OutputError);
  fs::remove_all(folder);
}

TEST_CASE("output: a link in place of the subdirectory is refused, and what it leads to stays",
          "[scenarios][output]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("dualdamp-link-" + std::to_string(::getpid()));
  fs::create_directories(folder / "mine");
  std::ofstream(folder / "mine" / "a") << "text";
  fs::create_directories(folder / "results");
  fs::create_directory_symlink(folder / "mine", folder / "results" / ".dualdamp.partial");
  CHECK_THROWS_WITH(testing::write_files((folder / "results").string(), {{"b", [](std::ostream&) {}}}),
                    Catch::Contains("it is a link"));
  CHECK(testing::text_of(folder / "mine" / "a") == "text");
  CHECK_FALSE(fs::exists(folder / "mine" / "b"));
  fs::remove_all(folder);
}

TEST_CASE("output: files that several write at once are those of one of them", "[scenarios][output]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("dualdamp-at-once-" + std::to_string(::getpid()));
  fs::create_directories(folder / ".dualdamp.partial");
  std::ofstream(folder / ".dualdamp.partial" / "a") << "left by a program that was killed";
  const auto write = [&](int writer) {
    const auto text = [writer](std::ostream& out) {
      out << writer << std::flush;
      std::this_thread::yield();
    };
    for (int i = 0; i < 20; ++i) testing::write_files(folder.string(), {{"a", text}, {"b", text}, {"c", text}});
  };
  {
    std::vector<std::jthread> writers;
    for (int writer = 0; writer < 4; ++writer) writers.emplace_back(write, writer);
  }
  CHECK(testing::text_of(folder / "a") == testing::text_of(folder / "b"));
  CHECK(testing::text_of(folder / "a") == testing::text_of(folder / "c"));
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 3);
  fs::remove_all(folder);
}
