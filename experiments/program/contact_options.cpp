#include "experiments/program/contact_options.h"

#include "motions/base/input_error.h"

namespace kds {

void check_contact_distance(const ContactDistance& distance) {
  if (distance.length == 0 && !distance.between_surfaces)
    throw InputError(
        "--cutoff: centres that coincide are no contact; expected a length above 0, or --surface");
}

std::optional<ContactDistance> contact_distance_of(const std::optional<double>& cutoff,
                                                   bool between_surfaces) {
  if (!cutoff && between_surfaces)
    throw InputError("--surface: measures --cutoff between surfaces; expected --cutoff LENGTH as well");
  if (!cutoff) return std::nullopt;
  const ContactDistance distance{*cutoff, between_surfaces};
  check_contact_distance(distance);
  return distance;
}

}  // namespace kds
