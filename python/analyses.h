#pragma once
// The program's commands on inputs of Python. Each function takes the arguments of its command, runs without
// the GIL, and returns a dictionary: `json` is the text of the command's results, `table` its table, and
// `warnings` the warnings about the input. Columns are arrays.

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "experiments/program/command_line.h"

namespace kds::python {

/// `kds contacts`. Adds `columns`, the header of its CSV, `names` of the elements, and the arrays of all
/// intervals: `first`, `second` (elements), `begin_frame`, `end_frame`, `begin_time`, `end_time`
/// (picoseconds), `begin_step`, `end_step` (counted in steps, whole only at a frame), `length`,
/// `open_at_start`, `open_at_end`; and `frame_numbers`, those of all frames in the file.
[[nodiscard]] pybind11::dict contacts(const Arguments& arguments, const pybind11::object& progress);
/// `kds replay`, whose only argument is the log.
[[nodiscard]] pybind11::dict replay(const Arguments& arguments, const pybind11::object& progress);
/// `kds compare`.
[[nodiscard]] pybind11::dict compare(const Arguments& arguments, const pybind11::object& progress);
/// `kds update`.
[[nodiscard]] pybind11::dict update(const Arguments& arguments, const pybind11::object& progress);
/// `kds collide`. Adds the colliding pairs of all frames, if some method lists them: `frames` (a frame number
/// for each pair) and `pairs` (m, 2).
[[nodiscard]] pybind11::dict collide(const Arguments& arguments, const pybind11::object& progress);
/// `kds surface`. Adds arrays with a row for each time: `frames` (numbers in the file), `areas` and `volumes`
/// (times, beads); the contacts of all times: `contact_times` (indices of times), `contacts` (m, 2) and
/// `contact_areas`; `names` of the beads, `residue_of` (for each bead, -1 without residues), `residue_names`,
/// `chain_of` and `chain_names`.
[[nodiscard]] pybind11::dict surface(const Arguments& arguments, const pybind11::object& progress);
/// `kds voids`. Adds no arrays.
[[nodiscard]] pybind11::dict voids(const Arguments& arguments, const pybind11::object& progress);
/// `kds trade`.
[[nodiscard]] pybind11::dict trade(const Arguments& arguments, const pybind11::object& progress);
/// `kds info`: the conditions of a proper necklace.
[[nodiscard]] pybind11::dict conditions(const Arguments& arguments, const pybind11::object& progress);
/// `kds generate`. Returns an array (frames, beads, 3) for each necklace.
[[nodiscard]] pybind11::list generate(const Arguments& arguments);
/// Returns the backbone of the first chain of a file, an array (frames, beads, 3). `topology` names
/// its atoms, if the file does not.
[[nodiscard]] pybind11::object read_positions(const std::string& path,
                                              const std::optional<std::string>& topology);

}  // namespace kds::python
