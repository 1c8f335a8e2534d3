#include "bench/contest/answers.hpp"

#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/diagnostics.hpp"

using namespace dualdamp;
namespace fs = std::filesystem;

TEST_CASE("answers: usable is said in several words, in small or capital letters") {
  const fs::path path = fs::temp_directory_path() / ("dualdamp-usable-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(path) << "case,usable\n1,YES\n2,True\n3,1\n4,no\n5,FALSE\n6,\n";
  const bench::Key key = bench::make_key("abc", 1, 6);
  const bench::Entry entry = bench::read_entry("mine", path, key);
  using enum bench::CaseAnswer::Usable;
  const std::array<bench::CaseAnswer::Usable, 6> said = {yes, yes, yes, no, no, missing};
  for (std::size_t i = 0; i < said.size(); ++i) CHECK(entry.answers[key.numbers[i]].usable == said[i]);
  fs::remove(path);
}

TEST_CASE("answers: numbers are read as programs write them, and nothing else is") {
  const fs::path path = fs::temp_directory_path() / ("dualdamp-numbers-" + std::to_string(::getpid()) + ".csv");
  const bench::Key key = bench::make_key("abc", 1, 3);
  std::ofstream(path) << "case,zeta,F0\n000001,.1,+4\n\"2\",1e-2,NA\n";
  const bench::Entry entry = bench::read_entry("mine", path, key);
  CHECK(entry.answers[key.numbers[0]].zeta == 0.1);
  CHECK(entry.answers[key.numbers[0]].F0 == 4.0);
  CHECK(entry.answers[key.numbers[1]].zeta == 0.01);
  CHECK(std::isnan(entry.answers[key.numbers[1]].F0));
  for (const char* wrong : {"1,0x1,4", "1,+-1,4", "1,1 2,4", "1,inf,4", "1.5,1,4", "0,1,4", "1,1e999,4"}) {
    CAPTURE(wrong);
    std::ofstream(path) << "case,zeta,F0\n" << wrong << "\n";
    CHECK_THROWS_AS(bench::read_entry("mine", path, key), core::InputError);
  }
  fs::remove(path);
}
