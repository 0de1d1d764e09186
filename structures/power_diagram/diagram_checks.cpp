#include "structures/power_diagram/diagram_checks.h"

#include "certificates/exact/exact_polynomial.h"
#include "structures/power_diagram/static_diagrams.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

template <int Dimension>
bool is_wrong_just_after(DiagramState<Dimension>& state) {
  if (state.simulator.kernel() == Kernel::fast) return false;
  return regularity_fault(
             state.triangulation, state.bead_count(), state.hidden.with_hosts(), false,
             [&](const auto& function) { return state.sign_just_after(function); }, state.absent)
      .has_value();
}

template <int Dimension>
std::optional<std::string> audit_of(const DiagramState<Dimension>& state, const Dyadic& time) {
  const bool start = time == Dyadic(0.0);
  const bool end = time == Dyadic(1.0);
  const bool frame = start || end;
  if (!state.has_cells()) return std::nullopt;  // at a frame only, where the answer is CGAL's
  if (!frame || !state.flat) {
    const auto built =
        frame ? static_diagram_at_end(state, start ? 0 : state.motion.degree())
              : static_diagram(state, std::span<const BeadId>(beads_present(state)), time, false);
    if ((!frame || state.triangulation.is_valid()) && built.cells == state.triangulation.finite_cells() &&
        built.hidden == state.hidden.beads())
      return std::nullopt;
  }
  // Degenerate positions have several regular triangulations: ours must satisfy the definition. Between
  // events what is zero at this very moment only is judged by its sign just after.
  return regularity_fault(
      state.triangulation, state.bead_count(), state.hidden.with_hosts(), state.flat,
      [&]<class Function>(const Function& function) {
        const auto& search = state.template search<Function>();
        const int sign = search.sign_at(function, time);
        return sign != 0 || frame ? sign : search.exact_function(function)->sign_after(time);
      },
      state.absent);
}

template bool is_wrong_just_after(DiagramState<2>&);
template bool is_wrong_just_after(DiagramState<3>&);
template std::optional<std::string> audit_of(const DiagramState<2>&, const Dyadic&);
template std::optional<std::string> audit_of(const DiagramState<3>&, const Dyadic&);

}  // namespace kds
