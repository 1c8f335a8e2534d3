#pragma once
/// A result directory as it stands on disk: result.json and the tables beside it.

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
  std::vector<double> numbers;  ///< NaN: none, or no number
  std::vector<std::string> texts;
  bool is_text = false;
};

struct StoredTable {
  std::vector<StoredColumn> columns;

  /// nullptr when there is none.
  [[nodiscard]] const StoredColumn* find(std::string_view name) const;
};

/// A result that is not as a run writes it. `StoredRun::read` turns it into a refusal.
class ChangedResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class StoredRun {
 public:
  using Json = nlohmann::ordered_json;

  /// Lists of the document beyond 5000 items are cut: their rows are in the tables. Errors: `core::InputError` when
  /// there is no result.json or it is none of ours.
  /// `units`: to show numbers in, before those the user wrote (`--units`).
  explicit StoredRun(const std::string& directory, const std::string& units = {});

  [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
  [[nodiscard]] const Json& document() const { return document_; }
  /// The tables of this run, sorted; not those that somebody else put there.
  [[nodiscard]] const std::vector<std::filesystem::path>& tables() const { return tables_; }
  /// The text of one of them. Errors: `core::InputError` where somebody has changed it since the run.
  [[nodiscard]] std::string text_of(const std::filesystem::path& table) const;
  /// Has a table this text since the run? Of a run that states no sums nobody knows.
  [[nodiscard]] bool is_as_written(const std::filesystem::path& table, std::string_view text) const;
  /// Reads a table, as `text_of` does; one without columns when the run has none of that name.
  [[nodiscard]] StoredTable table(std::string_view name) const;
  /// Does work that reads the document. Errors: `core::InputError` where it is not of the form that a run writes.
  void read(const std::function<void()>& work) const;
  /// A list of records of the result, such as fit.points, as a table; units are those of `result.units`, or empty.
  [[nodiscard]] StoredTable list(std::string_view path) const;

 private:
  std::filesystem::path directory_;
  Json document_;
  std::map<std::string, std::string> sums_;
  std::vector<std::filesystem::path> tables_;
};

/// A name of a file as text: bytes that are not UTF-8 and line breaks are replaced.
[[nodiscard]] std::string shown(const std::filesystem::path& path);

/// The units of quantities as the user wrote them, by path.
[[nodiscard]] std::map<std::string, std::string> written_units(const StoredRun& run);

/// What identifies a run, as its tables state it above their header.
[[nodiscard]] std::map<std::string, std::string> identity_of(const StoredRun::Json& document);

}  // namespace dualdamp::cli
