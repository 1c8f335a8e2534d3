#include "bench/contest/answers.hpp"

#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

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
