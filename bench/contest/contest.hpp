#pragma once
/// The stress test as a contest: programs outside answer exported records and are scored beside the methods.
///
///     const auto exported = contest_scenario(load, hidden_seed(), "seed");
///     export_cases(*stress_test_of(*exported.question), context, "export");
///     run(scored_scenario(load, "export/key.json", {{"mine", "answers.csv"}}));
///
/// Errors: `core::InputError`, also for a scenario that is no stress test.

#include <functional>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace dualdamp::bench {

/// Reads the scenario of the contest with these overrides, which act after all others.
using ContestLoader = std::function<scenarios::Scenario(const std::vector<scenarios::Override>& values)>;

/// A file of answers (`key.hpp`) and the name of its entry.
struct Answers {
  std::string name;
  std::string file;
};

/// A random seed of all noise, small enough for a double to hold exactly.
[[nodiscard]] std::string hidden_seed();

/// The stress test with this seed. Messages name `origin` as the source of the seed.
[[nodiscard]] scenarios::Scenario contest_scenario(const ContestLoader& load, const std::string& seed,
                                                   const std::string& origin);

/// The stress test with the seed of the key and with the answers as entries. Errors: also a key of another stress
/// test, a changed key, or two entrants with one name.
[[nodiscard]] scenarios::Scenario scored_scenario(const ContestLoader& load, const std::string& key_file,
                                                  const std::vector<Answers>& answers);

}  // namespace dualdamp::bench
