#include "cli/startup.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>

#include "cli/guarded.hpp"
#include "cli/isolation.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

namespace {

/// Bytes of stack; less than a quarter of it is used.
constexpr std::size_t frame = std::size_t{1} << 20U;

/// Bytes of stack with which every command has been run. Threads get as much as the main one.
constexpr std::size_t least_stack = std::size_t{256} << 10U;

void say_plainly(const char* text) noexcept {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) {
    // There is no way left to report the failure.
  }
}

[[noreturn]] void end_unhandled() noexcept {
  int status = static_cast<int>(core::ExitStatus::internal_bug);
  try {
    if (const std::exception_ptr fault = std::current_exception()) std::rethrow_exception(fault);
    say_plainly("error: this is a bug of dualdamp: std::terminate was called\n");
  } catch (const std::bad_alloc&) {
    status = say_out_of_memory();
  } catch (const std::exception& error) {
    say_plainly("error: this is a bug of dualdamp: ");
    say_plainly(error.what());
    say_plainly("\n");
  } catch (...) {
    say_plainly("error: this is a bug of dualdamp: an exception that nothing handles\n");
  }
  announce_end(status);
  ::_exit(status);
}

/// Grows the stack by the size of its frame, without memory for the pages in between.
[[gnu::noinline]] void touch_end_of_frame() noexcept {
  std::array<volatile char, frame>
      space;  // NOLINT(cppcoreguidelines-pro-type-member-init): to be filled is not its purpose
  space.front() = 0;
}

}  // namespace

void hold_stack() noexcept {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0) return;
  if (limit.rlim_cur < least_stack) {
    say_plainly(
        "error: the stack is limited to less than 256 kB: raise the limit, for example by ulimit -s 8192\n");
    ::_exit(static_cast<int>(core::ExitStatus::usage));
  }
  // With a smaller stack the frame would be the fault that it prevents.
  if (limit.rlim_cur < 4 * frame) return;
  void* room = ::mmap(nullptr, frame, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) ::_exit(say_out_of_memory());
  (void)::munmap(room, frame);
  touch_end_of_frame();
}

void hold_closed_streams() noexcept {
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
    // The lowest free number is taken. A path without access can be neither read nor written.
    if (::fcntl(number, F_GETFD) < 0 && errno == EBADF && ::open("/", O_PATH) < 0) return;
}

void end_with_a_message() noexcept { std::set_terminate(end_unhandled); }

int say_out_of_memory() noexcept {
  say_plainly("error: ");
  say_plainly(message_of_no_memory);
  say_plainly("\n");
  return static_cast<int>(core::ExitStatus::usage);
}

}  // namespace dualdamp::cli
