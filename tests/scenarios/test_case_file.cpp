#include "scenarios/results/case_file.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/results/files.hpp"

using dualdamp::scenarios::CaseFile;
using dualdamp::scenarios::EarlierFiles;
using dualdamp::scenarios::FoundCases;
namespace fs = std::filesystem;

namespace {

/// A directory that is deleted at the end.
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
  for (std::size_t i = 0; i < cases; ++i) result += dualdamp::scenarios::checked_line(line(i)) + "\n";
  return result;
}

void begin(CaseFile& file) {
  file.prepare(FoundCases::refuse);
  file.open();
}

void resume(CaseFile& file) {
  file.prepare(FoundCases::resume);
  file.open();
}

}  // namespace

TEST_CASE("case file: lines of any order and any process end up in order") {
  const Folder folder;
  CaseFile first(folder.path, "cases", "abc", 5, 0);
  begin(first);
  {
    CaseFile second(folder.path, "cases", "abc", 5, 1);
    second.open();
    second.add(line(3));
    second.add(line(0));
  }
  for (const std::size_t number : {4, 1, 2}) first.add(line(number));
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
    resume(file);
    const std::string kept = all.substr(0, cut);
    const auto lines = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), '\n'));
    CHECK(file.finished() == (lines == 0 ? 0 : lines - 1));
    for (std::size_t i = 0; i < 4; ++i)
      if (!file.is_finished(i)) file.add(line(i));
    file.finish();
    CHECK(text(file.path()) == all);
  }
}

TEST_CASE("case file: the check of a line is the beginning of a SHA-256") {
  // printf '{"case":3,"value":21' | sha256sum
  CHECK(dualdamp::scenarios::checked_line(line(3)) == "{\"case\":3,\"value\":21,\"check\":\"ae9b8c508e05f113\"}");
}

TEST_CASE("case file: a case is done again if any byte of its line was changed") {
  const Folder folder;
  const std::string all = whole(4);
  const std::size_t begin = all.find("{\"case\":1");
  const std::size_t end = all.find("{\"case\":2");
  for (std::size_t place = begin; place < end; ++place)
    for (const char other : {'7', '\n'}) {
      if (all[place] == other) continue;
      CAPTURE(place - begin, other);
      std::string changed = all;
      changed[place] = other;
      fs::remove_all(folder.path);
      fs::create_directories(folder.path);
      std::ofstream(folder.path / "cases.jsonl") << changed;
      CaseFile file(folder.path, "cases", "abc", 4);
      resume(file);
      CHECK_FALSE(file.is_finished(1));
      CHECK(file.is_finished(0));
      CHECK(file.is_finished(2) == (place + 1 < end));  // without its end, the line goes on with the next one
      CHECK(file.is_finished(3));
      CHECK_THAT(file.damage(), Catch::Contains("cases.jsonl:3: "));
      for (std::size_t i = 0; i < 4; ++i)
        if (!file.is_finished(i)) file.add(line(i));
      file.finish();
      REQUIRE(text(file.path()) == all);
      CaseFile again(folder.path, "cases", "abc", 4);
      resume(again);
      CHECK(again.finished() == 4);
      CHECK(again.damage().empty());
    }
}

