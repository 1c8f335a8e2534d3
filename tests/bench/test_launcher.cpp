#include "bench/launcher.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

using dualdamp::bench::launch;

namespace {

constexpr std::array variables = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE", "SLURM_STEP_NUM_TASKS",
                                  "PMIX_RANK"};

/// An environment with this one variable only.
struct Environment {
  Environment(const char* name, const char* value) {
    for (const char* variable : variables) ::unsetenv(variable);
    ::setenv(name, value, 1);
  }
  ~Environment() {
    for (const char* variable : variables) ::unsetenv(variable);
  }
};

}  // namespace

TEST_CASE("launcher: several processes are told from one under each launcher") {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    CAPTURE(variable);
    {
      const Environment three(variable, "3");
      REQUIRE(launch().has_value());
      CHECK(launch()->processes == 3);
      CHECK(!std::string(launch()->launcher).empty());
    }
    const Environment one(variable, "1");
    CHECK_FALSE(launch().has_value());
  }
  const Environment unknown("PMIX_RANK", "0");
  REQUIRE(launch().has_value());
  CHECK(launch()->processes == 0);
}
