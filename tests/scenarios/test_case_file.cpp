#include "scenarios/results/case_file.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/diagnostics.hpp"

using dualdamp::scenarios::CaseFile;
namespace fs = std::filesystem;

namespace {

/// A directory of its own that is gone at the end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("dualdamp-cases-" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

std::string line(std::size_t number) {
  return "{\"case\":" + std::to_string(number) + ",\"value\":" + std::to_string(7 * number) + "}";
}

std::string text(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream all;
  all << file.rdbuf();
  return all.str();
}

std::string whole(std::size_t cases) {
  std::string result = "{\"campaign\":\"abc\",\"cases\":" + std::to_string(cases) + "}\n";
  for (std::size_t i = 0; i < cases; ++i) result += line(i) + "\n";
  return result;
}

}  // namespace

TEST_CASE("case file: lines of any order and any process end up in order") {
  const Folder folder;
  CaseFile first(folder.path, "cases", "abc", 5, 0);
  first.begin();
  {
    CaseFile second(folder.path, "cases", "abc", 5, 1);
    second.begin();
    second.add(3, line(3));
    second.add(0, line(0));
  }
  first.add(4, line(4));
  first.add(1, line(1));
  first.add(2, line(2));
  first.finish();
  CHECK(text(first.path()) == whole(5));
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("case file: wherever it is cut, whole lines are kept and the rest is done again") {
  const Folder folder;
  const std::string all = whole(4);
  for (std::size_t cut = 0; cut <= all.size(); ++cut) {
    CAPTURE(cut);
    fs::remove_all(folder.path);
    fs::create_directories(folder.path);
    std::ofstream(folder.path / "cases.jsonl") << all.substr(0, cut);
    CaseFile file(folder.path, "cases", "abc", 4);
    file.resume();
    const std::string kept = all.substr(0, cut);
    const auto lines = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), '\n'));
    CHECK(file.finished() == (lines == 0 ? 0 : lines - 1));
    for (std::size_t i = 0; i < 4; ++i)
      if (!file.is_finished(i)) file.add(i, line(i));
    file.finish();
    CHECK(text(file.path()) == all);
  }
}

TEST_CASE("case file: the cases of another campaign are refused and left alone") {
  const Folder folder;
  fs::create_directories(folder.path);
  std::ofstream(folder.path / "cases.jsonl") << whole(4);
  CaseFile file(folder.path, "cases", "abd", 4);
  CHECK_THROWS_AS(file.resume(), dualdamp::core::InputError);
  CHECK(text(folder.path / "cases.jsonl") == whole(4));
}
