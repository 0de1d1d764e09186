#pragma once
// Writes the results of a run: summary.json, events.csv, contacts.csv and report.html in --out, and the
// destinations --json, --dump, --events, --log and standard output.

#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/events/event_distribution.h"
#include "experiments/events/event_files.h"
#include "experiments/output/output_files.h"
#include "experiments/run/event_log_file.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/view/view_results.h"
#include "kds/event.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"

namespace kds {

class RunResults {
 public:
  /// `events` is the file that gets every event, if any, and `view` the page that shows the run.
  explicit RunResults(Destinations destinations, std::optional<std::filesystem::path> events = std::nullopt,
                      std::optional<std::filesystem::path> view = std::nullopt)
      : destinations_(std::move(destinations)),
        events_path_(std::move(events)),
        page_path_(std::move(view)) {}

  /// Returns whether a replay page is written. The page reads the structures while the run goes on.
  [[nodiscard]] bool has_page() const { return page_path_.has_value(); }
  /// Starts the output files of a run with these options once the input is accepted. The files listen to the
  /// run, which must not run after this object is destroyed. The scene must remain until `end_run`. In a
  /// certified run, contacts are reported with `add_certificate`.
  void begin(const Scene& scene, KineticRun& run, const RunOptions& options);
  /// Starts the files of --dump and --log for a run with these options. The lifetime rule of `begin` holds.
  void begin_dump_and_log(const RunOptions& options, const Scene& scene, KineticRun& run);
  /// Adds a frame that the run has just reached. The first frame is added when the structures have been
  /// built.
  void add_frame(std::size_t frame, const KineticRun& run);
  /// Adds the number of events of a structure in the step that starts at this frame.
  void add_step(const FrameStamp& frame, std::string_view structure, std::uint64_t events);
  /// Completes the page that shows the run. Must be called when all steps have been run.
  void end_run();
  /// Writes contacts.csv and possible_contacts.csv if the run has contacts.
  void add_certificate(const StrideCertificate& certificate, const Scene& scene);
  /// Adds the distributions of events, which are recorded for --out and --json.
  void add_distributions(RunReport& report) const;
  /// Writes the files of --out while the run goes on, in place of those of the last call. Lists that other
  /// options ask for appear at the end. Returns the reason if the directory cannot be replaced.
  [[nodiscard]] std::optional<std::string> deliver_so_far(const std::string& json);
  /// Delivers all results. `json` is the summary. `table` is printed unless --quiet is given or standard
  /// output carries the JSON. The files appear when all are complete.
  void deliver(const RunReport& report, const std::string& json, const std::string& table);

 private:
  /// Opens a file of --out that is written during the run. A live run copies such files into each result.
  [[nodiscard]] std::ostream& open_in_out(const std::string& name, bool is_live);
  void check_out() const;
  void write_out(const std::string& json, const std::filesystem::path& replay);

  Destinations destinations_;
  std::optional<std::filesystem::path> events_path_, page_path_;
  std::optional<AtomicFiles> files_;
  std::list<std::pair<std::string, UnnamedFile>> copied_;  // files of a live run, with their names
  std::optional<EventsCsv> events_;
  std::optional<EventDistributions> distributions_;
  std::optional<ContactsTable> contacts_;
  std::vector<std::string> contacts_files_;
  std::optional<AtomicFiles> every_event_file_;
  std::unique_ptr<EventListener> every_event_;
  std::optional<DumpedFrames> dumps_;
  std::optional<ContactsDump> dumped_contacts_;
  std::optional<EventLogWriter> log_;
  std::optional<ViewResults> view_;
};

}  // namespace kds
