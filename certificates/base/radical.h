#pragma once
// What a radical certificate type must offer. It holds while A + B sqrt(D) is positive, for polynomials A, B
// and D of a few beads' motions. The sign follows from those of A, B and of the norm A^2 - B^2 D, each of
// them up to a positive factor, and its zeros are among the norm's. D itself is never asked for. But neither
// D nor such a factor may turn negative while the certificate is in use, or the sign means nothing: the type
// says why they do not, and, if it has `is_usable`, whether that is so during a short time.
//
// The function may be subject to a condition, another radical: it counts as negative where that is. While
// A + B sqrt(D) is positive the condition must not change sign.

#include <concepts>

#include "certificates/base/certificate.h"

namespace kds {

/// The sign of A + B sqrt(D) from those of A, B and the norm. Where 0 among these means that a filter does
/// not know the sign, so does 0 as the answer, and any other answer is right.
[[nodiscard]] constexpr int sign_of_radical(int a, int b, int norm) {
  if (a == b) return a;
  return norm > 0 ? a : norm < 0 ? b : 0;  // the greater in size decides
}

/// The three polynomials of a radical, each a function of beads.
template <class R, class M>
concept RadicalOf = FunctionOfBeads<typename R::Rational, M> && FunctionOfBeads<typename R::Root, M> &&
    FunctionOfBeads<typename R::Norm, M>;

template <class C, class M>
concept RadicalCertificateFor = NamedCertificate<C> && RadicalOf<typename C::Radical, M> &&
    requires(const C& certificate) {  // side() is false: positive where the radical is negative
  { certificate.root_sign() } -> std::same_as<int>;  // 1 or -1, by which B is to be multiplied
};

/// A radical certificate type with a condition, at least for some motions.
template <class C, class M>
concept ConditionalFor = RadicalOf<typename C::Condition, M> &&
    requires(const C& certificate, const M& motion) {
  { certificate.conditional(motion) } -> std::same_as<bool>;
};

}  // namespace kds
