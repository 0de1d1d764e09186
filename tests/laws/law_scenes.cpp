#include "tests/laws/law_scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "experiments/stability/stability_scenes.h"
#include "motions/models/model.h"
#include "motions/readers/read_trajectory.h"
#include "tests/support/inputs/hard_scenes.h"
#include "tests/support/inputs/lattice_scenes.h"

namespace kds::test {

namespace {

using Frames = std::vector<Eigen::Matrix3Xd>;
using Points = std::vector<std::array<double, 3>>;

Scene scene_through(Frames frames, std::vector<double> radii = {1},
                    FrameMotion motion = FrameMotion::linear) {
  Trajectory necklace;
  necklace.file = "a law's scene";
  const auto beads = static_cast<std::size_t>(frames.front().cols());
  necklace.frames = std::move(frames);
  if (radii.size() == 1) radii.resize(beads, radii.front());
  return {std::span(&necklace, 1), std::move(radii), motion};
}
Scene scene_through(const std::vector<Points>& frames) {
  Frames matrices;
  for (const Points& points : frames) {
    Eigen::Matrix3Xd& frame = matrices.emplace_back(3, points.size());
    for (std::size_t b = 0; b < points.size(); ++b)
      frame.col(static_cast<Eigen::Index>(b)) = Eigen::Vector3d(points[b][0], points[b][1], points[b][2]);
  }
  return scene_through(std::move(matrices));
}

/// Returns one radius for each bead if `unequal`, otherwise one radius for all.
std::vector<double> some_radii(Random& random, std::size_t beads, double unit, bool unequal) {
  std::vector<double> radii{unit};
  for (std::size_t b = 1; b < beads && unequal; ++b) radii.push_back(unit * 0.25 * pick(random, 2, 6));
  return radii;
}

// Beads in a cell that may be skewed, change, be narrow, or span one or two vectors only. Most coordinates
// are multiples of 1/2, so that images touch and nearest images change at frames.
Scene cells(std::uint64_t seed) {
  Random random(static_cast<unsigned>(seed));
  const std::size_t beads = 7, frames = 4;
  const bool plane = seed % 4 == 3, on_grid = seed % 3 != 0, narrow = seed % 5 == 0;
  Cell cell = Cell::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) cell(i, i) = pick(random, narrow ? 2 : 5, narrow ? 3 : 9);
  if (seed % 2 == 1) {
    cell(0, 1) = 0.5 * pick(random, -4, 4);
    if (!plane) cell(1, 2) = 0.5 * pick(random, -4, 4);
  }
  if (seed % 7 == 1) cell.col(2).setZero();
  Trajectory necklace;
  necklace.file = "cells";
  for (std::size_t k = 0; k < frames; ++k) {
    Eigen::Matrix3Xd& frame = necklace.frames.emplace_back(3, beads);
    for (double& x : frame.reshaped())
      x = on_grid ? 0.5 * pick(random, -6, narrow ? 6 : 18) : 4 * uniform(random);
    if (k > 0 && !on_grid)
      for (Eigen::Index i = 0; i < frame.size(); ++i)
        frame.data()[i] = necklace.frames[k - 1].data()[i] + uniform(random);
    if (plane) frame.row(2).setZero();
    necklace.cells.push_back(cell);
    if (seed % 3 == 1) cell(0, 0) += 0.25 * pick(random, -1, 1);
  }
  return {std::span(&necklace, 1), some_radii(random, beads, 1, seed % 2 == 0),
          seed % 6 == 5 ? FrameMotion::hermite : FrameMotion::linear};
}

// An extreme of `kds stability`: dimension, degree and radii follow from the seed.
Scene extreme_scene(const Extreme& extreme, std::uint64_t seed) {
  constexpr std::array<std::pair<int, int>, 5> shapes{{{3, 1}, {2, 1}, {3, 3}, {1, 1}, {2, 3}}};
  std::uint64_t from = seed;
  while (!extreme.applies(shapes[from % 5].first, shapes[from % 5].second)) ++from;
  const auto [dimension, degree] = shapes[from % 5];
  SceneRandom random = scene_random(seed, extreme.name, 0);
  const std::size_t beads = degree == 1 ? 8 : 6;
  BeadCurves curves = extreme.make({dimension, degree, beads}, random);
  std::vector<double> radii;
  if (extreme.unequal_radii || seed % 2 == 1) {
    give_radii(curves, random);
    for (std::size_t b = 0; b < beads; ++b) radii.push_back(curves.radius(b, 0));
  }
  return Scene(curves.instance(std::string(extreme.name)), std::move(radii));
}

template <int Dimension, int Degree>
Instance instance_of(const BezierMotion<Dimension, Degree>& motion) {
  Instance instance{"lattice", Dimension == 3 ? 4 : Dimension, Degree, {}};
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < Dimension; ++axis)
      for (int k = 0; k <= Degree; ++k) instance.control_points.push_back(motion.coordinate(b, k, axis));
    for (int k = 0; k <= Degree && Dimension == 3; ++k)
      instance.control_points.push_back(motion.weight(b, k));
  }
  return instance;
}
Scene lattice_crossing(std::uint64_t seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto kind = static_cast<LatticeScene>(seed % lattice_scene_kinds);
  switch (seed / lattice_scene_kinds % 3) {
    case 0:
      return Scene(instance_of(lattice_scene<3, 1>(random, kind)));
    case 1: {
      const auto motion = lattice_scene<2, 1>(random, kind);
      std::vector<double> radii;  // balls for every second seed, points otherwise
      for (BeadId b = 0; b < motion.bead_count() && seed % 2 == 1; ++b) radii.push_back(random() % 3);
      return Scene(instance_of(motion), std::move(radii));
    }
    default:
      return Scene(instance_of(lattice_scene<3, 2>(random, kind)));
  }
}

