#include "experiments/run/run_results.h"

#include <filesystem>
#include <tuple>

#include "experiments/output/output_files.h"
#include "experiments/output/report_page.h"
#include "experiments/run/replay_labels.h"
#include "structures/session/event_writers.h"

namespace kds {

void RunResults::begin(const Scene& scene, KineticRun& run, const RunOptions& options) {
  const bool certified = options.certify;
  if (destinations_.out) files_.emplace(*destinations_.out, "--out", destinations_.replace);
  if (page_path_) {
    ViewRequest request;
    request.page = page_path_;
    if (files_ && lies_in(*page_path_, *destinations_.out)) request.page_files = &*files_;
    view_.emplace(request, replay_labels(options, "run"), scene, run);
  }
  if (events_path_) {
    every_event_ = make_event_writer(*events_path_, every_event_file_.emplace().open(*events_path_), scene);
    run.simulator().listen(*every_event_);
  }
  if (destinations_.out || destinations_.json) {
    distributions_.emplace(run, scene);
    run.simulator().listen(*distributions_);
  }
  if (!files_) return;
  events_.emplace(open_in_out("events.csv", scene.is_live()), scene.stamp(0).picoseconds.has_value());
  if (has_contacts(run)) contacts_files_.emplace_back(contacts_file);
  if (has_contacts(run) && certified) contacts_files_.emplace_back(possible_contacts_file);
  if (!has_contacts(run) || certified) return;
  contacts_.emplace(open_in_out(std::string(contacts_file), scene.is_live()), scene);
  run.simulator().listen(*contacts_);
}

std::ostream& RunResults::open_in_out(const std::string& name, bool is_live) {
  if (!is_live) return files_->open(name);
  return copied_.emplace_back(std::piecewise_construct, std::tuple(name), std::tuple()).second.stream();
}

void RunResults::check_out() const {
  files_->check();
  for (const auto& [name, file] : copied_) file.check();
}

void RunResults::write_out(const std::string& json, const std::filesystem::path& replay) {
  for (auto& [name, file] : copied_) file.copy_to(files_->open(name));
  files_->check();
  files_->write("summary.json", json);
  ReportLinks links{{"summary.json", "events.csv"}, replay};
  links.data.insert(links.data.end(), contacts_files_.begin(), contacts_files_.end());
  write_report(*files_, report_name, json, links);
}

std::optional<std::string> RunResults::deliver_so_far(const std::string& json) {
  write_out(json, {});
  return files_->commit_and_begin_anew();
}

void RunResults::add_certificate(const StrideCertificate& certificate, const Scene& scene) {
  if (!files_ || !certificate.contacts) return;
  const auto write = [&](std::string_view file, const ContactList& list,
                         const ContactsTable::Column& column) {
    ContactsTable table(files_->open(std::string(file)), scene, column);
    list.for_each_event([&table](const Event& event, bool flag) { table.add(event, flag); });
  };
  write(contacts_file, certificate.listed.found, {"certainty", "sure", "possible"});
  write(possible_contacts_file, certificate.listed.possible, {"found", "yes", "no"});
  files_->check();
}

void RunResults::begin_dump_and_log(const RunOptions& options, const Scene& scene, KineticRun& run) {
  if (options.log) {
    log_.emplace(*options.log, options, scene, run.structures(), /*edits=*/false);
    run.simulator().listen(*log_);
  }
  if (!options.dump) return;
  dumps_.emplace(*options.dump, destinations_.replace);
  if (!has_contacts(run)) return;
  dumped_contacts_.emplace(dumps_->open_contacts());
  run.simulator().listen(*dumped_contacts_);
}

void RunResults::add_frame(std::size_t frame, const KineticRun& run) {
  if (frame == 0) {
    if (contacts_) contacts_->add_built(run);
    if (dumped_contacts_) dumped_contacts_->add_built(run);
  }
  if (dumps_) dumps_->write(frame, run.dump(frame));
  if (view_) view_->add_frame(frame);
}

void RunResults::add_step(const FrameStamp& frame, std::string_view structure, std::uint64_t events) {
  if (every_event_file_) every_event_file_->check();
  if (!events_) return;
  events_->add(frame, structure, events);
  check_out();
}

void RunResults::end_run() {
  if (view_) view_->finish();
}

void RunResults::add_distributions(RunReport& report) const {
  if (!distributions_) return;
  for (std::size_t s = 0; s < report.structures.size(); ++s)
    report.structures[s].distribution = distributions_->distributions()[s];
}

void RunResults::deliver(const RunReport& report, const std::string& json, const std::string& table) {
  const bool json_on_stdout = destinations_.json == "-";
  const bool table_on_stdout = !destinations_.quiet && !json_on_stdout;
  if (files_) write_out(json, replay_beside(*destinations_.out, page_path_));
  AtomicFiles json_file;
  if (destinations_.json && !json_on_stdout) json_file.write(*destinations_.json, json);
  if (log_) log_->end(report.fingerprint);
  commit_together({every_event_file_ ? &*every_event_file_ : nullptr, dumps_ ? &dumps_->files() : nullptr,
                   log_ ? &log_->file() : nullptr, files_ ? &*files_ : nullptr,
                   view_ ? view_->files() : nullptr, &json_file});
  if (json_on_stdout) print_to_stdout(json);
  if (table_on_stdout) print_to_stdout(table);
  if (files_ && table_on_stdout) print_report_path(*destinations_.out);
  if (page_path_ && table_on_stdout) print_to_stdout("replay " + page_path_->string() + "\n");
}

}  // namespace kds
