#include "core/input_file.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <system_error>

#include "core/diagnostics.hpp"

using namespace dualdamp::core;

TEST_CASE("input file: a wrong name is a fault of the input, what the system refuses is none") {
  for (const int error : {ENOENT, ENOTDIR, EISDIR, ELOOP, ENAMETOOLONG}) {
    CAPTURE(error);
    CHECK(is_fault_of_name(error));
    CHECK_THROWS_AS(fail_to_read("a.csv", "cannot be opened", error), InputError);
  }
  for (const int error : {EMFILE, ENFILE, ENOMEM, EIO, EACCES, EPERM}) {
    CAPTURE(error);
    CHECK_FALSE(is_fault_of_name(error));
    CHECK_THROWS_AS(fail_to_read("a.csv", "cannot be opened", error), std::system_error);
  }
  CHECK_THROWS_WITH(fail_to_read("a.csv", "cannot be opened", EMFILE),
                    Catch::Equals("a.csv: cannot be opened: Too many open files"));
  CHECK_THROWS_WITH(fail_to_read("a.csv", "cannot be read", ENOENT),
                    Catch::Contains("cannot be read: No such file or directory"));
}