Points random_grid_points(Random& random, std::size_t beads, int range) {
  Points points(beads);
  for (auto& point : points)
    for (double& x : point) x = pick(random, 0, range - 1);
  return points;
}

// Whole coordinates in a small range, sometimes a repeated frame. Half of the scenes have one step.
Scene ties(std::uint64_t seed) {
  Random random(seed);
  const auto beads = static_cast<std::size_t>(pick(random, 4, 10));
  const int range = pick(random, 2, 5);
  std::vector<Points> frames;
  for (int k = 0; k < (seed % 2 == 0 ? 2 : 4); ++k)
    frames.push_back(k > 0 && random() % 4 == 0 ? frames.back() : random_grid_points(random, beads, range));
  return scene_through(frames);
}

// Pairs of beads stay at one position. Beads that move together hide each other in turn.
Scene twins(std::uint64_t seed) {
  Random random(seed);
  const auto beads = static_cast<std::size_t>(6 + 2 * pick(random, 0, 3));
  std::vector<Points> frames;
  for (int k = 0; k < 2; ++k) frames.push_back(random_grid_points(random, beads, 5));
  for (std::size_t b = 0; b + 1 < beads; b += 2)
    if (random() % 4 != 0)
      for (Points& points : frames) points[b + 1] = points[b];
  return scene_through(frames);
}

// Beads of a grid rest or move by whole units. Many events coincide, also with frames.
Scene resting_grid(std::uint64_t seed) {
  Random random(seed);
  const bool flat = seed % 2 == 0;
  const int side = flat ? 4 : 2, beads = side * side * (flat ? 1 : side + 1);
  Frames frames;
  for (int frame = 0; frame < 6; ++frame) {
    Eigen::Matrix3Xd& positions = frames.emplace_back(3, beads);
    for (int bead = 0; bead < beads; ++bead) {
      positions.col(bead) = Eigen::Vector3d(bead % side, bead / side % side, bead / (side * side));
      for (int axis = 0; axis < (flat ? 2 : 3); ++axis)
        if (frame % 3 == 1 && random() % 3 == 0) positions(axis, bead) += pick(random, -1, 1);
    }
  }
  return scene_through(std::move(frames), {0.5});
}

Scene wandering_chain(std::uint64_t seed) {
  Random random(seed);
  constexpr int beads = 16;
  Frames frames;
  for (int frame = 0; frame < 6; ++frame) {
    Eigen::Matrix3Xd positions = frame == 0 ? Eigen::Matrix3Xd(3, beads) : frames.back();
    for (int bead = 0; bead < beads; ++bead)
      for (int axis = 0; axis < 3; ++axis)
        positions(axis, bead) =
            (frame == 0 ? (axis == 0 ? bead : 0) : positions(axis, bead)) + uniform(random, -0.4, 0.4);
    frames.push_back(positions);
  }
  return scene_through(std::move(frames), some_radii(random, beads, 0.8, seed % 2 == 1),
                       seed % 4 < 2 ? FrameMotion::linear : FrameMotion::hermite);
}

Scene balls_on_lattice(std::uint64_t seed) {
  const LatticeBalls lattice = kds::test::lattice_balls(seed);
  return {std::span(&lattice.necklace, 1), lattice.radii,
          seed % 2 == 0 ? FrameMotion::hermite : FrameMotion::linear};
}

