// Makes changes of the motion itself subjects of `kds stability`. All checks use exact numbers:
// - a frame never deviates by more than the tolerance;
// - the computed deviation of a stride is never too small;
// - of the contacts derived from the deviation (experiments/run/certify_stride.h), every sure contact is
//   true, and every true contact is possible.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "experiments/stability/stability.h"
#include "kds/event_log.h"
#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "motions/numbers/exact_number.h"
#include "motions/scene/scene.h"
#include "motions/scene/straightened_frames.h"
#include "motions/scene/stride_deviation.h"
#include "structures/session/kinetic_run.h"

namespace kds {
namespace {

constexpr std::size_t bead_count = 5;
using Frames = std::vector<Eigen::Matrix3Xd>;
using ExactPoint = std::array<Rational, 3>;

/// Returns the frames at both ends of `scenes` scenes of an extreme, one after the other.
Frames frames_of(const Extreme& extreme, int dimension, std::size_t scenes, SceneRandom& random) {
  Frames frames;
  for (std::size_t scene = 0; scene < scenes; ++scene) {
    const BeadCurves curves = extreme.make({dimension, 1, bead_count}, random);
    for (const int end : {0, 1}) {
      frames.emplace_back(Eigen::Matrix3Xd::Zero(3, bead_count));
      for (std::size_t b = 0; b < bead_count; ++b)
        for (int axis = 0; axis < dimension; ++axis)
          frames.back()(axis, static_cast<Eigen::Index>(b)) = curves.coordinate(b, end, axis);
    }
  }
  return frames;
}

Scene scene_of(const Frames& frames, std::size_t stride, FrameMotion motion,
               std::vector<double> radii = std::vector<double>(bead_count, 0.0)) {
  Trajectory some;
  some.file = "frames";
  for (std::size_t k = 0; k < frames.size(); k += stride) {
    some.frames.push_back(frames[k]);
    some.frame_numbers.push_back(k);
  }
  return Scene(std::span(&some, 1), std::move(radii), motion);
}

/// Makes a source of these frames.
std::unique_ptr<MemoryFrames> source_of(const Frames& frames) {
  Trajectory trajectory;
  trajectory.file = "frames";
  trajectory.frames = frames;
  return std::make_unique<MemoryFrames>(std::span(&trajectory, 1));
}

ExactPoint exact_point(const Eigen::Matrix3Xd& frame, std::size_t bead) {
  const auto column = static_cast<Eigen::Index>(bead);
  return {Rational(frame(0, column)), Rational(frame(1, column)), Rational(frame(2, column))};
}

bool is_within(const ExactPoint& a, const ExactPoint& b, double distance) {
  if (std::isinf(distance)) return true;
  Rational square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) square += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return square <= Rational(distance) * Rational(distance);
}

/// Counts the checks, and the checks that failed.
struct Looks {
  std::uint64_t all = 0, failed = 0;
  void look(bool holds) {
    ++all;
    failed += holds ? 0 : 1;
  }
};

/// Returns a random tolerance between the last digits of the coordinates and their size. Sometimes returns 0.
double any_tolerance(const Frames& frames, SceneRandom& random) {
  double size = 0;
  for (const Eigen::Matrix3Xd& frame : frames) size = std::max(size, frame.cwiseAbs().maxCoeff());
  if (random() % 8 == 0 || size == 0) return 0;
  const int exponent = std::ilogb(size) - static_cast<int>(random() % 56);
  return std::ldexp(1 + static_cast<double>(random() >> 11U) * 0x1p-53, exponent);
}

Looks look_at_tolerance(const Extreme& extreme, int dimension, SceneRandom& random) {
  const Frames frames = frames_of(extreme, dimension, 12, random);
  static_cast<void>(scene_of(frames, 1, FrameMotion::linear));  // throws for numbers that readers refuse
  const double tolerance = any_tolerance(frames, random);
  StraightenedFrames straight(source_of(frames), tolerance);
  Looks looks;
  std::size_t read = 0;
  for (FrameRead frame; straight.next(frame); ++read)
    for (std::size_t b = 0; b < bead_count; ++b)
      looks.look(is_within(exact_point(frame.positions, b), exact_point(frames[read], b), tolerance));
  looks.look(read == frames.size());
  return looks;
}

/// Returns the position of a bead at a time of the loaded step, in the input's coordinates.
template <class M>
ExactPoint exact_in_input(const Scene& scene, const M& motion, std::size_t bead, const Dyadic& time,
                          const Eigen::Matrix3Xd& frame) {
  const auto position = exact_position(motion, static_cast<BeadId>(bead), time);
  if constexpr (M::dimension == 3) return {position[0], position[1], position[2]};
  // For a planar scene, two axes of the input take the plane's coordinates. The perpendicular axis, along
  // which in_input is constant, keeps the coordinate of the frame.
  ExactPoint point = exact_point(frame, bead);
  std::size_t next = 0;
  const Eigen::Vector3d zero = scene.in_input({0, 0, 0}), one = scene.in_input({1, 1, 0});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis);
    if (zero[row] != one[row]) point[axis] = position[next++];
  }
  return point;
}

