#include "structures/contacts/contact_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motions/curves/positions.h"
#include "motions/scene/near_pairs.h"

namespace kds {

template <int Dimension>
std::optional<std::string> contact_fault(const Curves<Dimension>& curves,
                                         const CertificateSearch<Contact>& search, const Dyadic& time,
                                         const PairsAsked& asked, std::span<const char> absent,
                                         const ContactSet& contacts) {
  const double u = time.round_down();
  const Eigen::Matrix3Xd centers = approximate_positions(curves, u);
  const std::vector<double> radii = approximate_radii(curves, u);
  // Exceeds by far what the rounding of times, control points' sums and squares can add to a distance.
  double largest = 0;
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    for (int k = 0; k <= curves.own_degree(); ++k) {
      for (int axis = 0; axis < Dimension; ++axis)
        largest = std::max(largest, std::abs(curves.coordinate(b, k, axis)));
      largest = std::max(largest, curves.radius(b, k));
    }
  }
  const double spare = 0x1p-40 * largest;
  const bool at_end = time == Dyadic(0.0) || time == Dyadic(1.0);
  std::optional<std::string> fault;
  std::size_t met = 0;
  const auto look_at = [&](BeadId a, BeadId b) {
    if (fault || !asked.asks({a, b})) return;
    if (!absent.empty() && (absent[a] != 0 || absent[b] != 0)) return;
    const double distance = (centers.col(a) - centers.col(b)).template head<Dimension>().stableNorm();
    const double gap = distance - radii[a] - radii[b];
    const bool is_clear = std::isfinite(gap) && std::abs(gap) > 4 * spare && spare > 0x1p-900;
    const int sign = is_clear ? (gap > 0 ? 1 : -1) : search.sign_at({{a, b}, 1}, time);
    const bool in_contact = contacts.contains({a, b});
    met += in_contact ? 1 : 0;
    if (sign == 0 && at_end) return;
    if (in_contact != (sign <= 0))
      fault = fmt::format("beads {} and {} {}, but are {} as in contact", a, b,
                          sign > 0 ? "are apart" : "meet", in_contact ? "known" : "not known");
  };
  if (std::isfinite(4 * largest)) {
    std::vector<double> larger = radii;
    for (double& radius : larger) radius += 4 * spare;
    visit_near_pairs(centers, larger, look_at);
  } else {
    for (BeadId a = 0; a < curves.bead_count(); ++a)
      for (BeadId b = a + 1; b < curves.bead_count(); ++b) look_at(a, b);
  }
  if (!fault && met != contacts.size())
    fault =
        fmt::format("{} of {} pairs known as in contact are apart", contacts.size() - met, contacts.size());
  return fault;
}

template std::optional<std::string> contact_fault(const Curves<2>&, const CertificateSearch<Contact>&,
                                                  const Dyadic&, const PairsAsked&, std::span<const char>,
                                                  const ContactSet&);
template std::optional<std::string> contact_fault(const Curves<3>&, const CertificateSearch<Contact>&,
                                                  const Dyadic&, const PairsAsked&, std::span<const char>,
                                                  const ContactSet&);

}  // namespace kds