// Beads that creep while all drift together, so that slack makes most certificates unnecessary.
Scene creeping(std::uint64_t seed) {
  Random random(seed);
  const double step = std::array{1e-9, 1e-4, 5e-4}[seed % 3];
  constexpr int beads = 30;
  Frames frames;
  for (int k = 0; k < 14; ++k) {
    Eigen::Matrix3Xd positions(3, beads);
    for (double& x : positions.reshaped())
      x = k == 0 ? uniform(random, 0, 1) : 0.75 + uniform(random, -step, step);
    if (k > 0) positions += frames.back();
    frames.push_back(positions);
  }
  return scene_through(std::move(frames), some_radii(random, beads, 0.05, seed % 2 == 1));
}

// Beads keep their velocities for several steps, so that certificates are proved some steps ahead. In every
// third scene coordinates are small whole numbers, and much happens at once, also where steps meet.
Scene straight_on(std::uint64_t seed) {
  Random random(seed);
  const bool tied = seed % 3 == 2, flat = seed % 4 == 3;
  const double turning = std::array{0.0, 0.04, 0.1, 0.9}[seed % 4];
  const int beads = tied ? 14 : 30, range = tied ? 6 : 1 << 12, fastest = tied ? 1 : 160;
  const double unit = tied ? 1 : 0x1p-12;
  Frames frames{Eigen::Matrix3Xd::Zero(3, beads)};
  Eigen::Matrix3Xd velocity = Eigen::Matrix3Xd::Zero(3, beads);
  for (int b = 0; b < beads; ++b)
    for (int axis = 0; axis < (flat ? 2 : 3); ++axis) frames[0](axis, b) = unit * pick(random, 0, range - 1);
  for (int k = 0; k < 9; ++k) {
    for (int b = 0; b < beads; ++b) {
      if (k > 0 && uniform(random, 0, 1) >= turning) continue;
      const bool rests = random() % 5 == 0;
      for (int axis = 0; axis < (flat ? 2 : 3); ++axis)
        velocity(axis, b) = rests ? 0 : unit * pick(random, -fastest, fastest);
    }
    frames.emplace_back(frames.back() + velocity);
  }
  // Coordinates beyond the precision of double are rounded at each frame, so no velocity is kept.
  if (seed % 8 == 7)
    for (Eigen::Matrix3Xd& frame : frames) frame /= 3;
  return scene_through(std::move(frames), some_radii(random, beads, tied ? 0.5 : 0.1, seed % 2 == 1));
}

// Highly regular scenes: many balls lie on one sphere, many events are simultaneous, and flips block each
// other.
Scene regular(std::uint64_t seed) {
  const auto model = [](const char* name, std::size_t beads, models::ShapeMotion motion) {
    return models::generate(*models::find_model(name), {.beads = beads, .frames = 3, .motion = motion})
        .front()
        .frames;
  };
  const auto lattice = [](int beads) {
    Eigen::Matrix3Xd points(3, beads);
    for (Eigen::Index b = 0; b < beads; ++b)
      points.col(b) = Eigen::Vector3d(double(b % 3), double(b / 3 % 3), double(b / 9));
    return points;
  };
  const auto turned = [](const Eigen::Matrix3Xd& points, const Eigen::Matrix3d& by) {
    return Frames{points, by * points, by * by * points};
  };
  const auto turn = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  };
  switch (const std::uint64_t kind = seed % 11) {
    case 0:
      return scene_through(model("grid", 27, models::ShapeMotion::rotate));
    case 1:
      return scene_through(model("grid", 27, models::ShapeMotion::wander));
    case 2:
      return scene_through(model("helix", 24, models::ShapeMotion::rotate));
    case 3:
      return scene_through(model("grill", 24, models::ShapeMotion::rotate));
    case 4: {  // one bead moves
      Frames frames = model("grid", 27, models::ShapeMotion::rest);
      for (int k = 1; k < 3; ++k)
        frames[static_cast<std::size_t>(k)].col(13) += k * Eigen::Vector3d(0.3, 0.2, -0.4);
      return scene_through(std::move(frames));
    }
    case 5: {  // rings, one above the other, turned and then stretched
      Eigen::Matrix3Xd rings(3, 24);
      for (Eigen::Index b = 0; b < rings.cols(); ++b) {
        const double angle = 2 * std::numbers::pi * double(b % 8) / 8;
        rings.col(b) = Eigen::Vector3d(3 * std::cos(angle), 3 * std::sin(angle), 0.75 * double(b / 8));
      }
      const Eigen::Matrix3d by = turn(0.25, {1, 2, 2});
      return scene_through({rings, by * rings, by * Eigen::Vector3d(1, 1.25, 1).asDiagonal() * rings});
    }
    case 6: {  // a plane lattice that turns in space: it has cells only because its coordinates are rounded
      Eigen::Matrix3Xd plane(3, 16);
      for (Eigen::Index b = 0; b < plane.cols(); ++b)
        plane.col(b) = Eigen::Vector3d(2 * double(b % 4), 2 * double(b / 4), 0);
      return scene_through(turned(plane, turn(0.125, {2, 3, 6})));
    }
    default: {  // sheared, scaled, turned by a quarter, rigidly moved
      Eigen::Matrix3d by = Eigen::Matrix3d::Identity();
      if (kind == 7) by(0, 1) = 1;
      if (kind == 8) by.diagonal() << 2, 1, 3;
      if (kind == 9) by << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      Frames frames = turned(lattice(27), by);
      if (kind == 10)
        for (std::size_t k = 1; k < 3; ++k) frames[k].colwise() += double(k) * Eigen::Vector3d(0.5, 1.5, 2.5);
      return scene_through(std::move(frames));
    }
  }
}

