#include "structures/session/new_courses.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "motions/base/require_index.h"

namespace kds {

namespace {

template <class Visit>
void for_numbers(const SceneMotion& motion, const std::vector<BeadId>& beads, Visit visit) {
  std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        const Curves<Dimension> curves = ref.curves();
        for (const BeadId bead : beads) {
          require_index("bead", bead, curves.bead_count());
          for (int k = 0; k <= curves.own_degree(); ++k)
            for (int axis = 0; axis < Dimension; ++axis)
              visit(bead, k, axis, curves.coordinate(bead, k, axis));
        }
      },
      motion.ref());
}

}  // namespace

NewCourses::NewCourses(SceneMotion& motion, std::vector<BeadId> beads)
    : motion_(motion), beads_(std::move(beads)) {
  std::sort(beads_.begin(), beads_.end());
  old_ = now();
}

NewCourses::~NewCourses() {
  if (!for_good_) set(old_);
}

void NewCourses::load(std::size_t) {
  throw std::logic_error("no step is loaded while beads are given other courses");
}

void NewCourses::set_coordinate(BeadId bead, int k, int axis, double value) {
  if (!std::binary_search(beads_.begin(), beads_.end(), bead))
    throw std::invalid_argument(
        fmt::format("bead {} is given another course, and is none of those said to change theirs", bead));
  motion_.set_coordinate(bead, k, axis, value);
}

void NewCourses::hold_back() {
  new_ = now();
  set(old_);
}

void NewCourses::set_for_good() {
  for_good_ = true;
  set(new_);
}

std::vector<double> NewCourses::now() const {
  std::vector<double> numbers;
  for_numbers(motion_, beads_, [&](BeadId, int, int, double value) { numbers.push_back(value); });
  return numbers;
}

void NewCourses::set(const std::vector<double>& numbers) {
  auto next = numbers.begin();
  for_numbers(motion_, beads_,
              [&](BeadId bead, int k, int axis, double) { motion_.set_coordinate(bead, k, axis, *next++); });
}

}  // namespace kds
