#pragma once
// Times static works on one or two frames of beads, and steps from frame to frame, in processor seconds, and
// counts what they do. Works that are compared run in turn, round by round. Beads have the shape (beads, 3)
// or (beads, 2). Each function returns a dictionary: for each work an array of its seconds by round, and the
// counts.

#include <pybind11/pybind11.h>

namespace kds::python {

/// Adds the functions to the module. kds/timing.py documents them.
void bind_timing(pybind11::module_& module);

}  // namespace kds::python
