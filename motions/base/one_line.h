#pragma once
// Messages of other libraries, made fit for one line.

#include <string>
#include <string_view>

namespace kds {

/// Line ends and other control characters become blanks, runs of blanks one blank; at most 300 characters.
[[nodiscard]] std::string one_line_message(std::string_view message);

}  // namespace kds
