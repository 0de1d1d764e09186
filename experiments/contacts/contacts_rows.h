#pragma once
// The rows that the texts, the files and the page of `kds contacts` have in common.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/contacts/contacts_report.h"
#include "experiments/output/table.h"

namespace kds {

/// A pair with the names of its elements.
struct PairRow {
  const PairLifetimes* pair;
  const ContactsReport* report;
  ContactBoundsOfPair bounds;  ///< only with a certificate

  [[nodiscard]] const std::string& first() const { return report->elements.names[pair->first]; }
  [[nodiscard]] const std::string& second() const { return report->elements.names[pair->second]; }
};
/// Returns the columns of pairs. Headings name the unit of time.
[[nodiscard]] Table<PairRow> pair_columns(const ContactsReport& report, const ContactsFigures& figures);
/// Returns at most `most` pairs, those with the most contacts first, then those in contact longest.
[[nodiscard]] std::vector<PairRow> busiest_of(const ContactsReport& report, const ContactsFigures& figures,
                                              std::size_t most);

/// The figures of exact contacts, or of contacts counted at samples of one spacing (FrameContacts).
struct SamplingRow {
  /// Number, mean length in units of the clock, and share of the time in contact.
  struct Figures {
    std::uint64_t contacts = 0;
    double length = 0, occupancy = 0;
  };

  std::optional<double> frames_apart;  ///< spacing of the samples; empty: exact
  std::optional<std::size_t> samples;
  std::optional<std::uint64_t> found;  ///< exact contacts in which a sample lies
  std::array<std::optional<Figures>, FrameContacts::kinds> figures;  ///< by FrameContacts::Kind
};
/// Keys of columns and names of curves, by FrameContacts::Kind.
inline constexpr std::array<const char*, FrameContacts::kinds> sampling_kinds{"plain", "bridged", "dual"};
/// Returns the exact row, then the rows of samples from the smallest spacing on.
[[nodiscard]] std::vector<SamplingRow> sampling_rows(const ContactsReport& report);
/// Returns "one frame in 4", for example.
[[nodiscard]] std::string name_of_sampling(const SamplingRow& row);
[[nodiscard]] Table<SamplingRow> sampling_columns(const ContactsReport& report);

/// Returns the figures of all pairs with their intervals, as pairs of a label and a line.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> overall_lines(const ContactsReport& report,
                                                                             const ContactsFigures& figures);
/// Returns the statements of the certificate, as pairs of a label and a line.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> certified_lines(
    const ContactsReport& report, const ContactsFigures& figures);

}  // namespace kds
