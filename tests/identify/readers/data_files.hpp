#pragma once
/// Data files as the programs of laboratories write them, made by no code of the readers.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace dualdamp::identify::testing {

/// A file of the test's own, deleted with the object. Tests run side by side: its name holds the process.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_((std::filesystem::temp_directory_path() / ("dualdamp_" + std::to_string(getpid()) + "_" + name))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove(path_); }

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

template <typename Value>
std::string bytes_of(const Value& value) {
  std::string bytes(sizeof(Value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(Value));
  return bytes;
}

/// A matrix of MATLAB 4 by the format's description: five 32-bit words, the name, the numbers.
inline std::string mat4(const std::string& name, const std::vector<double>& values, bool big_endian = false) {
  const auto put = [big_endian](std::string bytes) {
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  const std::int32_t type = big_endian ? 1000 : 0;
  std::string bytes;
  for (const std::int32_t word :
       {type, static_cast<std::int32_t>(values.size()), 1, 0, static_cast<std::int32_t>(name.size() + 1)})
    bytes += put(bytes_of(word));
  bytes += name + '\0';
  for (const double value : values) bytes += put(bytes_of(value));
  return bytes;
}

/// A data set 58 with a time response, single precision and evenly spaced: fixed columns as the format states them.
struct UniversalFunction {
  std::string title = "NONE", entity = "NONE", label = "NONE", unit = "NONE";
  int quantity = 8;
  double start = 0.0, step = 1e-3;
  std::vector<double> values;
  int type = 1, abscissa = 17, kind = 2;  ///< response over time, real single precision
  int node = 12;
};

template <typename... Arguments>
std::string print(const char* format, Arguments... arguments) {
  std::array<char, 256> text{};
  // The formats are the constants below.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(text.data(), text.size(), format, arguments...);
#pragma GCC diagnostic pop
  return text.data();
}

inline std::string header58(const UniversalFunction& f) {
  std::string text = print("%-80s\n", f.title.c_str()) + "NONE\n21-NOV-26 12:00:00\nNONE\nNONE\n";
  text += print("%5d%10d%5d%10d %-10s%10d%4d %-10s%10d%4d\n", f.type, 1, 0, 0, f.entity.c_str(), f.node, 3, "NONE",
                0, 0);
  text +=
      print("%10d%10d%10d%13.5E%13.5E%13.5E\n", f.kind, static_cast<int>(f.values.size()), 1, f.start, f.step, 0.0);
  text += print("%10d%5d%5d%5d %-20s %-20s\n", f.abscissa, 0, 0, 0, "Time", "s");
  text += print("%10d%5d%5d%5d %-20s %-20s\n", f.quantity, 0, 0, 0, f.label.c_str(), f.unit.c_str());
  for (int i = 0; i < 2; ++i) text += print("%10d%5d%5d%5d %-20s %-20s\n", 0, 0, 0, 0, "NONE", "NONE");
  return text;
}

inline std::string data_set(const std::string& number, const std::string& content) {
  return "    -1\n" + number + "\n" + content + "    -1\n";
}

inline std::string uff58(const UniversalFunction& f) {
  std::string data;
  for (std::size_t i = 0; i < f.values.size(); ++i) {
    data += f.kind == 4 ? print("%20.12E", f.values[i]) : print("%13.5E", f.values[i]);
    const std::size_t in_a_line = f.kind == 4 ? 4 : 6;
    if ((i + 1) % in_a_line == 0 || i + 1 == f.values.size()) data += "\n";
  }
  return data_set("    58", header58(f) + data);
}

/// The same with its numbers in binary; `f.kind` 2: four bytes each, 4: eight.
inline std::string uff58b(const UniversalFunction& f, bool big_endian = false) {
  std::string data;
  for (const double value : f.values) {
    std::string bytes = f.kind == 4 ? bytes_of(value) : bytes_of(static_cast<float>(value));
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    data += bytes;
  }
  const std::string number = print("    58b%6d%6d%12d%12d%6d%6d%12d%12d", big_endian ? 2 : 1, 2, 11,
                                   static_cast<int>(data.size()), 0, 0, 0, 0);
  return data_set(number, header58(f) + data + "\n");
}

}  // namespace dualdamp::identify::testing
