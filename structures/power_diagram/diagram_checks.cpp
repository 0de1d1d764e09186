#include "structures/power_diagram/diagram_checks.h"

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
    cell = state.neighbor(cell, state.vertex_index(cell, edge[0]));  // shares the edge's second bead
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
    cell =
        state.neighbor(cell, state.vertex_index(cell, face[1]));  // shares the edge to the face's third bead
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

template <int Dimension>
bool is_wrong_just_after(DiagramState<Dimension>& state) {
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
