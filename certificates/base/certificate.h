#pragma once
// What a certificate type must offer. It names a few beads and has one function of time, written once over a
// MotionView: positive while the certificate holds. The function must be homogeneous in lengths (weights
// count as squares). It does not depend on the origin unless it asks for positions or has a constant point;
// these and constants of the type are in constants.h. Everything else is derived: the floating-point filter
// and its error bound, four certificates at once, the exact isolation, the order of simultaneous failures.
//
// The function is a static `formula(view, beads)`, or its negative where side() is false. One that asks for
// weights or radii says so: `static constexpr bool uses_weights = true` (`uses_radii`). Where motions are of
// degree 2 or 3 and speed matters, `static constexpr int lanes_up_to_degree = 3`.

#include <concepts>
#include <cstddef>
#include <tuple>

#include "certificates/base/certificate_type.h"
#include "motions/views/motion_view.h"
#include "motions/views/recording_view.h"

namespace kds {

/// What a function asks of beads besides their centres: it says so by `uses_weights` and `uses_radii`.
template <class F>
inline constexpr Channels channels_of = [] {
  Channels channels;
  if constexpr (requires { F::uses_weights; }) channels.weights = F::uses_weights;
  if constexpr (requires { F::uses_radii; }) channels.radii = F::uses_radii;
  return channels;
}();

/// How many beads a function is of.
template <class F>
inline constexpr std::size_t bead_places = std::tuple_size_v<decltype(F{}.beads)>;

/// What a formula is about: beads and, where that is no plain array, what else is in it.
template <class F>
using BeadsOf = decltype(F{}.beads);

/// The same with a bead's place, 0, 1, 2 ..., for each bead: how formulas over lanes name them.
template <class F>
[[nodiscard]] constexpr BeadsOf<F> in_places(BeadsOf<F> beads = {}) {
  for (std::size_t place = 0; place < bead_places<F>; ++place) beads[place] = static_cast<BeadId>(place);
  return beads;
}

/// Searches go four at a time in motions up to this degree, 0 to 3, and one at a time in others. Each takes a
/// second or more to compile: 1 where the type says nothing. Over lifted motion types that ask for weights
/// always go so.
template <class F>
inline constexpr int lanes_up_to_degree = [] {
  if constexpr (requires { F::lanes_up_to_degree; }) return F::lanes_up_to_degree;
  return 1;
}();

/// A function of a few beads over this motion. Over a lifted motion, whose radii mean nothing, it must not
/// ask for radii.
template <class F, class M>
concept FunctionOfBeads =
    Motion<M> && !(lifted<M> && channels_of<F>.radii) &&
    requires(const F& f, const RecordingView<M::dimension, lifted<M>, channels_of<F>>& view) {
  {
    F {}
    } -> std::same_as<F>;
  F::formula(view, f.beads).degree;
};

/// The function itself, in the view's numbers.
template <class F, MotionView View>
[[nodiscard]] auto function_of(const F& f, const View& view) {
  const auto value = F::formula(view, f.beads);
  if constexpr (requires { f.side(); }) {
    return f.side() ? value : -value;
  } else {
    return value;
  }
}

template <class C, class M>
concept CertificateFor = FunctionOfBeads<C, M> && NamedCertificate<C>;

}  // namespace kds
