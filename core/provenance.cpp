#include "core/provenance.hpp"

#include <openssl/evp.h>

#include <array>
#include <chrono>
#include <ctime>
#include <stdexcept>

#include "core/build_info.hpp"
#include "core/numbers.hpp"

namespace dualdamp::core {

namespace {

void expect(bool works) {
  if (!works) throw std::runtime_error("the SHA-256 of OpenSSL is not available");
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  expect(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

void Sha256::add(std::string_view bytes) {
  expect(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256::text() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  expect(EVP_DigestFinal_ex(context_.get(), digest.data(), &length) == 1);
  static constexpr std::string_view hexadecimal = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += hexadecimal[digest.at(i) >> 4U];
    text += hexadecimal[digest.at(i) & 0xFU];
  }
  return text;
}

std::string sha256(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.text();
}

const std::vector<Library>& libraries() {
  static const std::vector<Library> table = [] {
    std::vector<Library> result;
    // "Boost 1.74.0;Eigen 3.4.0": written by CMake, which knows what it has found.
    std::string_view rest = DUALDAMP_LIBRARIES;
    while (!rest.empty()) {
      const std::string_view item = rest.substr(0, rest.find(';'));
      const std::size_t space = item.find(' ');
      result.push_back({std::string(item.substr(0, space)),
                        space == std::string_view::npos ? "" : std::string(item.substr(space + 1))});
      rest.remove_prefix(std::min(rest.size(), item.size() + 1));
    }
    return result;
  }();
  return table;
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> buffer{};
  return {buffer.data(), std::strftime(buffer.data(), buffer.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

std::vector<std::pair<std::string, std::string>> lines(const Provenance& provenance) {
  const BuildInfo build = build_info();
  std::vector<std::pair<std::string, std::string>> result = {
      {"program", "dualdamp " + std::string(build.version)},
      {"commit", std::string(build.commit)},
      {"compiler", std::string(build.compiler)},
      {"build_type", std::string(build.build_type)},
  };
  std::string versions;
  for (const Library& library : libraries())
    versions += (versions.empty() ? "" : ", ") + library.name + " " + library.version;
  result.emplace_back("libraries", versions);
  for (const Plugin& plugin : provenance.plugins)
    result.emplace_back("plugin",
                        plugin.law + " " + plugin.version + ", " + plugin.file + ", sha256 " + plugin.sha256);
  result.emplace_back("source", provenance.source);
  result.emplace_back("source_sha256", provenance.source_sha256);
  for (const std::string& text : provenance.overrides) result.emplace_back("set", text);
  for (const std::string& sum : provenance.data_sha256) result.emplace_back("data_sha256", sum);
  result.emplace_back("scenario", provenance.scenario);
  result.emplace_back("scenario_sha256", provenance.scenario_sha256);
  result.emplace_back("tolerance", format_number(provenance.tolerance));
  result.emplace_back("started", provenance.started);
  result.emplace_back("duration", format_number(provenance.duration, 6) + " s");
  return result;
}

}  // namespace dualdamp::core
