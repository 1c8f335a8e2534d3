#include "bench/contest/key.hpp"

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "core/diagnostics.hpp"
#include "tests/support/written_files.hpp"

using namespace dualdamp;
namespace fs = std::filesystem;

TEST_CASE("key: each case once, in an order that the seed decides") {
  const bench::Key key = bench::make_key("abc", 5, 1000);
  std::vector<std::size_t> sorted = key.numbers;
  std::ranges::sort(sorted);
  std::vector<std::size_t> all(1000);
  std::iota(all.begin(), all.end(), std::size_t{0});
  CHECK(sorted == all);
  CHECK(bench::make_key("abc", 5, 1000).numbers == key.numbers);
  CHECK(bench::make_key("abc", 6, 1000).numbers != key.numbers);
  // Neighbours are independent: of 999 pairs about two stay together.
  int together = 0;
  for (std::size_t i = 1; i < key.numbers.size(); ++i) together += key.numbers[i] == key.numbers[i - 1] + 1 ? 1 : 0;
  CHECK(together < 10);
}

TEST_CASE("key: reads back as it was written, and refuses anything else") {
  const fs::path folder = fs::temp_directory_path() / ("dualdamp-key-" + std::to_string(::getpid()));
  const bench::Key key = bench::make_key("abc", 9007199254740991, 7);
  testing::write_files(folder, {bench::key_file(key)});
  const bench::Key back = bench::read_key(folder / "key.json");
  CHECK(back.scenario == "abc");
  CHECK(back.seed == key.seed);
  CHECK(back.numbers == key.numbers);
  for (const char* text :
       {"", "{}", "[1]", R"({"scenario":"a","seed":1,"numbers":[0,0]})",
        R"({"scenario":"a","seed":1,"numbers":[1,2]})", R"({"scenario":"a","seed":"x","numbers":[0]})",
        R"({"scenario":"a","seed":1.5,"numbers":[0]})", R"({"scenario":"a","seed":1e300,"numbers":[0]})",
        R"({"scenario":"a","seed":1,"numbers":[0.5]})", R"({"scenario":"a","seed":1,"numbers":[8,1e126]})",
        R"({"scenario":"a","seed":1,"numbers":[false]})", R"({"scenario":"a","seed":1,"numbers":3})"}) {
    std::ofstream(folder / "bad.json") << text;
    CHECK_THROWS_AS(bench::read_key(folder / "bad.json"), core::InputError);
  }
  fs::remove_all(folder);
}
