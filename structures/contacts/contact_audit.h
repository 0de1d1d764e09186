#pragma once
// Whether a set of contacts is right at a time: by a grid over all beads, and the sign of each near pair's
// function there, on integers where doubles do not tell.

#include <optional>
#include <span>
#include <string>

#include "certificates/search/certificate_search.h"
#include "certificates/types/contact.h"
#include "structures/contacts/contact_set.h"

namespace kds {

/// What is wrong, or nothing. At the ends of a step pairs that touch exactly may be in contact or not: what
/// happens at a frame is the next step's, what happens before the first is nobody's. `absent` marks beads
/// that take no part; empty: all do.
template <int Dimension>
[[nodiscard]] std::optional<std::string> contact_fault(const Curves<Dimension>& curves,
                                                       const CertificateSearch<Contact>& search,
                                                       const Dyadic& time, const PairsAsked& asked,
                                                       std::span<const char> absent,
                                                       const ContactSet& contacts);

}  // namespace kds
