#include "identify/readers/isolated.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "identify/readers/formats/mat_content.hpp"

using namespace dualdamp::identify;
using namespace std::chrono_literals;

namespace {

constexpr IsolationLimits limits{1s, 4s, std::size_t{256} << 20U};

IsolatedResult run(const std::function<void(const ByteSink&)>& work) { return run_isolated(limits, work); }

}  // namespace

TEST_CASE("What the child writes comes back, whatever its size") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{5'000'000}}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i % 251);
    const IsolatedResult result = run([&](const ByteSink& sink) {
      sink(bytes);
      sink({"end", 3});
    });
    CHECK(result.end == IsolatedEnd::done);
    CHECK(result.bytes == bytes + "end");
  }
}

TEST_CASE("A child that crashes is told from one that is done") {
  CHECK(run([](const ByteSink&) { std::abort(); }).end == IsolatedEnd::crashed);
  CHECK(run([](const ByteSink&) { ::raise(SIGSEGV); }).end == IsolatedEnd::crashed);
  CHECK(run([](const ByteSink&) { throw std::runtime_error("no"); }).end == IsolatedEnd::crashed);
  const IsolatedResult half = run([](const ByteSink& sink) {
    sink({"half", 4});
    ::raise(SIGKILL);
  });
  CHECK(half.end == IsolatedEnd::crashed);
  CHECK(half.bytes.empty());
  // A library that leaves the program as if all were well.
  CHECK(run([](const ByteSink&) { ::_exit(0); }).end == IsolatedEnd::crashed);
}

TEST_CASE("A child that comes to no end is ended, busy or asleep") {
  const auto begin = std::chrono::steady_clock::now();
  const IsolatedResult busy = run([](const ByteSink&) {
    while (std::clock() >= 0) {
    }
  });
  CHECK(busy.end == IsolatedEnd::out_of_time);
  CHECK(run_isolated({60s, 1s, limits.memory}, [](const ByteSink&) { std::this_thread::sleep_for(100s); }).end ==
        IsolatedEnd::out_of_time);
  // A second of the processor's time, four of the wall clock at most; then one of the wall clock.
  CHECK(std::chrono::steady_clock::now() - begin < 10s);
}

TEST_CASE("Children of several threads do not wait for each other") {
  // Each takes 40 ms and has a second. A child that held the pipes of others would make them wait for its end, and
  // those of its neighbours for theirs.
  constexpr int threads = 8;
  constexpr int each = 12;
  std::atomic<int> done{0};
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < threads; ++i)
      callers.emplace_back([&done, i] {
        for (int j = 0; j < each; ++j) {
          const auto pause = i == 0 && j == 0 ? 1500ms : 40ms;  // one is slow: it alone runs out of time
          const IsolatedResult result = run_isolated({60s, 1s, limits.memory}, [pause](const ByteSink& sink) {
            std::this_thread::sleep_for(pause);
            sink({"end", 3});
          });
          if (result.end == IsolatedEnd::done) ++done;
        }
      });
  }
  CHECK(done == threads * each - 1);
}

TEST_CASE("A child keeps no file of the caller open") {
  std::array<int, 2> ends{};
  REQUIRE(::pipe(ends.data()) == 0);
  const IsolatedResult result = run([&](const ByteSink& sink) {
    const bool closed = ::fcntl(ends[0], F_GETFD) < 0 && ::fcntl(ends[1], F_GETFD) < 0;
    sink({closed ? "closed" : "opened", 6});
  });
  CHECK(result.bytes == "closed");
  ::close(ends[0]);
  ::close(ends[1]);
}

#ifndef __SANITIZE_ADDRESS__
TEST_CASE("A child that asks for all memory is told so") {
  const IsolatedResult result = run([](const ByteSink& sink) {
    std::vector<std::string> all;
    for (std::size_t size = 0; size < 1000; ++size) all.emplace_back(std::size_t{1} << 20U, 'x');
    sink(all.back());
  });
  CHECK(result.end == IsolatedEnd::out_of_memory);
}
#endif

TEST_CASE("Nothing but the bytes comes back") {
  int value = 1;
  const IsolatedResult result = run([&](const ByteSink&) { value = 2; });
  CHECK(result.end == IsolatedEnd::done);
  CHECK(value == 1);
}

namespace {

MatContent two_tests() {
  std::vector<double> values(3);
  std::iota(values.begin(), values.end(), 0.5);
  MatContent content;
  for (const char* label : {"a", "b"})
    content.tests.push_back({label, {{known_column("t"), values}, {known_column("x"), values}}});
  content.row_labels = {{"one", 0}, {"two", 4}};
  content.warnings = {"a warning"};
  content.ignored = {"one about a field"};
  return content;
}

template <typename Sent>
std::string bytes_sent(const Sent& sent) {
  std::string bytes;
  send(sent, [&bytes](std::span<const char> more) { bytes.append(more.data(), more.size()); });
  return bytes;
}

}  // namespace

TEST_CASE("Content that went over a pipe is what was sent") {
  const auto back = receive(bytes_sent(two_tests()));
  REQUIRE(back.has_value());
  REQUIRE(back->tests.size() == 2);
  CHECK(back->tests[1].label == "b");
  CHECK(back->tests[1].columns.at(1).known == known_column("x"));
  CHECK(back->tests[1].columns.at(1).values == std::vector{0.5, 1.5, 2.5});
  CHECK(back->row_labels.value().at(1).label == "two");
  CHECK(back->row_labels.value().at(1).first_row == 4);
  CHECK(back->warnings == std::vector<std::string>{"a warning"});
  CHECK(back->ignored == std::vector<std::string>{"one about a field"});

  dualdamp::core::Diagnostic problem;
  problem.message = "bad";
  problem.found = "this";
  try {
    (void)receive(bytes_sent(std::vector{problem}));
    FAIL("problems were taken for content");
  } catch (const dualdamp::core::InputError& error) {
    CHECK(error.diagnostics().at(0).message == "bad");
    CHECK(error.diagnostics().at(0).found == "this");
  }
}

TEST_CASE("Content of a sender gone astray is refused") {
  const std::string whole = bytes_sent(two_tests());
  for (std::size_t size = 0; size < whole.size(); ++size) CHECK_FALSE(receive(whole.substr(0, size)).has_value());
  CHECK_FALSE(receive(whole + "x").has_value());
  MatContent ragged = two_tests();
  ragged.tests[0].columns[1].values.push_back(1.0);
  CHECK_FALSE(receive(bytes_sent(ragged)).has_value());
  MatContent empty = two_tests();  // a list without room has no address, which undefined behaviour begins with
  for (DataColumn& column : empty.tests[0].columns) column.values.clear();
  CHECK_FALSE(receive(bytes_sent(empty)).has_value());
  MatContent beyond = two_tests();
  beyond.row_labels->back().first_row = 6;
  CHECK_FALSE(receive(bytes_sent(beyond)).has_value());
  // Lengths of any size, wherever they stand: refused or read, and never more memory than the bytes can fill.
  for (std::size_t at = 0; at + 8 <= whole.size(); at += 4) {
    std::string wild = whole;
    for (std::size_t i = 0; i < 8; ++i) wild[at + i] = static_cast<char>(i == 7 ? 0x7F : 0xFF);
    try {
      (void)receive(wild);
    } catch (const dualdamp::core::InputError&) {
      FAIL("content was taken for problems");
    }
  }
}
