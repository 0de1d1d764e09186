#pragma once
// Checks whether a set of contacts is right at a given time, with a grid over all beads. The sign of each
// near pair's function is computed at that time, in integers if doubles do not decide.

#include <optional>
#include <span>
#include <string>

#include "certificates/search/certificate_search.h"
#include "certificates/types/contact.h"
#include "structures/contacts/contact_set.h"

namespace kds {

/// Returns a fault, or none. At the ends of a step, pairs that touch exactly may be in contact or not,
/// because changes at a frame belong to the next step, and changes before the first frame belong to none.
/// `absent` marks beads that take no part; if it is empty, all beads take part.
template <int Dimension>
[[nodiscard]] std::optional<std::string> contact_fault(const Curves<Dimension>& curves,
                                                       const CertificateSearch<Contact>& search,
                                                       const Dyadic& time, const PairsAsked& asked,
                                                       std::span<const char> absent,
                                                       const ContactSet& contacts);

}  // namespace kds
