#include "motions/readers/imd_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/live/live_receiver.h"

namespace kds {

namespace {

// Compares the numbers of steps of frames that follow one another.
class StepSpacing {
 public:
  explicit StepSpacing(std::optional<unsigned> rate) {
    if (rate) expected_ = *rate;
  }

  void look_at(std::size_t frame, std::int64_t step) {
    const std::optional<std::int64_t> before = std::exchange(last_, step);
    if (!before) return;
    const auto between =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(step) - static_cast<std::uint64_t>(*before));
    if (!expected_) expected_ = std::max<std::int64_t>(between, 1);
    if (between == *expected_ || unlike_++ > 0) return;
    first_unlike_ =
        fmt::format("frame {} is {} steps after the frame before, expected {}", frame, between, *expected_);
  }

  // Returns a line, or an empty text if all frames are equally far apart.
  [[nodiscard]] std::string note() const {
    return unlike_ == 0 ? "" : fmt::format("{} ({})", first_unlike_, counted(unlike_, "frame"));
  }

 private:
  std::optional<std::int64_t> last_;  // step of the frame before
  std::optional<std::int64_t> expected_;
  std::size_t unlike_ = 0;  // frames
  std::string first_unlike_;
};

class ImdFrames final : public AtomFrames {
 public:
  ImdFrames(const std::filesystem::path& address, const ReadOptions& options)
      : name_(address.string()),
        receiver_(parse_live_address(address), options.patience.value_or(60), options.rate, options.on_wait),
        until_(options.until),
        time_step_(options.time_step),
        cell_(options.cell),
        bounded_(options.until || options.frames.last),
        steps_(options.rate) {
    if (cell_ && receiver_.sends_cells())
      throw InputError("--cell", name_ + " sends its cell; expected no other");
    if (options.velocities) receiver_.protocol().ask_velocities();
    // Without a topology only a whole frame proves the number of atoms.
    if (!options.topology && !advance())
      throw InputError(cut_.empty() ? name_ + ": the simulation has ended before the first frame" : cut_);
  }

  [[nodiscard]] std::size_t atom_count() const override { return receiver_.atom_count(); }
  [[nodiscard]] FramesHeld held() const override { return {.open = true}; }
  [[nodiscard]] bool may_have_cell() const override { return cell_ || receiver_.sends_cells(); }

  void choose(std::span<const std::size_t> atoms) override {
    if (frames_ > 0) return;  // there is no topology to choose from
    receiver_.protocol().choose(atoms);
    chosen_ = true;
  }

  [[nodiscard]] bool wait_for(std::size_t k) override {
    if (k + 1 < frames_)
      throw std::logic_error("frame " + std::to_string(k) + " of a running simulation is past");
    while (!ended_ && !is_late(k) && frames_ <= k) ended_ = !advance();
    ended_ = ended_ || is_late(k);
    return !ended_;
  }

  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    if (frames_ != k + 1) throw std::logic_error("a frame of a simulation is read before it is there");
    frame.stamp.picoseconds = frame_.picoseconds;
    frame.cell = cell_;
    if (frame_.cell) {
      CellRead cell = read_cell(Eigen::Map<const Eigen::Matrix3f>(frame_.cell->data()).cast<double>());
      frame.cell = cell.cell;
      frame.cell_doubt = std::move(cell.doubt);
    }
    copy(frame_.positions, atoms, frame.positions);
    if (frame.asked && !frame_.velocities.empty()) copy(frame_.velocities, atoms, frame.velocities);
  }

  [[nodiscard]] std::vector<std::string> notes() const override {
    std::string lacks;
    if (!time_step_ && !receiver_.sends_times())
      lacks = fmt::format("no times ({} PS gives them)", "--dt"_arg);
    if (!may_have_cell())
      lacks +=
          fmt::format("{}no periodic cell ({} A,B,C gives one)", lacks.empty() ? "" : " and ", "--cell"_arg);
    return lacks.empty() ? std::vector<std::string>() : std::vector{"sends " + lacks};
  }

  void close() override { receiver_.close(); }
  [[nodiscard]] bool is_cut() const override { return !cut_.empty(); }
  [[nodiscard]] std::optional<LiveState> live() const override { return receiver_.state(); }
  [[nodiscard]] std::vector<std::string> closing_notes() const override {
    std::vector<std::string> notes;
    if (is_cut()) notes.push_back(cut_);
    if (receiver_.left() && frames_ > 0)
      notes.push_back(
          fmt::format("{}: kds disconnected after frame {}; a simulation that goes on may wait for "
                      "another client (LAMMPS unless nowait on, GROMACS with -imdwait)",
                      name_, frames_ - 1));
    if (!frame_.step && receiver_.state().seconds_full > 0)
      notes.push_back(name_ +
                      ": sends no step numbers, and kds was too slow for a while; frames may be missing");
    if (falls_short_)
      notes.push_back(
          fmt::format("{}: the simulation has ended after frame {}, before the last frame asked for", name_,
                      frames_ - 1));
    if (const std::string note = steps_.note(); !note.empty())
      notes.push_back(fmt::format("{}: {}{}", name_, note,
                                  time_step_ ? fmt::format("; times by {} are wrong", "--dt"_arg) : ""));
    return notes;
  }

 private:
  // Waits for the next frame. Returns false after the last one.
  bool advance() {
    if (!receiver_.take(frame_)) {
      cut_ = receiver_.broken();
      falls_short_ = bounded_ && cut_.empty() && frames_ > 0 && !receiver_.left();
      return false;
    }
    if (frame_.step) steps_.look_at(frames_, *frame_.step);
    ++frames_;
    return true;
  }

  // Whether frame k is known to lie after --until. The frame taken last is k or one before it.
  [[nodiscard]] bool is_late(std::size_t k) const {
    if (!until_ || (frames_ == 0 && !time_step_)) return false;
    const double last = *until_ + 1e-9 * std::abs(*until_);  // multiples of a step of time are rounded
    if (time_step_ || !frame_.picoseconds) return static_cast<double>(k) * time_step_.value_or(1) > last;
    return frames_ == k + 1 ? *frame_.picoseconds > last : *frame_.picoseconds >= *until_;
  }

  void copy(const std::vector<float>& numbers, std::span<const std::size_t> atoms,
            Eigen::Matrix3Xd& to) const {
    to.resize(3, static_cast<Eigen::Index>(atoms.size()));
    for (std::size_t bead = 0; bead < atoms.size(); ++bead)
      for (std::size_t axis = 0; axis < 3; ++axis)
        to(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(bead)) =
            numbers[3 * (chosen_ ? bead : atoms[bead]) + axis];
  }

  std::string name_;
  LiveReceiver receiver_;
  std::optional<double> until_, time_step_;
  std::optional<Cell> cell_;  // that of --cell
  bool bounded_;              // a last frame is asked for
  bool falls_short_ = false;  // the simulation has ended before it
  StepSpacing steps_;
  bool chosen_ = false;     // frames have only the chosen atoms
  LiveFrame frame_;         // the frame taken last
  std::size_t frames_ = 0;  // frames taken
  bool ended_ = false;
  std::string cut_;  // why the connection broke before the last frame asked for
};

}  // namespace

std::unique_ptr<AtomFrames> open_imd(const std::filesystem::path& address, const ReadOptions& options) {
  require_names(address.string(), options);  // before the simulation starts
  return std::make_unique<ImdFrames>(address, options);
}

}  // namespace kds
