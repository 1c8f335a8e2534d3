#pragma once
/// Is a file a MATLAB file, and is it whole? Looked at before matio reads it.
///
/// Versions 5 to 7: every element ends within the one around it, and every array of numbers has as many as its
/// dimensions say; what is compressed is left to zlib's checksum. Version 4: each matrix ends within the file.
/// Version 7.3 is left to HDF5. Errors: `core::InputError`. Cost: linear in the number of elements.

#include <string>
#include <string_view>

namespace dualdamp::identify {

/// The first bytes are those of a MATLAB file.
[[nodiscard]] bool is_mat(std::string_view bytes);

/// Refuses a file that ends before its elements do: matio reads what is missing as zeros. `file` is its name in
/// messages.
void check_mat(std::string_view bytes, const std::string& file);

/// Throws: the file is damaged or cut off.
[[noreturn]] void refuse_damaged_mat(const std::string& file);

}  // namespace dualdamp::identify