template <class M>
void look_at_steps(const Scene& scene, const Frames& frames, std::size_t stride, const StrideDeviation& found,
                   Looks& looks) {
  constexpr std::size_t times = 4;  // per part of a step between two frames
  M motion(bead_count);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    scene.load(step, motion);
    for (std::size_t i = 0; i < stride * times; ++i) {
      const std::size_t before = step * stride + i / times;
      const Rational share(i % times, times);
      const Dyadic time(static_cast<double>(i) / static_cast<double>(stride * times));
      for (std::size_t b = 0; b < bead_count; ++b) {
        ExactPoint truth = exact_point(frames[before], b);
        const ExactPoint after = exact_point(frames[before + 1], b);
        for (std::size_t axis = 0; axis < 3; ++axis) truth[axis] += share * (after[axis] - truth[axis]);
        const ExactPoint there = exact_in_input(scene, motion, b, time, frames[before]);
        looks.look(is_within(there, truth, found.of_bead[b]));
      }
    }
  }
}

Looks look_at_stride(const Extreme& extreme, int dimension, int degree, SceneRandom& random) {
  constexpr std::size_t stride = 4;
  Frames frames = frames_of(extreme, dimension, 7, random);
  frames.resize(3 * stride + 1);
  const FrameMotion kind = degree == 1 ? FrameMotion::linear : FrameMotion::hermite;
  static_cast<void>(scene_of(frames, 1, kind));
  const Scene scene = scene_of(frames, stride, kind);
  const StrideDeviation found = deviation_of_stride(scene, *source_of(frames), stride);
  Looks looks;
  if (scene.dimension() == 2) {
    degree == 1 ? look_at_steps<BezierMotion<2, 1>>(scene, frames, stride, found, looks)
                : look_at_steps<BezierMotion<2, 3>>(scene, frames, stride, found, looks);
  } else {
    degree == 1 ? look_at_steps<BezierMotion<3, 1>>(scene, frames, stride, found, looks)
                : look_at_steps<BezierMotion<3, 3>>(scene, frames, stride, found, looks);
  }
  return looks;
}

using Pairs = std::set<std::pair<BeadId, BeadId>>;

/// Returns the pairs that are in contact at some time of a run.
Pairs pairs_met(const Scene& scene) {
  StructureSettings settings;
  settings.apart = 1;
  KineticRun run(scene, {{"contacts"}, Kernel::filtered, AuditMode::none, settings});
  EventLog log;
  run.listen(log);
  run.build();
  for (const Event& event : run.built(0)) log.on_event(event);
  run.finish();
  Pairs pairs;
  for (const Event& event : log.events)
    if (!event.kind.counted_apart) pairs.emplace(event.ids()[0], event.ids()[1]);
  return pairs;
}

/// Returns whether two beads that move linearly between two frames come within `distance`. Evaluates the
/// distance at the time of closest approach.
bool comes_within(const ExactPoint& start, const ExactPoint& end, const Rational& distance) {
  Rational along = 0, speed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational by = end[axis] - start[axis];
    along -= start[axis] * by;
    speed += by * by;
  }
  Rational time = speed == 0 ? Rational(0) : along / speed;
  if (time < 0) time = 0;
  if (time > 1) time = 1;
  Rational square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational there = start[axis] + time * (end[axis] - start[axis]);
    square += there * there;
  }
  return square <= distance * distance;
}

Pairs pairs_in_truth(const Frames& frames, const std::vector<double>& radii) {
  Pairs pairs;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)
    for (std::size_t a = 0; a < bead_count; ++a)
      for (std::size_t b = a + 1; b < bead_count; ++b) {
        const auto apart = [&](const Eigen::Matrix3Xd& frame) {
          ExactPoint from = exact_point(frame, a);
          const ExactPoint to = exact_point(frame, b);
          for (std::size_t axis = 0; axis < 3; ++axis) from[axis] -= to[axis];
          return from;
        };
        if (comes_within(apart(frames[k]), apart(frames[k + 1]), Rational(radii[a]) + Rational(radii[b])))
          pairs.emplace(static_cast<BeadId>(a), static_cast<BeadId>(b));
      }
  return pairs;
}