TEST_CASE("case file: damaged lines in the part of a process that has gone") {
  const Folder folder;
  fs::create_directories(folder.path);
  const std::string head = "{\"campaign\":\"abc\",\"cases\":4}\n";
  const auto sound = [](std::size_t number) { return dualdamp::scenarios::checked_line(line(number)) + "\n"; };
  std::string changed = sound(2);
  changed[changed.find("14")] = '2';
  std::ofstream(folder.path / "cases.jsonl") << head << sound(0);
  std::ofstream(folder.path / "cases.3.jsonl") << head << changed << sound(3) << line(1) << "\n"
                                               << std::string(300'000, 'x') << "\n";
  CaseFile file(folder.path, "cases", "abc", 4);
  resume(file);
  CHECK_THAT(file.damage(), Catch::Contains("cases.3.jsonl:2: 3 lines"));
  CHECK(file.finished() == 2);
  file.add(line(1));
  file.add(line(2));
  file.finish();
  CHECK(text(file.path()) == whole(4));
}

TEST_CASE("case file: the cases of another campaign are refused and left alone") {
  const Folder folder;
  fs::create_directories(folder.path);
  std::ofstream(folder.path / "cases.jsonl") << whole(4);
  CaseFile file(folder.path, "cases", "abd", 4);
  CHECK_THROWS_AS(resume(file), dualdamp::core::InputError);
  CHECK(text(folder.path / "cases.jsonl") == whole(4));
}

TEST_CASE("case file: hundreds of parts are gathered with few files open") {
  const Folder folder;
  constexpr int parts = 200;
  constexpr std::size_t cases = 3 * parts;
  CaseFile first(folder.path, "cases", "abc", cases, 0);
  begin(first);
  for (int part = 1; part <= parts; ++part) {
    CaseFile other(folder.path, "cases", "abc", cases, part);
    other.open();
    // Neighbours are in different parts.
    for (std::size_t i = static_cast<std::size_t>(part) - 1; i < cases; i += parts) other.add(line(i));
  }
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  const rlimit few{24, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &few) == 0);
  first.finish();
  ::setrlimit(RLIMIT_NOFILE, &before);
  CHECK(text(first.path()) == whole(cases));
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("case file: missing cases, and files that cannot be opened, are errors") {
  const Folder folder;
  CaseFile file(folder.path, "cases", "abc", 3);
  begin(file);
  file.add(line(0));
  file.add(line(2));
  CHECK_THROWS_WITH(file.finish(), Catch::Contains("1 cases are missing, first 1"));
  file.add(line(1));
  fs::create_directory(folder.path / "cases.1.jsonl");  // a directory instead of a file
  CHECK_THROWS_AS(file.finish(), dualdamp::core::InputError);
  fs::remove(folder.path / "cases.1.jsonl");
  file.finish();
  CHECK(text(file.path()) == whole(3));
}

namespace {

/// An error that says this and allows to go on with the cases or not.
auto earlier(const std::string& words, bool may_resume) {
  return Catch::Predicate<EarlierFiles>([=](const EarlierFiles& error) {
    return std::string(error.what()).find(words) != std::string::npos && error.may_resume() == may_resume;
  });
}

}  // namespace

TEST_CASE("case file: finished cases are lost only on demand") {
  const Folder folder;
  fs::create_directories(folder.path);
  std::ofstream(folder.path / "cases.jsonl") << whole(4);
  {  // of another campaign
    CaseFile file(folder.path, "cases", "abd", 4);
    CHECK_THROWS_MATCHES(begin(file), EarlierFiles, earlier("4 finished cases of another campaign", false));
    CHECK(text(file.path()) == whole(4));
  }
  {  // of this one, complete
    CaseFile file(folder.path, "cases", "abc", 4);
    begin(file);
    CHECK(file.finished() == 4);
    file.finish();
    CHECK(text(file.path()) == whole(4));
  }
  {  // of this one, interrupted
    std::ofstream(folder.path / "cases.jsonl") << "{\"campaign\":\"abc\",\"cases\":4}\n"
                                               << dualdamp::scenarios::checked_line(line(1)) << "\n";
    CaseFile file(folder.path, "cases", "abc", 4);
    CHECK_THROWS_MATCHES(begin(file), EarlierFiles, earlier("1 finished cases of this campaign", true));
  }
  CaseFile file(folder.path, "cases", "abd", 4);
  file.prepare(FoundCases::overwrite);
  file.open();
  CHECK(file.finished() == 0);
}

TEST_CASE("case file: two runs never write to one file") {
  const Folder folder;
  CaseFile first(folder.path, "cases", "abc", 2);
  begin(first);
  first.add(line(1));
  for (const FoundCases found : {FoundCases::refuse, FoundCases::resume, FoundCases::overwrite}) {
    CaseFile second(folder.path, "cases", "abc", 2);
    CHECK_THROWS_WITH(second.prepare(found), Catch::Contains("another process is writing it"));
  }
  first.add(line(0));
  first.finish();
  CHECK(text(first.path()) == whole(2));
  CaseFile third(folder.path, "cases", "abc", 2);
  resume(third);
  CHECK(third.finished() == 2);
}

TEST_CASE("case file: what is finished does not change while lines are added") {
  const Folder folder;
  CaseFile file(folder.path, "cases", "abc", 64);
  begin(file);
  // Threads read while others add, so that a thread checker finds a race.
  std::vector<std::jthread> threads;
  for (std::size_t thread = 0; thread < 4; ++thread)
    threads.emplace_back([&file, thread] {
      for (std::size_t i = thread; i < 64; i += 4)
        if (!file.is_finished(i)) file.add(line(i));
    });
  threads.clear();
  CHECK(file.finished() == 0);
  file.finish();
  CHECK(text(file.path()) == whole(64));
}
