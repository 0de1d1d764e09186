#include "structures/hierarchy/signs_just_after.h"

#include "structures/enclosing_sphere/membership_signs.h"

namespace kds {

template <int Dimension>
struct SignsJustAfter<Dimension>::Sign {
  const SignsJustAfter& self;

  int operator()(const Orientation<Dimension>& c) const {
    return self.orientations_->sign_just_after(kernel(), c, self.simulator_.now(), self.stages_);
  }
  template <class Certificate>
  int operator()(const Certificate& c) const {
    const auto& failed = self.present;
    if (failed && failed->is_of(c)) return c.side() == failed->side ? -1 : 1;
    const CertificateSearch<Certificate>& search = self.tables_.template of<Certificate>().search();
    if constexpr (std::same_as<Certificate, typename PresentFailure<Dimension>::OfFull>) {
      if (kernel() == Kernel::filtered && failed && failed->shares_root_with(c)) {
        const int sign = search.sign_after_failure(c, *failed->of_full, self.simulator_.now(), self.stages_);
        if (sign != 0) return sign;
      }
    }
    return search.sign_just_after(kernel(), c, self.simulator_.now(), self.stages_);
  }
  [[nodiscard]] Kernel kernel() const { return self.simulator_.kernel(); }
};

template <int Dimension>
int SignsJustAfter<Dimension>::membership(const Basis& basis, BeadId bead, bool inside,
                                          int orientation) const {
  return MembershipSigns<Dimension, Sign>(curves_, radii_, {*this})
      .membership(basis, bead, inside, orientation);
}

template <int Dimension>
int SignsJustAfter<Dimension>::orientation(const Basis& basis) const {
  return MembershipSigns<Dimension, Sign>(curves_, radii_, {*this}).orientation(basis);
}

template class SignsJustAfter<2>;
template class SignsJustAfter<3>;

}  // namespace kds
