#include "motions/frames/every_nth.h"

namespace kds {

Trajectory every_nth(const Trajectory& trajectory, std::size_t n) {
  Trajectory some = trajectory;
  if (n == 1 || trajectory.frames.size() == 1) return some;
  some.frames.clear();
  some.frame_numbers.clear();
  some.times.clear();
  for (std::size_t k = 0; k < trajectory.frames.size(); k += n) {
    some.frames.push_back(trajectory.frames[k]);
    some.frame_numbers.push_back(trajectory.frame_number(k));
  }
  return some;
}

}  // namespace kds
