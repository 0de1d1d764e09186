#pragma once
// Listeners of a run's history: every change in order, with the bracket of its time.

#include <cstddef>

#include "kds/change.h"
#include "kds/kinetic_structure.h"

namespace kds {

struct LoggedEvent {
  std::size_t step;
  double lower, upper;  ///< the time lies between, or equals both
  std::size_t structure;
  Change change;
};

class EventListener {
 public:
  virtual ~EventListener() = default;
  virtual void on_event(const KineticStructure& structure, const LoggedEvent& event) = 0;
};

}  // namespace kds
