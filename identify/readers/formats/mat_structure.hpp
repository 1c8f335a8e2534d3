#pragma once
/// Checks whether a file is a MATLAB file and is complete, before matio reads it.
///
/// Versions 5 to 7: every element must end within the element that holds it, and every array must have as many
/// numbers as its dimensions say; compressed parts are checked by zlib's checksum. Version 4: each matrix must end
/// within the file. Version 7.3 is checked by HDF5. Errors: `core::InputError`. Cost: linear in the elements.

#include <string>
#include <string_view>

#include "core/diagnostics.hpp"
#include "identify/readers/isolated.hpp"

namespace dualdamp::identify {

/// Whether the first bytes are those of a MATLAB file.
[[nodiscard]] bool is_mat(std::string_view bytes);

/// Refuses a file that ends before its elements do, because matio would read the missing bytes as zeros. `file`:
/// its name in messages.
void check_mat(std::string_view bytes, const std::string& file);

/// Lets HDF5 check the end of the file. matio reads a file that HDF5 cannot open as a file without variables.
[[nodiscard]] bool is_whole_hdf5(const std::string& path);

/// An HDF5 variable that MATLAB did not write: the attribute that states the MATLAB class is missing, or is a text
/// without the zero byte at its end, of which matio drops the last letter.
[[nodiscard]] bool lacks_class(const std::string& path, const std::string& variable);

/// The problem that `lacks_class` finds.
[[nodiscard]] core::Diagnostic foreign_variable(const std::string& file, const std::string& name);

/// Throws `core::InputError`: the file is damaged or cut off.
[[noreturn]] void refuse_damaged_mat(const std::string& file);

/// Throws `core::InputError`: why the process that reads the file gave no content.
[[noreturn]] void refuse_unread_mat(const std::string& file, IsolatedEnd end);

/// Limits of time: two minutes for a gigabyte with any compression, some seconds for a small file. On a busy
/// machine, wall time is longer than processor time.
[[nodiscard]] IsolationLimits mat_limits(const std::string& path);

}  // namespace dualdamp::identify
