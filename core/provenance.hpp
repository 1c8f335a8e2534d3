#pragma once
/// Provenance: the origin of a file that the program writes: program, scenario, data and time. Every such file
/// opens with it.

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct evp_md_ctx_st;  // of OpenSSL

namespace dualdamp::core {

/// SHA-256 of `bytes` as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// The digest as 64 hexadecimal digits. Call it once, after the last piece.
  [[nodiscard]] std::string text();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// A library and its version, as found when the program was configured; sorted by name.
struct Library {
  std::string name;
  std::string version;
};

[[nodiscard]] const std::vector<Library>& libraries();

/// The present time as "2025-01-31T12:00:00Z".
[[nodiscard]] std::string utc_now();

/// A shared library whose friction law the program has loaded.
struct Plugin {
  std::string law;
  std::string version;  ///< of the law, as the library says
  std::string file;
  std::string sha256;  ///< of its bytes
};

/// The origin of a file beside the program itself (`core::build_info()`, `libraries()`).
struct Provenance {
  std::string source;                    ///< the scenario file as named by the user
  std::string source_sha256;             ///< of its bytes
  std::string scenario;                  ///< the resolved scenario as JSON on one line
  std::string scenario_sha256;           ///< of `scenario`
  std::vector<std::string> data_sha256;  ///< of the files with measured data
  std::vector<std::string> overrides;    ///< PATH=VALUE texts in order
  std::vector<Plugin> plugins;           ///< loaded, whether or not their laws are used
  double tolerance = 0.0;
  std::string started;    ///< UTC
  double duration = 0.0;  ///< s
};

/// Names and values in the order of printing, program and libraries first. The comment lines of a table and the
/// provenance block of a result are this list.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> lines(const Provenance& provenance);

}  // namespace dualdamp::core
