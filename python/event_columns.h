#pragma once
// Keeps the events of a run in columns, which become arrays of NumPy.

#include <pybind11/pybind11.h>

#include <cstdint>
#include <vector>

#include "kds/event_log.h"

namespace kds::python {

class EventColumns final : public EventListener {
 public:
  void on_event(const Event& event) override;
  /// While events are not kept, the listener ignores them.
  void keep(bool keeps) { keeps_ = keeps; }
  /// Returns the columns as a dictionary of arrays with one row for each event, and starts anew:
  /// `frame`, `time` (picoseconds, NaN without times), `lower`, `upper` (the bracket in the step), `step`,
  /// `structure` and `kind` (indices), and `beads`, rows of ten ids that
  /// end with -1. The infinite vertex is -1, too.
  [[nodiscard]] pybind11::dict take();
  [[nodiscard]] std::size_t size() const { return frames_.size(); }

 private:
  bool keeps_ = true;
  std::vector<double> frames_, times_, lower_, upper_;
  std::vector<std::int64_t> steps_;
  std::vector<std::uint8_t> structures_, kinds_, sizes_;
  std::vector<BeadId> ids_;  // of all events, one after the other
};

}  // namespace kds::python
