#pragma once
// Turns a certificate's function with constants (constants.h) into a function of beads alone, so that all
// views, error bounds and exact stages work unchanged. The constants are represented by *anchors*, extra
// beads of the search next to the certificate's beads. The first anchor is at the origin with all channels
// zero; one anchor per constant follows. A length is an anchor's radius, a squared length its weight, a
// vector or point its centre.

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "certificates/base/certificate.h"
#include "certificates/base/constants.h"

namespace kds {

/// A view that knows a certificate's constants. `anchors` is the first anchor.
template <class View, class Certificate>
class AnchoredView {
  using Constants = ConstantsOf<Certificate>;

 public:
  using Number = typename View::Number;
  static constexpr int dimension = View::dimension;
  static constexpr int degree = View::degree;

  [[gnu::always_inline]] AnchoredView(const View& view, const BeadId* anchors)
      : view_(view), anchors_(anchors) {}

  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, dimension> difference(BeadId i,
                                                                                          BeadId j) const {
    return view_.difference(i, j);
  }
  [[nodiscard, gnu::always_inline]] auto weight_difference(BeadId i, BeadId j) const {
    return view_.weight_difference(i, j);
  }
  [[nodiscard, gnu::always_inline]] auto radius_difference(BeadId i, BeadId j) const {
    return view_.radius_difference(i, j);
  }
  [[nodiscard, gnu::always_inline]] auto radius_sum(BeadId i, BeadId j) const {
    return view_.radius_sum(i, j);
  }

  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, dimension> position(BeadId bead) const {
    return view_.difference(bead, anchors_[0]);
  }
  template <int Power>
  [[nodiscard, gnu::always_inline]] Bernstein<Number, degree> constant(
      Constant<Power> Constants::*member) const {
    const BeadId anchor = anchor_of(member);
    if constexpr (Power == 1) {
      return view_.radius_difference(anchor, anchors_[0]);
    } else {
      // Also read the radius, a length not below the constant's square root, for filters whose bound is in
      // powers of the largest length.
      if constexpr (requires { view_.largest_length(); } || std::is_same_v<Number, Recorded>)
        static_cast<void>(view_.radius_difference(anchor, anchors_[0]));
      return view_.weight_difference(anchor, anchors_[0]);
    }
  }
  template <int Dimension>
  [[nodiscard, gnu::always_inline]] BernsteinVector<Number, degree, Dimension> constant(
      ConstantVector<Dimension> Constants::*member) const {
    return view_.difference(anchor_of(member), anchors_[0]);
  }
  template <int Dimension>
  [[nodiscard, gnu::always_inline]] BeadId place(ConstantPoint<Dimension> Constants::*member) const {
    return anchor_of(member);
  }
  [[nodiscard, gnu::always_inline]] BeadId place(ConstantBead Constants::*member) const {
    return anchor_of(member);
  }

 private:
  template <class Member>
  [[nodiscard, gnu::always_inline]] BeadId anchor_of(Member Constants::*member) const {
    return anchors_[1 + place_of_constant(member)];
  }

  const View& view_;
  const BeadId* anchors_;
};

template <class Certificate>
struct AnchoredFunction {
  static constexpr std::size_t own_beads = std::tuple_size_v<decltype(Certificate{}.beads)>;
  static constexpr std::size_t anchors = 1 + std::tuple_size_v<ConstantMembers<Certificate>>;
  static constexpr bool has_length = detail::is_among<Constant<1>, ConstantMembers<Certificate>>;
  static constexpr bool has_square = detail::is_among<Constant<2>, ConstantMembers<Certificate>>;
  static constexpr bool uses_weights = channels_of<Certificate>.weights || has_square;
  static constexpr bool uses_radii = channels_of<Certificate>.radii || has_length || has_square;
  static constexpr int lanes_up_to_degree = kds::lanes_up_to_degree<Certificate>;
  static constexpr CertificateType type = Certificate::type;

  std::array<BeadId, own_beads + anchors> beads{};
  bool wanted_side = true;
  const Certificate* certificate = nullptr;  ///< used in messages during a search

  [[nodiscard]] Identity identity() const { return certificate->identity(); }
  [[nodiscard]] bool side() const { return wanted_side; }

  template <MotionView View>
  [[nodiscard, gnu::always_inline]] static auto formula(const View& view,
                                                        const std::array<BeadId, own_beads + anchors>& of) {
    std::array<BeadId, own_beads> own;
    std::copy_n(of.begin(), own_beads, own.begin());
    return Certificate::formula(AnchoredView<View, Certificate>(view, of.data() + own_beads), own);
  }
};

}  // namespace kds
