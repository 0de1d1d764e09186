#pragma once
// Keeps the events of a run as rows of a structured array of NumPy, so that the array needs no copy.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kds/event.h"
#include "kds/kinetic_structure.h"

namespace kds::python {

class EventRows final : public EventListener {
 public:
  /// `structures` are those of the run, in order. Call it before the first event.
  void set_structures(std::span<KineticStructure* const> structures);
  void on_event(const Event& event) override;
  /// While events are not kept, the listener ignores them.
  void keep(bool keeps) { keeps_ = keeps; }
  /// Returns an array with one row for each event, and starts anew. Fields: `frame`, `time` (picoseconds, NaN
  /// without times), `lower`, `upper` (the canonical bracket in the step), `step`, `structure` and `kind`
  /// (names), and `beads`, ten ids that end with -1. The infinite vertex is -1, too.
  [[nodiscard]] pybind11::array take();

 private:
  struct Free {
    void operator()(char* bytes) const { std::free(bytes); }
  };

  bool keeps_ = true;
  std::size_t structure_width_ = 1, kind_width_ = 1;  // in characters
  std::vector<std::vector<std::u32string>> names_;  // by structure and kind: both names, filled up with zeros
  std::size_t row_bytes_ = 0;
  std::unique_ptr<char, Free> rows_;  // memory of malloc, because realloc moves large blocks without a copy
  std::size_t count_ = 0, capacity_ = 0;
};

}  // namespace kds::python
