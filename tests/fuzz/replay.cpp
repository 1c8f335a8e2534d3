/// Runs a harness over files and simple mutations of them, without libFuzzer.
///
/// usage: replay_NAME [-runs=N] [-seed=N] [-seconds=N] [-dict=FILE] [-crash=FILE] FILE|DIRECTORY...
///
/// Every file is run as it is, then N mutants: bytes changed, cut, doubled, words of the dictionary put in, parts
/// of other files joined. An input under which an exception escapes is written to FILE.1, FILE.2, ... (default
/// crash-input), one for each text of an exception, and the run goes on to end with status 1. The input under which
/// the process ends, by a signal or after 5 s of processor time, is written to FILE.

#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/harness.hpp"

namespace {

constexpr int most_seconds = 5;
constexpr std::size_t longest = 1U << 20U;

std::string current;                     // NOLINT(*-avoid-non-const-global-variables): for the signal handler
std::string crash_file = "crash-input";  // NOLINT(*-avoid-non-const-global-variables)

extern "C" void keep_input(int number) {
  const int file = ::open(crash_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && ::write(file, current.data(), current.size()) >= 0) ::close(file);
  constexpr std::string_view text = "ended by a signal or out of time; the input is kept\n";
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) ::_exit(71);
  std::signal(number, SIG_DFL);
  ::raise(number);
}

std::set<std::string> escaped;  // NOLINT(*-avoid-non-const-global-variables)

/// A message without its digits: one fault may name other numbers and lines each time.
std::string without_digits(std::string text) {
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text.substr(0, 120);
}

void run(std::string input) {
  current = std::move(input);
  const itimerval limit{{0, 0}, {most_seconds, 0}};
  ::setitimer(ITIMER_PROF, &limit, nullptr);
  try {
    dualdamp::fuzz::consume(current);
  } catch (const std::exception& error) {
    if (!escaped.insert(without_digits(error.what())).second) return;
    const std::string path = crash_file + "." + std::to_string(escaped.size());
    std::ofstream(path, std::ios::binary) << current;
    std::fprintf(stderr, "%s: %s\n", path.c_str(), error.what());
  }
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The quoted words of a dictionary, with \xNN, \\ and \".
std::vector<std::string> words_of(const std::string& path) {
  std::vector<std::string> words;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t begin = line.find('"');
    const std::size_t end = line.rfind('"');
    if (line.starts_with('#') || begin == end) continue;
    std::string word;
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (line[i] == '\\' && i + 3 < end && line[i + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      } else {
        if (line[i] == '\\') ++i;
        word += line[i];
      }
    }
    words.push_back(word);
  }
  return words;
}

class Mutator {
 public:
  Mutator(std::vector<std::string> files, std::vector<std::string> words, std::uint64_t seed)
      : files_(std::move(files)), words_(std::move(words)), random_(seed) {}

  std::string mutant() {
    std::string text = files_.empty() ? std::string() : files_[below(files_.size())];
    for (std::size_t left = 1U << below(4); left > 0; --left) mutate(text);
    if (text.size() > longest) text.resize(longest);
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(random_() % end); }

  void mutate(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    switch (below(7)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, std::size_t{1} << below(10));
        break;
      case 3:
        text.insert(at, text.substr(at, std::size_t{1} << below(8)));
        break;
      case 4: {
        const std::string& other = files_[below(files_.size())];
        text.replace(at, std::size_t{1} << below(8),
                     other.substr(below(other.size() + 1), std::size_t{1} << below(8)));
        break;
      }
      case 5:
        if (at < text.size() && text[at] >= '0' && text[at] <= '9') text[at] = static_cast<char>('0' + below(10));
        break;
      default:
        if (!words_.empty()) text.replace(at, below(2) * below(6), words_[below(words_.size())]);
    }
  }

  std::vector<std::string> files_;
  std::vector<std::string> words_;
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t runs = 0;
  std::uint64_t seed = 1;
  double seconds = 1e9;
  std::vector<std::string> files;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word.starts_with("-runs="))
      runs = std::strtoull(argv[i] + 6, nullptr, 10);
    else if (word.starts_with("-seed="))
      seed = std::strtoull(argv[i] + 6, nullptr, 10);
    else if (word.starts_with("-seconds="))
      seconds = std::atof(argv[i] + 9);
    else if (word.starts_with("-crash="))
      crash_file = word.substr(7);
    else if (word.starts_with("-dict="))
      words = words_of(argv[i] + 6);
    else if (std::filesystem::is_directory(word)) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(word))
        if (entry.is_regular_file()) files.push_back(content_of(entry.path()));
    } else
      files.push_back(content_of(word));
  }
  if (files.empty()) {
    std::fprintf(stderr, "no file to begin with\n");
    return 2;
  }
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGPROF}) std::signal(number, keep_input);
  std::ranges::sort(files);
  for (const std::string& file : files) run(file);
  Mutator mutator(files, std::move(words), seed);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::uint64_t done = 0;
  for (; done < runs && elapsed() < seconds; ++done) run(mutator.mutant());
  std::printf("%zu files and %llu mutants in %.1f s\n", files.size(), static_cast<unsigned long long>(done),
              elapsed());
  return escaped.empty() ? 0 : 1;
}
