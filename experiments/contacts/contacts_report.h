#pragma once
// The outputs of `kds contacts`: tables of pairs and of samples.

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "experiments/contacts/certify_contacts.h"
#include "experiments/contacts/follow_contacts.h"
#include "experiments/output/result_json.h"

namespace kds {

/// The figures of a report, computed once.
struct ContactsFigures {
  std::vector<PairLifetimes> pairs;
  LifetimeFigures all;
  Survival survival;  ///< thinned for plots
  std::optional<ContactsCertificate> certificate = {};
};
[[nodiscard]] ContactsFigures figures_of(const ContactsReport& report);

/// Adds the members of contacts.json to `json`.
void add_contacts(const ContactsReport& report, const ContactsFigures& figures, Json& json);
[[nodiscard]] std::string contacts_csv(const ContactsReport& report, const ContactsFigures& figures);
[[nodiscard]] std::string frames_csv(const ContactsReport& report);
void write_intervals_csv(const ContactsReport& report, const ContactsFigures& figures, std::ostream& stream);
/// Writes the possible contacts of a certificate.
void write_possible_csv(const ContactsReport& report, const ContactsCertificate& certificate,
                        std::ostream& stream);
/// Returns the text on the terminal: the table of samples, the certificate, the figures of all pairs, and
/// the pairs with the most contacts.
[[nodiscard]] std::string contacts_text(const ContactsReport& report, const ContactsFigures& figures);
}  // namespace kds
