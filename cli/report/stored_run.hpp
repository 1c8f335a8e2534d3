#pragma once
/// Reads a result directory: result.json and the tables beside it.

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::cli {

struct StoredColumn {
  std::string name;
  std::string unit;             ///< empty: none
  std::vector<double> numbers;  ///< NaN: empty field, or no number
  std::vector<std::string> texts;
  bool is_text = false;
};

struct StoredTable {
  std::vector<StoredColumn> columns;

  /// nullptr if there is none.
  [[nodiscard]] const StoredColumn* find(std::string_view name) const;
};

/// Thrown if a result does not have the form that a run writes. `StoredRun::read` turns it into a
/// `core::InputError`.
class ChangedResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class StoredRun {
 public:
  using Json = nlohmann::ordered_json;

  /// Lists of the document are cut after 5000 items, or 100,000 numbers; the tables have all rows. `units`: units
  /// of the numbers that are shown (`--show-in`); they precede those that the user wrote. Errors:
  /// `core::InputError` if there is no result.json of this program; others as of `core::fail_to_read`.
  explicit StoredRun(const std::string& directory, const std::string& units = {});

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] const Json& document() const { return document_; }
  /// The tables of this run, sorted. Other tables in the directory are not included.
  [[nodiscard]] const std::vector<std::filesystem::path>& tables() const { return tables_; }
  /// The text of a table. Errors: `core::InputError` if the table was changed after the run.
  [[nodiscard]] std::string text_of(const std::filesystem::path& table) const;
  /// A table of this run; without columns if the run has no table of this name. Errors: as `text_of`.
  [[nodiscard]] StoredTable table(std::string_view name) const;
  /// Calls `work`, which reads the document. Errors: `core::InputError` if the document does not have the form that
  /// a run writes.
  void read(const std::function<void()>& work) const;
  /// A list of records of the result, such as fit.points, as a table. Units are those of `result.units`, or empty.
  [[nodiscard]] StoredTable list(std::string_view path) const;

 private:
  std::filesystem::path directory_;
  Json document_;
  std::map<std::string, std::string> sums_;
  std::vector<std::filesystem::path> tables_;
};

/// The files in a directory that belong to the run of its result.json.
struct EarlierResult {
  std::string source;                       ///< scenario or data file
  std::map<std::string, std::string> sums;  ///< SHA-256 of the tables by name
  std::vector<std::string> tables;          ///< names of their files; the user may have changed them
};

/// Nothing if the directory has no result of this program. Reads the file as far as its provenance: results may be
/// large. Errors: `std::system_error`.
[[nodiscard]] std::optional<EarlierResult> earlier_result(const std::string& directory);

/// The name of a file as text. Line breaks and bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string shown(const std::filesystem::path& path);

/// The units that the user wrote, by the path of the quantity.
[[nodiscard]] std::map<std::string, std::string> written_units(const StoredRun& run);

}  // namespace dualdamp::cli
