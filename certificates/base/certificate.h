#pragma once
// The requirements on a certificate type. A certificate names a few beads and has one function of time, which
// is positive while the certificate holds. The function is written once, over a MotionView. The function must
// be homogeneous in lengths (weights count as squares). The function is independent of the origin unless it
// uses positions or has a constant point; constants.h describes these and the constants of a type. Everything
// else is derived from the function: the floating-point filter and its error bound, processing of four
// certificates at once, exact root isolation, and the order of simultaneous failures.
//
// The function is a static `formula(view, beads)`, or its negative if side() is false. A type that uses
// weights or radii declares `static constexpr bool uses_weights = true` (`uses_radii`). If motions have
// degree 2 or 3 and speed matters, it declares `static constexpr int lanes_up_to_degree = 3`.

#include <concepts>
#include <cstddef>
#include <tuple>

#include "certificates/base/certificate_type.h"
#include "motions/views/motion_view.h"

namespace kds {

/// The channels that a function uses besides the centres of beads, as declared by `uses_weights` and
/// `uses_radii`.
template <class F>
inline constexpr Channels channels_of = [] {
  Channels channels;
  if constexpr (requires { F::uses_weights; }) channels.weights = F::uses_weights;
  if constexpr (requires { F::uses_radii; }) channels.radii = F::uses_radii;
  return channels;
}();

/// Whether a function is defined in lifted motion, where weights between frames are not curves; by default
/// true if the function uses no radii. A type that uses weights beyond lifts declares `static constexpr bool
/// suits_lifted_motion = false`.
template <class F>
inline constexpr bool suits_lifted_motion = [] {
  if constexpr (requires { F::suits_lifted_motion; }) return F::suits_lifted_motion;
  return !channels_of<F>.radii;
}();

/// The number of beads of a function.
template <class F>
inline constexpr std::size_t bead_arity = std::tuple_size_v<decltype(F{}.beads)>;

/// The argument of a formula: an array of beads, or a type that holds further parameters too.
template <class F>
using BeadsOf = decltype(F{}.beads);

/// Returns the beads 0, 1, 2 ..., by which formulas over lanes name their arguments. Further parameters are
/// kept.
template <class F>
[[nodiscard]] constexpr BeadsOf<F> argument_numbers(BeadsOf<F> beads = {}) {
  for (std::size_t argument = 0; argument < bead_arity<F>; ++argument)
    beads[argument] = static_cast<BeadId>(argument);
  return beads;
}

/// The highest degree of motions, 0 to 3, whose certificates are searched four at a time; others are searched
/// one at a time. Each degree takes a second or more to compile. The default is 1. Over lifted motion, types
/// that use weights are always searched four at a time.
template <class F>
inline constexpr int lanes_up_to_degree = [] {
  if constexpr (requires { F::lanes_up_to_degree; }) return F::lanes_up_to_degree;
  return 1;
}();

/// A function of a few beads over this motion. Over a lifted motion, which has no meaningful radii, it must
/// not use radii.
template <class F, class M>
concept FunctionOfBeads =
    Motion<M> && !(lifted<M> && channels_of<F>.radii) &&
    requires(const F& f, const RecordingView<M::dimension, lifted<M>, channels_of<F>>& view) {
  {
    F {}
    } -> std::same_as<F>;
  F::formula(view, f.beads).degree;
};

/// Returns the function itself in the view's number type.
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
