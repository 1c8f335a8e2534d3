#include "bench/contest/key.hpp"

#include <algorithm>
#include <numeric>
#include <ostream>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/random.hpp"
#include "scenarios/format/json_text.hpp"

namespace dualdamp::bench {

namespace {

constexpr std::size_t most_key_bytes = std::size_t{1} << 26U;  // of eight million cases
constexpr std::uint32_t order_stream = 128;                    // away from the draws of sensors and laws

}  // namespace

Key make_key(std::string scenario, std::int64_t seed, std::size_t cases) {
  Key key{std::move(scenario), seed, std::vector<std::size_t>(cases)};
  std::iota(key.numbers.begin(), key.numbers.end(), std::size_t{0});
  const core::RandomStream draws{.seed = static_cast<std::uint64_t>(seed), .stream = order_stream};
  for (std::size_t i = cases; i > 1; --i) {
    const auto other = static_cast<std::size_t>(draws.uniform(i) * static_cast<double>(i));
    std::swap(key.numbers[i - 1], key.numbers[other]);
  }
  return key;
}

scenarios::OutputFile key_file(const Key& key) {
  nlohmann::ordered_json json = {{"scenario", key.scenario}, {"seed", key.seed}, {"numbers", key.numbers}};
  return {"key.json", [text = json.dump()](std::ostream& out) { out << text << "\n"; }};
}

Key read_key(const std::string& path) {
  using scenarios::Json;
  const Json json = scenarios::parse_json(scenarios::read_file(path, most_key_bytes), most_key_bytes);
  const auto refuse_content = [&] {
    core::refuse({.file = path}, "this is no key of a stress test", "key.json of 'dualdamp stress export'");
  };
  // The conversions would drop fractions, and are undefined for numbers beyond the type.
  const auto is_whole = [](const Json& value) { return value.is_number_integer(); };
  Key key;
  try {
    const Json& numbers = json.at("numbers");
    if (!is_whole(json.at("seed")) || !std::ranges::all_of(numbers, is_whole)) refuse_content();
    key.scenario = json.at("scenario").get<std::string>();
    key.seed = json.at("seed").get<std::int64_t>();
    key.numbers = numbers.get<std::vector<std::size_t>>();
  } catch (const Json::exception&) {
    refuse_content();
  }
  std::vector<bool> there(key.numbers.size(), false);
  for (const std::size_t number : key.numbers) {
    if (number >= there.size() || there[number])
      core::refuse({.file = path}, "the key does not name each case once");
    there[number] = true;
  }
  return key;
}

}  // namespace dualdamp::bench