/// Returns radii that let beads meet: shares of their distances.
std::vector<double> any_radii(const Frames& frames, SceneRandom& random) {
  std::vector<double> radii;
  for (std::size_t b = 0; b < bead_count; ++b) {
    const auto other = static_cast<Eigen::Index>((b + 1 + random() % (bead_count - 1)) % bead_count);
    const Eigen::Matrix3Xd& frame = frames[random() % frames.size()];
    const double distance = (frame.col(static_cast<Eigen::Index>(b)) - frame.col(other)).stableNorm();
    radii.push_back(distance * 0.125 * static_cast<double>(1 + random() % 8));
    if (!(radii.back() > 0)) radii.back() = 1;
  }
  return radii;
}

/// If `straight`, uses all frames within a tolerance, else every fourth frame.
Looks look_at_contacts(const Extreme& extreme, int dimension, bool straight, SceneRandom& random) {
  const std::size_t stride = straight ? 1 : 4;
  Frames frames = frames_of(extreme, dimension, 7, random);
  frames.resize(3 * 4 + 1);
  const std::vector<double> radii = any_radii(frames, random);
  Frames moved = frames;
  std::optional<double> tolerance;
  if (straight) {
    tolerance = any_tolerance(frames, random);
    moved = straightened(frames, *tolerance);
  }
  static_cast<void>(scene_of(frames, 1, FrameMotion::linear));  // throws for numbers that readers refuse
  const Scene scene = scene_of(moved, stride, FrameMotion::linear, radii);
  const StrideDeviation found = deviation_of_stride(scene, *source_of(frames), stride, tolerance);
  const RadiiWithin within = radii_within(found, radii);
  const Pairs possible = pairs_met(scene_of(moved, stride, FrameMotion::linear, within.larger));
  const Pairs sure = pairs_met(scene_of(moved, stride, FrameMotion::linear, within.smaller));
  const Pairs truth = pairs_in_truth(frames, radii);
  Looks looks;
  for (const auto& pair : sure)
    if (within.has_a_ball[pair.first] != 0 && within.has_a_ball[pair.second] != 0)
      looks.look(truth.contains(pair));
  for (const auto& pair : truth) looks.look(possible.contains(pair));
  return looks;
}

template <class Look>
StabilitySubject lever(const std::string& name, int dimension, int degree, Look look) {
  StabilitySubject subject{name, true, dimension, degree, 0, false, {}};
  subject.run = [=](const Extreme& extreme, const StabilityCases& cases) {
    constexpr std::size_t cases_a_run = 20;
    StabilityRow row;
    row.extreme = extreme.name;
    row.must_refuse = extreme.refused;
    const std::size_t runs = (cases.cases + cases_a_run - 1) / cases_a_run;
    for (std::size_t number = 0; number < runs; ++number) {
      SceneRandom random = scene_random(cases.seed, extreme.name, number);
      ++row.cases;
      try {
        const Looks looks = look(extreme, random);
        row.audits_run += looks.all;
        row.audits_failed += looks.failed;
        if (looks.failed > 0)
          note_trouble(row, number, fmt::format("{} of {} looks failed", looks.failed, looks.all), "");
      } catch (const InputError& error) {
        if (row.refused++ == 0 && row.reason.empty()) row.reason = error.what();
      }
    }
    return row;
  };
  return subject;
}

}  // namespace

std::vector<StabilitySubject> motion_levers() {
  std::vector<StabilitySubject> subjects;
  for (const int dimension : {2, 3}) {
    subjects.push_back(lever("tolerance", dimension, 1, [=](const Extreme& extreme, SceneRandom& random) {
      return look_at_tolerance(extreme, dimension, random);
    }));
    for (const bool straight : {false, true}) {
      const char* const name = straight ? "contacts_of_tolerance" : "contacts_of_stride";
      subjects.push_back(lever(name, dimension, 1, [=](const Extreme& extreme, SceneRandom& random) {
        return look_at_contacts(extreme, dimension, straight, random);
      }));
    }
    for (const int degree : {1, 3}) {
      subjects.push_back(lever("stride", dimension, degree, [=](const Extreme& extreme, SceneRandom& random) {
        return look_at_stride(extreme, dimension, degree, random);
      }));
    }
  }
  return subjects;
}

}  // namespace kds