// Handmade scenes: few beads, coplanar or at one position, at frames or between them.
Scene handmade(std::uint64_t seed) {
  const Points simplex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Points solid{{0, 0, 1}, {4, 0, 2}, {0, 5, 5}, {6, 7, 3}, {2, 3, 4}, {-3, 2, 7}};
  const Points base{{0, 0, 0}, {5, 0, 1}, {0, 6, 0}, {1, 0, 7}, {6, 5, 4}};
  Points flat = solid, mirrored = solid, square = solid;
  for (auto& p : flat) p[2] = 0;
  for (auto& p : mirrored) p[2] = -p[2];
  for (std::size_t b = 0; b < 4; ++b) square[b][2] = 0;
  const auto with = [](Points points, const Points& more) {
    points.insert(points.end(), more.begin(), more.end());
    return points;
  };
  const Points apart = with(base, {{1, 1, 1}, {3, 3, 3}}), together = with(base, {{2, 2, 2}, {2, 2, 2}}),
               swapped = with(base, {{3, 3, 3}, {1, 1, 1}});
  const Points line{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}, {6, 6, 6}};
  const Points tent{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}};
  const auto bent = [&](double s, const Points& more) {
    return with({{2, 0, s}, {-2, 0, s}, {0, 2, -s}, {0, -2, -s}}, more);
  };
  const Points dodecagon{{5, 0, 0},  {4, 3, 0},   {3, 4, 0},   {0, 5, 0},  {-3, 4, 0}, {-4, 3, 0},
                         {-5, 0, 0}, {-4, -3, 0}, {-3, -4, 0}, {0, -5, 0}, {3, -4, 0}, {4, -3, 0}};
  Points quarter, opposite;
  for (const auto& p : dodecagon) quarter.push_back({-p[1], p[0], p[0]});
  for (const auto& p : solid) opposite.push_back({-p[0], -p[1], -p[2]});
  const std::vector<std::vector<Points>> all{
      {simplex, simplex},
      // A tetrahedron turns inside out: through a triangle with a bead inside, through a square, or both.
      {simplex, {{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{1, 0, 1}, {-1, 0, 1}, {0, 1, -1}, {0, -1, -1}}, {{1, 0, -1}, {-1, 0, -1}, {0, 1, 2}, {0, -1, 2}}},
      {simplex, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}},
      // A bead passes through a triangle, and leaves on the other side.
      {with(tent, {{0, 0, -1}}), with(tent, {{0, 0, 1}})},
      {with(tent, {{1, 0, -7}}), with(tent, {{1, 2, 17}})},
      // An octahedron that lacks a bead turns by a quarter.
      {{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
       {{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
      {solid, flat},
      {solid, mirrored},
      {solid, flat, mirrored},
      {solid, flat, solid},
      {flat, flat, solid},
      {solid, flat, flat, solid},
      {solid, square, square, solid},
      {solid, square, square, square},
      {line, line, flat, solid, line, line},
      // Beads meet inside the step, at its end, at a frame where they turn back or pass, and at the start.
      {apart, swapped},
      {apart, together},
      {apart, together, apart},
      {apart, together, swapped},
      {together, swapped},
      {together, together},
      // Beads swap positions along an edge of the hull.
      {{{1, 0, 1}, {1, 1, 0}, {1, 1, 1}, {1, 1, 0}, {1, 0, 1}, {0, 0, 0}},
       {{1, 0, 1}, {1, 1, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}},
      // Four beads bend through their plane, in which they lie on one circle: alone, and with others.
      {bent(-1, {}), bent(1, {})},
      {bent(-1, {{0, 0, 0}}), bent(0, {{0, 0, 0}}), bent(1, {{0, 0, 0}})},
      {bent(-1, {{1, 0, 0}, {0, 1, 1}}), bent(4, {{1, 0, 0}, {0, 1, 1}})},
      // In the middle each of four beads touches the sphere of the others, and no sign changes.
      {{{2, 2, 0}, {0, 2, 0}, {2, 0, 0}, {2, 2, 2}, {2, 0, 2}, {0, 0, 0}, {0, 0, 2}},
       {{0, 0, 2}, {2, 0, 2}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 2}, {2, 2, 0}}},
      {Points(6, {1, 2, 3}), solid, Points(6, {1, 2, 3}), Points(6, {1, 2, 3})},
      // A dodecagon of 3-4-5 triangles turns by a quarter.
      {dodecagon, quarter},
      // All events happen at u = 1/2.
      {solid, opposite},
      // Beads are coplanar at the start, and again sooner than a log's finest grid of times can tell.
      {{{0x1p-199, 0, 0}, {0, 0, 0}, {5, 0, 0}, {0, 0, 0}},
       {{0x1p-199, 0, 0}, {1, 0, 0}, {5, 1, 0}, {0, 0, 1}}},
      {{{0x1p-1000, 0, 0}, {0, 0, 0}, {5, 0, 0}, {0, 0, 0}},
       {{0x1p-1000, 0, 0}, {1, 0, 0}, {5, 1, 0}, {0, 0, 1}}},
  };
  return scene_through(all[seed % all.size()]);
}

Scene from_trajectory(const std::string& name, std::size_t frames, FrameMotion motion) {
  ReadOptions options;
  options.frames = {0, frames, 1};
  const Trajectory trajectory = read_trajectory(std::string(KDS_DATA_DIR) + "/trajectories/" + name, options);
  return {std::span(&trajectory, 1), std::vector<double>(trajectory.bead_count(), 1.9), motion};
}

LawScene instance_row(const std::string& name, bool judged = true) {
  const auto make = [name](std::uint64_t) {
    return Scene(read_instance(std::string(KDS_DATA_DIR) + "/" + name + ".txt"));
  };
  return {.name = name, .make = make, .judged = judged};
}

std::vector<LawScene> make_rows() {
  std::vector<LawScene> rows{
      {"ties", 40, ties},
      {"twins", 40, twins},
      {"lattice crossings", 72, lattice_crossing},
      {"lattice balls", 12, balls_on_lattice},
      {"resting grid", 4, resting_grid},
      {"wandering chain", 4, wandering_chain},
      {"creeping", 3, creeping},
      {"straight on", 8, straight_on},
      {"cells", 42, cells, {"closest", "contacts", "crossings"}},
      {"regular", 11, regular},
      {"handmade", 32, handmade},
      {.name = "wild",
       .seeds = 10,
       .make = [](std::uint64_t seed) { return Scene(wild_instance(seed)); },
       .judged = false},
      {"villin",
       1,
       [](std::uint64_t) { return from_trajectory("villin_hp36_300K.dcd", 2, FrameMotion::linear); },
       {"wrapped", "power", "contacts"}},
      {"villin lifted", 1,
       [](std::uint64_t) { return from_trajectory("villin_hp36_300K.dcd", 4, FrameMotion::lifted); }},
  };
  for (const Extreme& extreme : all_extremes())
    rows.push_back({.name = std::string(extreme.name),
                    .seeds = 5,
                    .make = [&extreme](std::uint64_t seed) { return extreme_scene(extreme, seed); },
                    .refused = extreme.refused});
  for (const char* name :
       {"d1_n20_linear", "d1_n20_degree3", "d2_n20_linear", "d2_n20_degree3", "d3_n20_linear",
        "w3_n20_linear", "w3_n20_linear_movingweights", "w3_n20_degree2_visible"})
    rows.push_back(instance_row(std::string("kinetic/") + name));
  for (const char* space : {"d2", "d3", "w3"})
    for (const char* kind :
         {"static", "half", "rigid", "gridrigid", "gridscale", "converge", "gridrand", "gridint", "swap"})
      rows.push_back(instance_row(std::string("kinetic/degenerate_") + space + "_n64_" + kind));
  for (const char* name :
       {"appearance_beside_a_block", "deg4-wildmix", "n5-2d-deg5-1e300", "rounding_mode_d2"})
    rows.push_back(instance_row(std::string("hostile/") + name, false));
  return rows;
}

}  // namespace

const std::vector<LawScene>& law_scenes() {
  static const std::vector<LawScene> rows = make_rows();
  return rows;
}

}  // namespace kds::test
