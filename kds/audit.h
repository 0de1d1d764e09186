#pragma once
// Audit modes, and the error thrown if a kinetic structure disagrees with its static rebuild. Such a
// disagreement is an internal failure; its message says how to reproduce it.

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace kds {

enum class AuditMode : std::uint8_t {
  none,
  frames,  ///< at the start and end of every step
  events,  ///< also strictly between all events
};
/// Names of the modes, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> audit_mode_names{"none", "frames", "events"};
[[nodiscard]] constexpr std::string_view name_of(AuditMode mode) {
  return audit_mode_names[static_cast<std::size_t>(mode)];
}

class AuditError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kds
