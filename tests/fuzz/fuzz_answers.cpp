/// Answers of a program to an exported stress test, and its key: the two parts of the input stand before and after
/// the first zero byte; without one the input is the answers, to a key of nine cases.

#include <string>
#include <string_view>

#include "bench/contest/answers.hpp"
#include "bench/contest/key.hpp"
#include "core/diagnostics.hpp"
#include "tests/fuzz/harness.hpp"

using namespace dualdamp;

void dualdamp::fuzz::consume(std::string_view input) {
  try {
    bench::Key key = bench::make_key("scenario", 1, 9);
    if (const auto zero = input.find('\0'); zero != std::string_view::npos) {
      key = bench::read_key(written("key.json", input.substr(zero + 1)));
      input = input.substr(0, zero);
    }
    const bench::Entry entry = bench::read_entry("program", written("answers.csv", input), key);
    require(entry.answers.size() == key.numbers.size(), "every case has its answer");
    for (const bench::CaseAnswer& answer : entry.answers) {
      const bench::Mark mark = bench::mark_of(answer, {.zeta = 0.1, .F0 = 2.0});
      require(mark.loss >= 0.0F && mark.loss <= 1.0F, "a loss lies between 0 and 1");
    }
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
  }
}
