#include <catch2/catch.hpp>
#include <cstdlib>

#include "bench/processes.hpp"
#include "core/diagnostics.hpp"

using dualdamp::bench::Processes;

TEST_CASE("without MPI one process counts alone and waits for nobody") {
  Processes processes;
  CHECK(processes.rank() == 0);
  CHECK(processes.count() == 1);
  const auto items = processes.share_items();
  CHECK(items->next() == 0);
  CHECK(items->next() == 1);
  processes.wait();
  CHECK(processes.share_items()->next() == 0);  // each run counts from 0
  CHECK_FALSE(processes.first_failure(0).has_value());
  CHECK(processes.first_failure(3)->status == 3);
}

TEST_CASE("without MPI a process that mpirun started says what to install") {
  ::setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  CHECK(Processes::several());
  CHECK_THROWS_WITH(Processes(), Catch::Contains("built without MPI"));
  ::unsetenv("OMPI_COMM_WORLD_SIZE");
}
