#pragma once
// The options --cutoff and --surface of commands whose contacts have a distance of their own.

#include <optional>

#include "experiments/program/option.h"
#include "structures/contacts/contact_distance.h"

namespace kds {

/// The largest value of --cutoff.
inline constexpr double largest_cutoff = 1e9;

/// Returns the option --surface.
template <class Options>
[[nodiscard]] Option<Options> surface_option(bool Options::*surface) {
  return flag_option("--surface", "measure the cutoff between the surfaces of beads (default: centres)",
                     surface);
}

/// Throws InputError if no contact can be within this distance: if it is 0 between centres.
void check_contact_distance(const ContactDistance& distance);

/// Returns the distance that --cutoff and --surface ask for, or nothing without --cutoff. Throws InputError
/// if --surface comes without --cutoff, and as check_contact_distance does.
[[nodiscard]] std::optional<ContactDistance> contact_distance_of(const std::optional<double>& cutoff,
                                                                 bool between_surfaces);

}  // namespace kds
