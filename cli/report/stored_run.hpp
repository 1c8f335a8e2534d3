#pragma once
/// Reads a result directory: result.json and the tables beside it.

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
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

  /// Lists of the document are cut after 5000 items; the tables have all rows. `units`: units of the numbers that
  /// are shown (`--show-in`); they precede those that the user wrote. Errors: `core::InputError` if there is no
  /// result.json of this program.
  explicit StoredRun(const std::string& directory, const std::string& units = {});

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] const Json& document() const { return document_; }
  /// The tables of this run, sorted. Other tables in the directory are not included.
  [[nodiscard]] const std::vector<std::filesystem::path>& tables() const { return tables_; }
  /// The text of a table. Errors: `core::InputError` if the table was changed after the run.
  [[nodiscard]] std::string text_of(const std::filesystem::path& table) const;
  /// Whether `text` is the text that the run wrote to this table. True if the run states no SHA-256 sums.
  [[nodiscard]] bool is_as_written(const std::filesystem::path& table, std::string_view text) const;
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

/// The name of a file as text. Line breaks and bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string shown(const std::filesystem::path& path);

/// The units that the user wrote, by the path of the quantity.
[[nodiscard]] std::map<std::string, std::string> written_units(const StoredRun& run);

/// The facts that identify a run, as its tables state them above their header.
[[nodiscard]] std::map<std::string, std::string> identity_of(const StoredRun::Json& document);

}  // namespace dualdamp::cli
