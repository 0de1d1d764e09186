#include "structures/power_diagram/diagram_checks.h"

#include <algorithm>

#include "certificates/exact/exact_polynomial.h"
#include "motions/views/integer_view.h"
#include "structures/power_diagram/hull_winding.h"
#include "structures/power_diagram/static_diagrams.h"
#include "structures/triangulation/regularity_fault.h"
#include "structures/triangulation/regularity_proof.h"

namespace kds {

namespace {

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
