#include "structures/power_diagram/diagram_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "certificates/exact/exact_polynomial.h"
#include "motions/views/integer_view.h"
#include "structures/power_diagram/diagram_state.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/regularity_fault.h"
#include "structures/triangulation/regularity_proof.h"

namespace kds {

namespace {

/// Returns the edges of the hull in order around it, starting with the edge of an infinite cell.
std::vector<std::array<BeadId, 2>> edges_around(const DiagramState<2>& state, CellId start) {
  std::vector<std::array<BeadId, 2>> edges;
  CellId cell = start;
  do {
    const auto edge = *hull_face<2>(state.beads_of(cell));
    edges.push_back(edge);
    cell = state.neighbor(cell, state.place_of(cell, edge[0]));  // shares the edge's second bead
  } while (cell != start);
  return edges;
}

/// Returns whether the edges make one full turn. A direction is ahead if its angle to the first edge is
/// less than a quarter turn. Consecutive edges turn by less than half a turn, so no edge leaps over the
/// directions that are not ahead. The edges therefore enter the directions ahead once in each full turn.
bool polygon_turns_once(DiagramState<2>& state, CellId start) {
  const auto edges = edges_around(state, start);
  int entries = 0;
  bool is_ahead = true;  // the first edge
  for (std::size_t e = 1; e <= edges.size(); ++e) {
    const bool was_ahead = is_ahead;
    is_ahead = e == edges.size() || state.sign_just_after(same_turn<2>(edges[0], edges[e])) > 0;
    if (is_ahead && !was_ahead) ++entries;
  }
  return entries == 1;
}

/// Returns the faces of the hull around a vertex of an infinite cell, in order, each with the vertex first.
std::vector<std::array<BeadId, 3>> faces_around(const DiagramState<3>& state, CellId start, BeadId vertex) {
  std::vector<std::array<BeadId, 3>> faces;
  CellId cell = start;
  do {
    auto face = *hull_face<3>(state.beads_of(cell));
    std::rotate(face.begin(), std::find(face.begin(), face.end(), vertex), face.end());
    faces.push_back(face);
    cell = state.neighbor(cell, state.place_of(cell, face[1]));  // shares the edge to the face's third bead
  } while (cell != start);
  return faces;
}

/// Returns whether the faces around a vertex wind around it once. Each face supports their cone if no bead
/// of the cone is outside the face. The faces then cover the boundary of the cone equally often everywhere:
/// once, if the middle of the first face lies in no other face.
bool cone_winds_once(DiagramState<3>& state, CellId start, BeadId vertex) {
  const auto faces = faces_around(state, start, vertex);
  if (faces.size() < 5) return true;
  const auto side = [&](const std::array<BeadId, 3>& face, BeadId bead) {  // positive inside
    if (bead == face[1] || bead == face[2]) return 0;
    return state.sign_just_after(Orientation<3>({face[0], face[1], face[2], bead}, -1));
  };
  const auto middle_is_left_of = [&](BeadId from, BeadId to) {
    CentroidInside<3> inside;
    inside.beads = {faces[0][0], faces[0][1], faces[0][2], from, to};
    return state.sign_just_after(inside) >= 0;
  };
  for (const auto& face : faces) {
    for (const auto& other : faces) {
      if (side(face, other[1]) < 0) return false;
    }
  }
  return std::none_of(faces.begin() + 1, faces.end(), [&](const auto& face) {
    return side(faces[0], face[1]) == 0 && side(faces[0], face[2]) == 0 &&
           middle_is_left_of(vertex, face[1]) && middle_is_left_of(face[2], vertex);
  });
}

/// Returns whether a polygon that turns one way makes one full turn, as polygon_turns_once does, in doubles.
bool seems_to_turn_once(const std::vector<Eigen::Vector2d>& corners) {
  const auto edge = [&](std::size_t i) -> Eigen::Vector2d {
    return corners[(i + 1) % corners.size()] - corners[i % corners.size()];
  };
  int entries = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    entries += edge(i).dot(edge(0)) <= 0 && edge(i + 1).dot(edge(0)) > 0 ? 1 : 0;
  return entries <= 1;
}

/// Returns whether the faces around a vertex seem to wind around it once: their plane section does, across
/// the sum of their normals. Where beads lie in one plane with the vertex, nothing is seen.
bool cone_seems_to_wind_once(const std::vector<std::array<BeadId, 3>>& faces, const Snapshot<3>& end) {
  if (faces.size() < 5) return true;
  const auto from_vertex = [&](BeadId bead) {
    Eigen::Vector3d d;
    for (int axis = 0; axis < 3; ++axis)
      d[axis] = end.coordinate(bead, 0, axis) - end.coordinate(faces[0][0], 0, axis);
    return d;
  };
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
  for (const auto& face : faces) outward += from_vertex(face[1]).cross(from_vertex(face[2]));
  const Eigen::Vector3d across = outward.unitOrthogonal(), along = outward.cross(across).normalized();
  std::vector<Eigen::Vector2d> corners;
  for (const auto& face : faces) {
    const Eigen::Vector3d d = from_vertex(face[1]);
    const double inward = -d.dot(outward);
    if (!(inward > 0)) return true;
    corners.emplace_back(d.dot(across) / inward, d.dot(along) / inward);
  }
  return seems_to_turn_once(corners);
}

template <int Dimension>
bool is_wrong_at(DiagramState<Dimension>& state, CellId cell) {
  if (!state.triangulation.is_live(cell)) return false;
  const auto& v = state.beads_of(cell);
  if (!state.is_infinite(cell) && state.sign_just_after(Orientation<Dimension>(v, 1)) <= 0) return true;
  for (int i = 0; i <= Dimension; ++i) {
    if (!state.is_regular_just_after(v, state.beads_of(state.neighbor(cell, i)), state.apex(cell, i)))
      return true;
  }
  return false;
}

}  // namespace

bool hull_winds_once(DiagramState<2>& state, std::span<const CellId> touched) {
  const auto on_hull = std::find_if(touched.begin(), touched.end(), [&](CellId cell) {
    return state.triangulation.is_live(cell) && state.is_infinite(cell);
  });
  return on_hull == touched.end() || polygon_turns_once(state, *on_hull);
}

bool hull_winds_once(DiagramState<3>& state, std::span<const CellId> touched) {
  std::vector<BeadId> seen;
  for (const CellId cell : touched) {
    if (!state.triangulation.is_live(cell) || !state.is_infinite(cell)) continue;
    const auto face = hull_face<3>(state.beads_of(cell));
    for (const BeadId vertex : *face) {
      if (std::find(seen.begin(), seen.end(), vertex) != seen.end()) continue;
      seen.push_back(vertex);
      if (!cone_winds_once(state, cell, vertex)) return false;
    }
  }
  return true;
}

bool hull_seems_to_wind_once(const DiagramState<2>& state, const Snapshot<2>& end) {
  for (CellId cell = 0; cell < state.triangulation.cells().size(); ++cell) {
    if (!state.triangulation.is_live(cell) || !state.is_infinite(cell)) continue;
    std::vector<Eigen::Vector2d> corners;
    for (const auto& edge : edges_around(state, cell))
      corners.emplace_back(end.coordinate(edge[0], 0, 0), end.coordinate(edge[0], 0, 1));
    return seems_to_turn_once(corners);
  }
  return true;
}

bool hull_seems_to_wind_once(const DiagramState<3>& state, const Snapshot<3>& end) {
  std::vector<char> seen(end.bead_count(), 0);
  for (CellId cell = 0; cell < state.triangulation.cells().size(); ++cell) {
    if (!state.triangulation.is_live(cell) || !state.is_infinite(cell)) continue;
    const auto face = hull_face<3>(state.beads_of(cell));
    for (const BeadId vertex : *face) {
      if (std::exchange(seen[vertex], 1) == 0 &&
          !cone_seems_to_wind_once(faces_around(state, cell, vertex), end))
        return false;
    }
  }
  return true;
}

template <int Dimension>
bool is_wrong_just_after(DiagramState<Dimension>& state) {
  if (state.simulator.kernel() == Kernel::fast) return false;
  // A function can turn negative only if it is zero now, which happens only at touched cells. All other cells
  // are as correct as they were before.
  const bool known = !state.touched.empty() && state.touched_moment == state.simulator.moment() &&
                     state.touched.size() < state.triangulation.live_count();
  if (state.hidden.empty() && known) {
    return std::any_of(state.touched.begin(), state.touched.end(),
                       [&](CellId cell) { return is_wrong_at(state, cell); }) ||
           !hull_winds_once(state, std::span<const CellId>(state.touched));
  }
  return regularity_fault(
             state.triangulation, state.bead_count(), state.hidden.with_hosts(), false,
             [&](const auto& function) { return state.sign_just_after(function); },
             state.present_beads.absent())
      .has_value();
}

template <int Dimension>
std::optional<std::string> audit_of(const DiagramState<Dimension>& state, const Dyadic& time) {
  if (!state.has_cells()) return std::nullopt;  // checked only at frames, by comparison with CGAL
  const bool start = time == Dyadic(0.0);
  const bool frame = start || time == Dyadic(1.0);
  const auto& t = state.triangulation;
  const std::vector<HiddenBead> hidden = state.hidden.with_hosts();
  const std::span<const char> absent = state.present_beads.absent();
  return state.motion.visit([&](const auto& curves) -> std::optional<std::string> {
    const KeptMoment positions(curves, time);
    const auto sign = [&]<class Function>(const Function& function) {
      int now = sgn(Function::formula(positions, function.beads).scaled[0]);
      if constexpr (requires { function.sign; }) now *= function.sign;
      if (now != 0 || frame) return now;
      // The function is zero only at this very moment: its sign just after decides.
      return state.template search<Function>().exact_function(function)->sign_after(time);
    };
    const SignsBy<Dimension, decltype(sign)> judge(sign);
    const RoundedPositions<Dimension> rounded(state.motion, time);
    if (!frame && is_proved_regular(t, hidden, rounded, absent, &judge)) return std::nullopt;
    if (!frame || !state.flat) {
      const auto built =
          frame ? static_diagram_at_end(state, start ? 0 : state.motion.degree())
                : static_diagram(state, std::span<const BeadId>(state.present_beads.all()), time, false);
      if ((!frame || t.is_valid()) && built.cells == t.finite_cells() && built.hidden == state.hidden.beads())
        return std::nullopt;
    }
    // Degenerate positions have several regular triangulations: this one must satisfy the definition.
    return regularity_fault(t, state.bead_count(), hidden, state.flat, judge, absent);
  });
}

template bool is_wrong_just_after(DiagramState<2>&);
template bool is_wrong_just_after(DiagramState<3>&);
template std::optional<std::string> audit_of(const DiagramState<2>&, const Dyadic&);
template std::optional<std::string> audit_of(const DiagramState<3>&, const Dyadic&);

}  // namespace kds
