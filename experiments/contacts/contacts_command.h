#pragma once
// The options of `kds contacts`.

#include <filesystem>
#include <optional>

#include "experiments/contacts/follow_contacts.h"
#include "experiments/output/output_files.h"
#include "experiments/program/command_line.h"

namespace kds {

struct ContactsOptions {
  ContactsTask task;
  Destinations destinations;
  std::optional<std::filesystem::path> view;  ///< page that shows the contacts of beads
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] ContactsOptions parse_contacts_options(const Arguments& arguments);

}  // namespace kds
