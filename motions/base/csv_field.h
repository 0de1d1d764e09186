#pragma once
// Text fields in CSV files (comma-separated values).

#include <string>
#include <string_view>

namespace kds {

/// Returns the text as a CSV field, in quotation marks if necessary.
[[nodiscard]] inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace kds
