#pragma once
/// A scenario while it is being checked: the file's text as a tree, what was read of it, and the problems found.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identify/readers/record_reader.hpp"
#include "scenarios/format/keys.hpp"
#include "scenarios/format/needs.hpp"
#include "scenarios/format/reader.hpp"
#include "sim/excitation.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::scenarios {

/// Data in memory, by the name that replaces their file: CSV or universal file format.
using DataTexts = std::map<std::string, std::string, std::less<>>;

/// Where data files are looked for.
struct DataPlace {
  std::string directory;
  bool anywhere = false;   ///< they may be outside it
  const DataTexts& texts;  ///< looked through first
};

/// The drive of one history of a data file, in place of the excitation of the scenario.
struct RecordDrive {
  sim::Excitation drive;  ///< its samples begin with the history
  Json section;           ///< `excitation` of a scenario with this drive
  /// The history holds a free vibration after a blow of force; the blow is left out.
  bool follows_blow = false;
};

/// A data file of an analysis that takes several.
struct DataFile {
  std::string name;
  std::string key;       ///< of `analysis` that names it
  std::size_t item = 0;  ///< of the list there
  identify::MeasuredRecord data;
  std::vector<std::optional<RecordDrive>> drives = {};  ///< of each history; empty: none has its own
  core::SettingWords words = {};                        ///< how messages name what may be stated beside it
};

class CheckedFile {
 public:
  /// `format`: the tables by which the document was read. `needs`: those of its analysis; empty when the file is
  /// too faulty for them. Both must outlive this object.
  CheckedFile(const Document& document, Reading& reading, const Section& format, const std::vector<Needs>& needs,
              DataPlace data_place);

  /// The record of `analysis.data`, once it has been read.
  std::optional<identify::MeasuredRecord> data;
  /// The records of an analysis that takes several files.
  std::vector<DataFile> files;
  /// The samples of the excitation, once they have been read or listed.
  std::shared_ptr<const sim::SampledSignal> drive;
  /// Time of the first of these samples on the clock of their file [s].
  double drive_start = 0.0;
  /// A measured signal with which the analysis compares its result, once it has been read.
  std::optional<identify::MeasuredSignal> compared;
  /// Digests of the files read, except that of `data`.
  std::vector<std::string> sha256;
  /// Warnings about a valid file.
  std::vector<std::string> warnings;

  [[nodiscard]] const DataPlace& data_place() const { return data_place_; }

  /// How messages name what a user may state.
  [[nodiscard]] const core::SettingWords& words() const { return document_.words(); }

  /// Values read so far; checks complete them.
  [[nodiscard]] Json& values() { return reading_.values; }
  [[nodiscard]] const Json& values() const { return reading_.values; }

  /// The coordinate, as far as the file states it; otherwise a displacement.
  [[nodiscard]] core::Coordinate coordinate() const {
    return reading_.coordinate ? reading_.coordinate->coordinate : core::Coordinate::displacement;
  }
  /// The source of this; nothing if the file does not state it.
  [[nodiscard]] const std::optional<CoordinateSource>& coordinate_source() const { return reading_.coordinate; }
  void tell_coordinate(CoordinateSource source) { reading_.coordinate = std::move(source); }

  /// Adds the units of a data file's columns to the written units, as `data.x`.
  void note_units(const identify::ColumnUnits& units);

  /// Type of the analysis; empty when the file is too faulty for it.
  [[nodiscard]] const std::string& analysis() const { return analysis_; }

  /// The needs of the analysis; nullptr when the file is too faulty for them.
  [[nodiscard]] const Needs* needs() const { return needs_; }

  /// "analysis 'identify' with a measurement 'xy_curve'"; `needs` must be known.
  [[nodiscard]] std::string subject() const;

  /// At a place of the file, or at the value of a path.
  void complain(Place place, std::string message, std::string allowed = {}, std::string found = {},
                std::string suggestion = {});
  void complain(const std::string& path, std::string message, std::string allowed = {}, std::string found = {},
                std::string suggestion = {});

  /// Takes back the problems whose messages begin with a path, where another message gives the reason of all.
  void withdraw(const std::string& path);

  /// Adds problems that were found and located elsewhere.
  void take_over(const std::vector<core::Diagnostic>& problems);

  /// Place of the value at `path`, or of the section that contains it.
  [[nodiscard]] Place place_of(std::string path) const;

  /// Whether the file has a value at exactly this path, readable or not.
  [[nodiscard]] bool is_given(const std::string& path) const { return reading_.places.contains(path); }

  /// Whether an option or a sweep names exactly this path.
  [[nodiscard]] bool is_chosen(const std::string& path) const { return document_.is_chosen(path); }

  /// A section without its key; nullptr when it is not there.
  [[nodiscard]] const Node* node(std::string_view section) const;

  /// A section with its key; nullptr when it is not there.
  [[nodiscard]] const Entry* entry(std::string_view section) const { return document_.root().find(section); }

  /// Whether the file has the key, with a readable value or not.
  [[nodiscard]] bool stands_in_file(std::string_view section, std::string_view key) const;

  [[nodiscard]] bool has(const std::string& section, const std::string& key) const;
  [[nodiscard]] std::string text_at(const std::string& section, const std::string& key) const;
  /// Nothing if the key is missing, or if it still holds a word such as `natural` that the constants do not
  /// resolve.
  [[nodiscard]] std::optional<double> number_at(const std::string& section, const std::string& key) const;

  /// `analysis.measurement`; nullptr when there is none.
  [[nodiscard]] const Json* measurement() const;

  /// The tables by which the file was read.
  [[nodiscard]] const Section& format() const { return format_; }

  /// The tables of a section that is a plain map: system.
  [[nodiscard]] const Section& keys_of(std::string_view section) const;

  /// Gives `analysis` a key that the file left out, in its place among the others.
  void fill_in(const std::string& key, Json value);

 private:
  [[nodiscard]] const Needs* find_needs(const std::vector<Needs>& rows) const;

  const Document& document_;
  Reading& reading_;
  const Section& format_;
  std::string analysis_;
  const Needs* needs_;
  DataPlace data_place_;
};

/// Moves keys that were filled in later to their places in the tables.
void put_in_order(Json& values, const Section& section);

}  // namespace dualdamp::scenarios
