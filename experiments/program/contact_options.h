#pragma once
// The options --cutoff and --surface of commands whose contacts have a distance of their own.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/option.h"
#include "structures/contacts/contact_distance.h"

namespace kds {

/// The values of --cutoff and --surface: a distance for each length.
struct ContactDistances {
  std::vector<double> lengths;  ///< ascending; empty without --cutoff
  bool between_surfaces = false;

  [[nodiscard]] ContactDistance operator[](std::size_t k) const { return {lengths[k], between_surfaces}; }
  /// Returns the shortest distance, or nothing without --cutoff.
  [[nodiscard]] std::optional<ContactDistance> first() const {
    return lengths.empty() ? std::nullopt : std::optional((*this)[0]);
  }
  /// Throws InputError for --surface without --cutoff, and for a distance of 0 between centres, within which
  /// there are no contacts.
  void check() const;
};

/// Returns the options --cutoff and --surface. --cutoff takes a length, or with the separator ':' one or two
/// as in 4.5:6, or with ',' a list as in 6.5,8.
[[nodiscard]] OptionList<ContactDistances> contact_options(const std::string& help, char separator = '\0');

}  // namespace kds
