#include "bench/crosscheck/children.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <system_error>

namespace dualdamp::crosscheck {

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, CloseFile>;

constexpr int failed_work = 99;

struct Child {
  std::uint32_t index = 0;
  TemporaryFile answer;  ///< shared with the child; a pipe could fill up
};

void limit_this_process(const Limits& limits) {
  const auto set = [](auto resource, rlim_t soft) {
    const rlimit limit = {soft, soft == RLIM_INFINITY ? soft : soft + 1};
    ::setrlimit(resource, &limit);
  };
  set(RLIMIT_CPU, static_cast<rlim_t>(limits.processor_seconds));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers reserve terabytes of addresses
  set(RLIMIT_AS, static_cast<rlim_t>(limits.memory));
#endif
  const rlimit none = {0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::alarm(static_cast<unsigned>(limits.wall_seconds));
  // Default handlers, in place of those of a test program, so that a signal ends this process.
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTERM, SIGXCPU})
    std::signal(signal, SIG_DFL);
}

[[noreturn]] void be_child(std::uint32_t index, std::FILE* answer, const Limits& limits,
                           const std::function<std::string(std::uint32_t)>& work) {
  limit_this_process(limits);
  int status = 0;
  std::string text;
  try {
    text = work(index);
  } catch (const std::exception& error) {
    text = error.what();
    status = failed_work;
  }
  std::fwrite(text.data(), 1, text.size(), answer);
  std::fflush(answer);
  ::_exit(status);
}

std::string content(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

Ending ending_of(const Child& child, int status, const rusage& usage, const Limits& limits) {
  constexpr double micro = 1e-6;
  Ending ending{.index = child.index};
  ending.seconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                   micro * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGKILL)
      ending.failure = "more than " + std::to_string(limits.processor_seconds) + " s of processor time";
    else if (signal == SIGALRM)
      ending.failure = "more than " + std::to_string(limits.wall_seconds) + " s";
    else
      ending.failure = "killed by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
  } else if (WEXITSTATUS(status) == failed_work) {
    ending.failure = "exception: " + content(child.answer.get());
  } else {
    ending.text = content(child.answer.get());
  }
  return ending;
}

}  // namespace

void run_in_children(std::uint32_t first, std::uint32_t count, const Limits& limits,
                     const std::function<std::string(std::uint32_t)>& work,
                     const std::function<void(const Ending&)>& done) {
  std::map<pid_t, Child> children;
  std::uint32_t next = 0;
  std::fflush(nullptr);
  while (next < count || !children.empty()) {
    while (next < count && children.size() < static_cast<std::size_t>(limits.jobs)) {
      Child child{first + next++, TemporaryFile(std::tmpfile())};
      if (!child.answer) throw std::system_error(errno, std::generic_category(), "temporary file");
      const pid_t pid = ::fork();
      if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
      if (pid == 0) be_child(child.index, child.answer.get(), limits, work);
      children.emplace(pid, std::move(child));
    }
    int status = 0;
    rusage usage{};
    const pid_t pid = ::wait4(-1, &status, 0, &usage);
    if (pid < 0 && errno == EINTR) continue;
    const auto child = children.find(pid);
    if (child == children.end()) continue;
    done(ending_of(child->second, status, usage, limits));
    children.erase(child);
  }
}

}  // namespace dualdamp::crosscheck
