// Prints the frames of a trajectory as raw doubles, for compare_readers.py.
// Usage: kds_print_frames FILE. Per frame: its time in picoseconds (NaN if the file has none),
// then x, y, z of each bead.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"

int main(int count, char** arguments) try {
  if (count != 2) throw kds::InputError("usage: kds_print_frames FILE");
  kds::ReadOptions options;
  options.selection = kds::Selection::all;
  const kds::Trajectory trajectory = kds::read_trajectory(arguments[1], options);
  for (std::size_t k = 0; k < trajectory.frames.size(); ++k) {
    const double time =
        k < trajectory.times.size() ? trajectory.times[k] : std::numeric_limits<double>::quiet_NaN();
    std::fwrite(&time, sizeof time, 1, stdout);
    const Eigen::Matrix3Xd& frame = trajectory.frames[k];
    std::fwrite(frame.data(), sizeof(double), static_cast<std::size_t>(frame.size()), stdout);
  }
  for (const std::string& warning : trajectory.warnings) fmt::print(stderr, "{}\n", warning);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
