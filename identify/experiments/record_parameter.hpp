#pragma once
/// The parameters that each record adds to those of the rig: its first state, the zeros of its sensors, and what
/// has loaded its contacts.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::identify {

/// The parameters of a single record.
enum class RecordParameter { position, velocity, offset, release, offset_v, offset_a, travel, offset_force };
inline constexpr auto record_parameter_count = static_cast<std::size_t>(RecordParameter::offset_force) + 1;
[[nodiscard]] std::string name_of(RecordParameter which);
[[nodiscard]] std::string unit_of(RecordParameter which);  ///< SI
/// The parameter with this name; nothing if no record has such a parameter.
[[nodiscard]] std::optional<RecordParameter> find_record_parameter(std::string_view name);

/// The zero of a sensor among the parameters of a record.
struct SensorZero {
  RecordParameter which;
  std::string_view signal;  ///< that it shifts
};
inline constexpr std::array<SensorZero, 4> sensor_zeros = {{{RecordParameter::offset, "x"},
                                                            {RecordParameter::offset_v, "v"},
                                                            {RecordParameter::offset_a, "a"},
                                                            {RecordParameter::offset_force, "force"}}};

/// A value of each parameter of a single record [SI]; zero until it is set.
class RecordValues {
 public:
  [[nodiscard]] double& operator[](RecordParameter which) { return values_[static_cast<std::size_t>(which)]; }
  [[nodiscard]] double operator[](RecordParameter which) const { return values_[static_cast<std::size_t>(which)]; }

 private:
  std::array<double, record_parameter_count> values_{};
};

}  // namespace dualdamp::identify
