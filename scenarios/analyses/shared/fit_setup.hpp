#pragma once
/// Parts of a fit or a prediction: rigs, experiments, and the parameters that are fitted.

#include <string>
#include <vector>

#include "identify/fit/fit.hpp"
#include "scenarios/analysis.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/format/json.hpp"
#include "sim/model.hpp"

namespace dualdamp::scenarios {

/// Of a list `analysis.NAME` of data files.
struct DataItem {
  std::string file;
  Json keys;  ///< of its item
  identify::MeasuredRecord data;
  std::vector<std::optional<RecordDrive>> drives{};  ///< own drives of the histories; empty: none
  core::SettingWords words{};                        ///< how messages name what may be stated beside the file
  std::vector<std::size_t> zeroed{};  ///< histories whose zero was subtracted: the remaining zero is fitted

  [[nodiscard]] bool is_loop() const { return keys.is_object() && keys.value("loop", false); }
  /// It moves from a first state. A loop moves as it was measured.
  [[nodiscard]] bool is_motion() const { return !is_loop() && !data.record.histories.empty(); }
  [[nodiscard]] const RecordDrive* drive_of(std::size_t history) const {
    return history < drives.size() && drives[history] ? &*drives[history] : nullptr;
  }
  /// A history moves under the drive of the model.
  [[nodiscard]] bool takes_drive_of_model() const;
};

[[nodiscard]] std::vector<DataItem> items_of(const Json& analysis, const std::vector<DataFile>& files,
                                             const std::string& key);

/// Limits of a fitted parameter, as texts; empty: the limit of the law.
struct Bound {
  std::string name;
  std::string low;
  std::string high;
};

/// Parameters that are fitted in addition to those that the system does not state.
struct Sought {
  std::vector<std::string> free;  ///< names
  std::vector<Bound> bounds;
  bool initial_is_known = false;
};

[[nodiscard]] Sought sought_of(const Json& analysis, bool initial_is_known);

/// The model of a scenario as fits compute its motions: with a tolerance that is enough for them, unless the
/// scenario states one.
[[nodiscard]] sim::Model model_for_fit(const CheckedValues& values);

/// The laws of `system`, or the law `law` alone. `model`: its oscillator and excitation, and the numerical
/// settings.
[[nodiscard]] identify::Rig rig_of(const Json& system, const sim::Model& model, const std::string& law = {});

/// "coulomb + viscous_power"
[[nodiscard]] std::string laws_text(const identify::Rig& rig);

/// What is wrong with the statements of a fit.
struct SetupFault {
  std::string path;  ///< below `analysis`
  std::string message;
};
/// Throws `core::InputError` if there are faults.
void throw_if_any(const std::vector<SetupFault>& faults);

/// Experiments of all items; data that cannot be used are reported in `faults`.
[[nodiscard]] identify::Experiments experiments_from(const std::vector<DataItem>& items, const std::string& key,
                                                     const sim::Model& model, const Sought& sought,
                                                     std::vector<SetupFault>& faults);

/// Complains about a stated first state at which no item begins, because the fit would ignore it.
void refuse_idle_initial(const std::vector<DataItem>& items, std::vector<SetupFault>& faults);

/// Complains about a stated drive, or its frequency or amplitude, that no item needs, because the fit would ignore
/// it.
void refuse_idle_drive(const std::vector<DataItem>& items, const sim::Model& model,
                       std::vector<SetupFault>& faults);

/// All fitted parameters, in order.
[[nodiscard]] std::vector<identify::FitParameter> parameters_for(const identify::Rig& rig,
                                                                 const identify::Experiments& experiments,
                                                                 const Sought& sought,
                                                                 std::vector<SetupFault>& faults);

}  // namespace dualdamp::scenarios
