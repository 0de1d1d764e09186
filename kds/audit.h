#pragma once
// A kinetic structure that disagrees with its static rebuild: an internal failure, with what it takes to see
// it again.

#include <cstdint>
#include <stdexcept>

namespace kds {

enum class AuditMode : std::uint8_t {
  none,
  frames,  ///< at the start and end of every step
  events,  ///< also strictly between all events
};

class AuditError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kds
