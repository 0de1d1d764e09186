#pragma once
// The options of `kds contacts`, and its results before they are written.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "experiments/contacts/contacts_report.h"
#include "experiments/contacts/follow_contacts.h"
#include "experiments/output/output_files.h"
#include "experiments/program/command_line.h"

namespace kds {

struct ContactsOptions {
  ContactsTask task;
  Destinations destinations;
  std::optional<std::filesystem::path> view;  ///< page that shows the contacts of beads
  LiveOutput live;
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] ContactsOptions parse_contacts_options(const Arguments& arguments);

/// Makes the callbacks for a run over this live scene.
using MakeHooks = std::function<LiveHooks<ContactsReport>(const Scene& scene)>;

struct ContactsFound {
  std::unique_ptr<const Scene> scene;
  std::unique_ptr<ContactsReport> report;
  ContactsFigures figures;
};

/// Reads the inputs, follows the contacts and, if the task asks for it, certifies them. Each warning goes to
/// `warn` as one line; one warning says why there are no contacts. Throws InputError.
[[nodiscard]] ContactsFound find_contacts(const ContactsTask& task,
                                          const std::function<void(std::size_t, std::size_t)>& progress,
                                          const std::function<void(const std::string&)>& warn,
                                          const MakeHooks& hooks_over = {});

}  // namespace kds
