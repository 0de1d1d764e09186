#include "structures/session/scene_motion.h"

#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "motions/base/input_error.h"
#include "motions/base/require_index.h"
#include "motions/curves/bezier_motion.h"

namespace kds {

namespace {

template <Motion M>
class MotionOfType final : public SceneMotion {
 public:
  template <class... Sizes>
  explicit MotionOfType(const Scene& scene, Sizes... sizes)
      : scene_(scene), motion_(scene.bead_count(), sizes...) {}
  void load(std::size_t step) override { scene_.load(step, motion_); }
  [[nodiscard]] Ref ref() const override { return MotionRef<M::dimension>(motion_); }
  void set_coordinate(BeadId bead, int k, int axis, double value) override {
    const int degree = degree_of(motion_);
    if (bead >= motion_.bead_count() || k < 0 || k > degree || axis < 0 || axis >= M::dimension)
      throw std::invalid_argument(fmt::format(
          "coordinate {} of control point {} of bead {}: expected one from 0 to {} of a point from "
          "0 to {} of one of {} beads",
          axis, k, bead, M::dimension - 1, degree, motion_.bead_count()));
    motion_.set_coordinate(bead, k, axis, value);
  }

 private:
  const Scene& scene_;
  M motion_;
};

template <int Dimension>
std::unique_ptr<SceneMotion> make_in(const Scene& scene) {
  switch (scene.degree()) {
    case 1:
      return std::make_unique<MotionOfType<BezierMotion<Dimension, 1>>>(scene);
    case 2:
      return std::make_unique<MotionOfType<BezierMotion<Dimension, 2>>>(scene);
    case 3:
      return std::make_unique<MotionOfType<BezierMotion<Dimension, 3>>>(scene);
    default:
      return std::make_unique<MotionOfType<AnyDegreeMotion<Dimension>>>(scene, scene.degree());
  }
}

}  // namespace

std::unique_ptr<SceneMotion> make_scene_motion(const Scene& scene) {
  if (scene.degree() > highest_degree)
    throw InputError(
        fmt::format("motions of degree {}: expected a degree from 1 to {}", scene.degree(), highest_degree));
  if (scene.is_lifted()) {
    if (scene.dimension() == 2) return std::make_unique<MotionOfType<LiftedMotion<2>>>(scene);
    return std::make_unique<MotionOfType<LiftedMotion<3>>>(scene);
  }
  switch (scene.dimension()) {
    case 1:
      return make_in<1>(scene);
    case 2:
      return make_in<2>(scene);
    default:
      return make_in<3>(scene);
  }
}

std::vector<double> coordinates_of(const SceneMotion& motion, std::span<const BeadId> beads) {
  std::vector<double> numbers;
  std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        const Curves<Dimension> curves = ref.curves();
        for (const BeadId bead : beads) {
          require_index("bead", bead, curves.bead_count());
          for (int k = 0; k <= curves.own_degree(); ++k)
            for (int axis = 0; axis < Dimension; ++axis) numbers.push_back(curves.coordinate(bead, k, axis));
        }
      },
      motion.ref());
  return numbers;
}

void set_coordinates(SceneMotion& motion, std::span<const BeadId> beads, std::span<const double> numbers) {
  std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        const int degree = ref.curves().own_degree();
        const std::size_t expected = beads.size() * static_cast<std::size_t>((degree + 1) * Dimension);
        if (numbers.size() != expected)
          throw std::invalid_argument(
              fmt::format("{} coordinates for {} beads: expected {}, {} control points of {} axes a bead",
                          numbers.size(), beads.size(), expected, degree + 1, Dimension));
        auto next = numbers.begin();
        for (const BeadId bead : beads)
          for (int k = 0; k <= degree; ++k)
            for (int axis = 0; axis < Dimension; ++axis) motion.set_coordinate(bead, k, axis, *next++);
      },
      motion.ref());
}

TrialCourses::TrialCourses(SceneMotion& motion, std::vector<BeadId> beads)
    : motion_(motion), beads_(std::move(beads)) {
  std::sort(beads_.begin(), beads_.end());
  old_ = coordinates_of(motion_, beads_);
}

TrialCourses::~TrialCourses() { set_coordinates(motion_, beads_, old_); }

void TrialCourses::load(std::size_t) {
  throw std::logic_error("no step is loaded while beads are given other courses");
}

void TrialCourses::set_coordinate(BeadId bead, int k, int axis, double value) {
  if (!std::binary_search(beads_.begin(), beads_.end(), bead))
    throw std::invalid_argument(
        fmt::format("bead {} is given another course, and is none of those said to change theirs", bead));
  motion_.set_coordinate(bead, k, axis, value);
}

}  // namespace kds
