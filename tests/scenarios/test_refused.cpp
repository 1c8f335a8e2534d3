// Every file of tests/invalid and tests/invalid_text states its faults and their places in its first lines:
//   # expect: LINE:COLUMN: part of the message
#include <catch2/catch.hpp>

#include "files.hpp"
#include "scenarios/scenario.hpp"
#include "tests/support/problems.hpp"

using namespace dualdamp;

namespace {

struct Expected {
  int line = 0;
  int column = 0;
  std::string message;
};

std::vector<Expected> expected_of(const std::string& text) {
  std::vector<Expected> result;
  std::istringstream lines(text);
  const std::string mark = "# expect: ";
  for (std::string line; std::getline(lines, line) && line.starts_with(mark);) {
    Expected expected;
    char colon = 0;
    std::istringstream fields(line.substr(mark.size()));
    fields >> expected.line >> colon >> expected.column >> colon;
    std::getline(fields >> std::ws, expected.message);
    result.push_back(expected);
  }
  return result;
}

std::vector<core::Diagnostic> problems_of_file(const std::string& path) {
  return test::problems_of([&] { return testing::load(path); });
}

}  // namespace

TEST_CASE("refused: each invalid file, at its place and for its reason", "[scenarios][refused]") {
  for (const std::string folder : {"tests/invalid", "tests/invalid_text"})
    for (const auto& path : testing::yaml_files(folder)) {
      CAPTURE(path.string());
      const std::string text = testing::text_of(path);
      const std::vector<Expected> all_expected = expected_of(text);
      const std::vector<core::Diagnostic> problems = problems_of_file(path.string());
      REQUIRE_FALSE(all_expected.empty());
      // Only the stated faults are reported: one fault must not cause further messages.
      CHECK(problems.size() == all_expected.size());
      for (const Expected& expected : all_expected) {
        CAPTURE(expected.line, expected.column, expected.message);
        const auto found = std::ranges::find_if(problems, [&](const core::Diagnostic& problem) {
          return problem.place.line == expected.line && problem.place.column == expected.column &&
                 problem.message.find(expected.message) != std::string::npos;
        });
        REQUIRE(found != problems.end());
        CHECK(found->place.file == path.string());
        CHECK(text.find(found->place.text) != std::string::npos);
        CHECK_FALSE(found->place.text.empty());
      }
    }
}

TEST_CASE("refused: problems come in the order of the file", "[scenarios][refused]") {
  const auto problems = problems_of_file((testing::root / "tests/invalid_text/everything_at_once.yaml").string());
  REQUIRE(problems.size() >= 5);
  CHECK(std::ranges::is_sorted(problems, {}, [](const core::Diagnostic& problem) { return problem.place.line; }));
}

TEST_CASE("refused: suggestions", "[scenarios][refused]") {
  const auto suggestion = [](const char* file) {
    const auto problems = problems_of_file((testing::root / "tests/invalid" / file).string());
    for (const core::Diagnostic& problem : problems)
      if (!problem.suggestion.empty()) return problem.suggestion;
    return std::string();
  };
  CHECK(suggestion("unknown_key.yaml") == "stiffness");
  CHECK(suggestion("unknown_law.yaml") == "coulomb");
  CHECK(suggestion("unknown_method.yaml") == "resonance_two_point");
  CHECK(suggestion("frequency_word.yaml") == "natural");
  CHECK(suggestion("backlash.yaml").empty());
}

TEST_CASE("refused: files that are no text or no scenario", "[scenarios][refused]") {
  const auto message = [](const std::string& text) {
    try {
      (void)scenarios::parse_scenario(text, "x.yaml");
    } catch (const core::InputError& error) {
      return error.diagnostics().front().message;
    }
    return std::string();
  };
  CHECK(message("") == "the file is empty");
  CHECK(message("# nothing\n") == "the file is empty");
  CHECK(message("---\n") == "the file is empty");
  CHECK(message("\xEF\xBB\xBF") == "the file is empty");
  CHECK(message("Y [mm],x [mm]\n1,2\n3,4\n") == "a scenario is a map of keys and values");
  CHECK(message("Y [mm],x [mm]\n") == "a scenario is a map of keys and values");
  CHECK(message("5\n") == "a scenario is a map of keys and values");
  CHECK(message("- a\n") == "a scenario is a map of keys and values");
  CHECK(message("title: \xFF\xFE\n") == "this is not UTF-8 text");
  CHECK(message("title: \xC0\xAF\n") == "this is not UTF-8 text");
  CHECK(message("title: \xED\xA0\x80\n") == "this is not UTF-8 text");
  CHECK(message(std::string("title: a\0b\n", 11)) == "the control character U+0000");
  CHECK(message("title: a\rb\n") == "the control character U+000D");
  CHECK(message("title: \xE2\x80\xAE evil\n").find("U+202E") != std::string::npos);
  CHECK(message(std::string(2 << 20, '#')) == "the file is too large");
}

TEST_CASE("refused: files made to exhaust the reader end soon", "[scenarios][refused]") {
  const auto refused = [](const std::string& text) {
    CHECK_THROWS_AS((void)scenarios::parse_scenario(text, "x.yaml"), core::InputError);
  };
  const auto repeated = [](const std::string& part, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += part;
    return text;
  };
  refused("a: " + repeated("[", 100'000));
  refused("a: " + repeated("{b: ", 100'000));
  refused(repeated("- ", 100'000));
  refused(repeated("? ", 100'000));
  std::string indented;
  for (int i = 0; i < 300; ++i) indented += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  refused(indented);
  std::string keys = "schema: dualdamp/1\n";
  for (int i = 0; i < 50'000; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  refused(keys);
  refused("schema: dualdamp/1\nanalysis: {type: xy_curve, amplitudes: [" + repeated("1 m, ", 150'000) + "]}\n");
  refused("a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\n");
  refused("title: \"" + repeated("a", 500'000) + "\n");
}
