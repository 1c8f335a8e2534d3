#pragma once
/// Files that cannot be read, by whose fault.
///
/// A name that leads to no file is a fault of the input. That the system refuses a file which is there is none: its
/// content may be sound, and other input would be refused as well.

#include <string>

namespace dualdamp::core {

/// Whether this value of errno says that a name leads to no file that can be read: it is missing, a directory, too
/// long, a loop of links, or a device without a driver.
[[nodiscard]] bool is_fault_of_name(int error);

/// Throws `InputError` for a fault of the name; else `std::system_error`: no permission, too many open files, no
/// memory, a fault of the disk. `what`: such as "cannot be opened"; `error`: errno.
[[noreturn]] void fail_to_read(const std::string& path, const std::string& what, int error);

}  // namespace dualdamp::core
