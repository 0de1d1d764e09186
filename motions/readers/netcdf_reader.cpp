#include "motions/readers/netcdf_reader.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/nanometres.h"
#include "motions/readers/netcdf_layout.h"
#include "motions/readers/xdr.h"

namespace kds {

namespace {

// Throws unless libnetcdf may be asked to open the file.
void require_classic(InputFile& input) {
  if (input.is_gzipped())
    throw InputError(fmt::format("{}: NetCDF is read unpacked only; unpack it with gunzip", input.name()));
  std::array<char, 8> bytes{};
  const std::string_view start(bytes.data(), input.read(bytes.data(), bytes.size()));
  input.rewind();
  if (!looks_like_netcdf(start))
    throw InputError(
        fmt::format("{}: expected a NetCDF file (CDF-1, CDF-2 or CDF-5), which begins with CDF, found {}",
                    input.name(), in_quotes(start)));
}

// A file that libnetcdf has opened.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::string& name) : name_(name) {
    // libnetcdf may take a relative path for an address, as in "https:".
    const std::string path = std::filesystem::absolute(name).string();
    std::size_t piece = std::size_t{1} << 20U;
    check(nc__open(path.c_str(), NC_NOWRITE, &piece, &id_), "cannot open this file");
  }
  ~NetcdfFile() { nc_close(id_); }
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  void check(int code, std::string_view what) const {
    if (code != NC_NOERR)
      throw InputError(fmt::format("{}: {} (libnetcdf: {})", name_, what, nc_strerror(code)));
  }

  // Returns an attribute of a variable, or of the file (NC_GLOBAL); empty if it is not there.
  std::string text(int variable, const char* attribute) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || type != NC_CHAR) return {};
    std::string value(length, '\0');
    check(nc_get_att_text(id_, variable, attribute, value.data()),
          fmt::format("cannot read attribute {}", attribute));
    return std::string(trimmed(std::string_view(value).substr(0, value.find('\0'))));
  }

  // Returns the attribute scale_factor of a variable; 1 if it is not there.
  double scale(int variable) const {
    std::size_t length = 0;
    if (nc_inq_attlen(id_, variable, "scale_factor", &length) != NC_NOERR) return 1;
    double value = 0;
    const bool is_number =
        length == 1 && nc_get_att_double(id_, variable, "scale_factor", &value) == NC_NOERR;
    if (!is_number || !std::isfinite(value) || value == 0)
      throw InputError(fmt::format("{}: expected the attribute scale_factor to be one number, not 0", name_));
    return value;
  }

 private:
  std::string name_;
  int id_ = -1;
};

// A variable with values for each frame, or with the same values for all.
struct NetcdfSeries {
  const NetcdfVariable* layout = nullptr;
  bool framed = false;
  double scale = 1;
  std::string units;
};

// Returns the entry of `units` that has this name, with or without an s at its end.
template <std::size_t n>
std::optional<double> unit_of(std::string_view name,
                              const std::array<std::pair<std::string_view, double>, n>& units) {
  for (const auto& [unit, size] : units)
    if (name == unit || (name.ends_with('s') && name.substr(0, name.size() - 1) == unit)) return size;
  return std::nullopt;
}

constexpr std::array<std::pair<std::string_view, double>, 5> netcdf_lengths{
    {{"angstrom", 1}, {"a", 1}, {"nanometer", 10}, {"nanometre", 10}, {"nm", 10}}};
constexpr std::array<std::pair<std::string_view, double>, 6> netcdf_times{
    {{"femtosecond", 1e-3}, {"fs", 1e-3}, {"picosecond", 1}, {"ps", 1}, {"nanosecond", 1e3}, {"ns", 1e3}}};
constexpr std::array<std::pair<std::string_view, double>, 2> netcdf_angles{
    {{"degree", 1}, {"radian", 180 / std::numbers::pi}}};

class NetcdfFrames final : public AtomFrames {
 public:
  NetcdfFrames(const std::filesystem::path& path, bool velocities)
      : name_(path.string()), layout_(layout_of(path)), file_(name_), input_(path) {
    check_conventions();
    const NetcdfVariable* const coordinates = layout_.find("coordinates");
    if (coordinates == nullptr)
      throw InputError(fmt::format("{}: expected a variable coordinates, found none", name_));
    const std::size_t rank = coordinates->lengths.size();
    if ((rank != 2 && rank != 3) || coordinates->lengths.back() != 3 ||
        (rank == 2 && coordinates->has_records))
      throw InputError(fmt::format(
          "{}: expected coordinates of the dimensions frame (if several), atom and spatial, which is 3",
          name_));
    if (coordinates->type != NC_FLOAT && coordinates->type != NC_DOUBLE)
      throw InputError(fmt::format("{}: expected coordinates of type float or double", name_));
    atoms_ = static_cast<std::size_t>(coordinates->lengths[rank - 2]);
    frames_ = rank == 2 ? 1 : coordinates->lengths[0];
    is_counted_ = !coordinates->has_records || layout_.records_claimed().value_or(0) > 0;
    if (coordinates->has_records)
      frames_ = is_counted_ ? *layout_.records_claimed() : layout_.whole_records();
    coordinates_ = *series("coordinates", {atoms_, 3});
    time_ = series("time", {});
    lengths_ = series("cell_lengths", {3});
    angles_ = series("cell_angles", {3});
    if (velocities) velocities_ = series("velocities", {atoms_, 3});
    read_units();
    count_frames();
  }

  std::size_t atom_count() const override { return atoms_; }
  FramesHeld held() const override { return held_; }
  bool may_have_cell() const override { return lengths_ && angles_; }
  std::vector<std::string> notes() const override { return notes_; }

  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    frame.stamp.number = k;
    frame.stamp.picoseconds = time(k);
    CellRead cell = read_cell_of(k);
    frame.cell = cell.cell;
    frame.cell_doubt = std::move(cell.doubt);
    if (!frame.asked && !frame.cell) return;
    if (const auto unwritten = read_atoms(coordinates_, k, atoms, frame.positions))
      fail_unwritten(k, *unwritten);
    if (to_angstrom_ != 1) frame.positions = frame.positions.unaryExpr(&angstrom_of_nanometres);
    if (!velocities_ || !frame.asked) return;
    if (read_atoms(*velocities_, k, atoms, frame.velocities)) frame.velocities.resize(3, 0);
    frame.velocities *= to_angstrom_per_picosecond_;
  }

 private:
  static NetcdfLayout layout_of(const std::filesystem::path& path) {
    InputFile input(path);
    require_classic(input);
    return NetcdfLayout(input);
  }

  void check_conventions() {
    const std::string conventions = file_.text(NC_GLOBAL, "Conventions");
    std::string words = conventions;
    std::replace(words.begin(), words.end(), ',', ' ');
    for (const std::string_view word : split_fields(words))
      if (word == "AMBER" || word == "AMBERRESTART") return;
    throw InputError(
        fmt::format("{}: expected the attribute Conventions to be AMBER or AMBERRESTART, found {}", name_,
                    conventions.empty() ? "none" : in_quotes(conventions)));
  }

  // Returns a variable that has `shape` in each frame or for all frames; none if it is not there.
  std::optional<NetcdfSeries> series(const std::string& name, const std::vector<std::uint64_t>& shape) const {
    const NetcdfVariable* const layout = layout_.find(name);
    if (layout == nullptr) return std::nullopt;
    const std::size_t rank = layout->lengths.size();
    const bool framed = rank == shape.size() + 1;
    const bool fits = (framed || rank == shape.size()) &&
                      std::equal(shape.rbegin(), shape.rend(), layout->lengths.rbegin()) &&
                      (layout->has_records ? framed : !framed || layout->lengths[0] == frames_);
    if (!fits || layout->has_records != (framed && coordinates_has_records()))
      throw InputError(fmt::format("{}: {} has other dimensions than coordinates", name_, name));
    if (layout->type != NC_FLOAT && layout->type != NC_DOUBLE && layout->type != NC_INT)
      throw InputError(fmt::format("{}: expected {} of type float or double", name_, name));
    return NetcdfSeries{layout, framed, file_.scale(layout->id), lower_case(file_.text(layout->id, "units"))};
  }
  bool coordinates_has_records() const { return layout_.find("coordinates")->has_records; }

  // Reads the units of all series. Lengths without units are in angstrom, as AMBER writes them.
  void read_units() {
    to_angstrom_ = length_unit(coordinates_, "coordinates");
    if (may_have_cell()) {
      cell_to_angstrom_ = length_unit(*lengths_, "cell_lengths");
      if (const auto unit = unit_of(angles_->units.empty() ? "degree" : angles_->units, netcdf_angles))
        to_degrees_ = *unit;
      else
        throw InputError(fmt::format("{}: expected cell_angles in degree or radian, found {}", name_,
                                     in_quotes(angles_->units)));
    }
    read_velocity_unit();
    if (!time_) return;
    if (const auto unit = unit_of(time_->units.empty() ? "picosecond" : time_->units, netcdf_times)) {
      to_picoseconds_ = *unit;
      return;
    }
    notes_.push_back(
        fmt::format("times are left unread: expected them in picosecond, femtosecond or nanosecond, found {}",
                    in_quotes(time_->units)));
    time_.reset();
  }

  // The unit is a length per time, as in angstrom/picosecond.
  void read_velocity_unit() {
    if (!velocities_) return;
    const std::string_view units = velocities_->units;
    const std::size_t slash = units.find('/');
    const auto length = unit_of(units.substr(0, slash), netcdf_lengths);
    const auto time = slash == units.npos ? std::nullopt : unit_of(units.substr(slash + 1), netcdf_times);
    if (length && time) {
      to_angstrom_per_picosecond_ = *length / *time;
      return;
    }
    notes_.push_back(
        fmt::format("velocities are left unread: expected them in angstrom/picosecond or the like, found {}",
                    in_quotes(units)));
    velocities_.reset();
  }

  double length_unit(const NetcdfSeries& series, const char* name) {
    if (series.units.empty()) {
      notes_.push_back(fmt::format("{} have no units and are taken as angstrom", name));
      return 1;
    }
    const auto unit = unit_of(series.units, netcdf_lengths);
    if (!unit)
      throw InputError(fmt::format("{}: expected {} in angstrom or nanometer, found {}", name_, name,
                                   in_quotes(series.units)));
    return *unit;
  }

  // Counts the frames that are there with all their bytes.
  void count_frames() {
    held_.whole = static_cast<std::size_t>(frames_);
    for (const NetcdfSeries* series :
         {&coordinates_, time_ ? &*time_ : nullptr, lengths_ ? &*lengths_ : nullptr,
          angles_ ? &*angles_ : nullptr, velocities_ ? &*velocities_ : nullptr}) {
      if (series == nullptr) continue;
      const NetcdfVariable& variable = *series->layout;
      const std::uint64_t bytes =
          series->framed && !variable.has_records ? variable.bytes / frames_ : variable.bytes;
      std::uint64_t whole = layout_.whole_records();
      if (!variable.has_records) {
        whole = layout_.file_size() < variable.begin ? 0 : (layout_.file_size() - variable.begin) / bytes;
        if (!series->framed && whole > 0) whole = frames_;
      }
      held_.whole = std::min(held_.whole, static_cast<std::size_t>(whole));
    }
    held_.ends_inside = held_.whole < frames_;
    const bool has_records = coordinates_.layout->has_records;
    if (!is_counted_) {
      held_.ends_inside = layout_.file_size() > layout_.record_begin(layout_.whole_records());
      if (layout_.records_claimed() && frames_ > 0)
        notes_.push_back(
            fmt::format("the header counts 0 frames, the file has room for {}, which are read", frames_));
    } else if (coordinates_.framed) {
      const NetcdfVariable& variable = *coordinates_.layout;
      const std::uint64_t room =
          has_records ? layout_.whole_records() : layout_.room_of(variable) / frame_bytes(variable);
      if (room > frames_)
        notes_.push_back(
            fmt::format("the header counts {}, the file has room for {}; only those of the header are read",
                        counted(static_cast<std::size_t>(frames_), "frame"), room));
    }
    if (held_.ends_inside) held_.end = layout_.file_size();
  }

  std::optional<double> time(std::size_t k) {
    if (!time_) return std::nullopt;
    double value = 0;
    read_values(*time_, k, 0, 1, &value);
    const bool is_float = time_->layout->type == NC_FLOAT;
    if (value == (is_float ? static_cast<double>(NC_FILL_FLOAT) : NC_FILL_DOUBLE)) return std::nullopt;
    if (is_float) value = xdr_time(static_cast<float>(value)).value_or(value);
    value *= time_->scale;
    value = to_picoseconds_ < 1 ? value / std::round(1 / to_picoseconds_) : value * to_picoseconds_;
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }

  CellRead read_cell_of(std::size_t k) {
    if (!may_have_cell()) return {};
    return read_cell_from_angles(three(*lengths_, k) * cell_to_angstrom_, three(*angles_, k) * to_degrees_);
  }

  Eigen::Vector3d three(const NetcdfSeries& series, std::size_t k) {
    Eigen::Vector3d values;
    read_values(series, k, 0, 3, values.data());
    return values * series.scale;
  }

  std::uint64_t frame_bytes(const NetcdfVariable& variable) const {
    return variable.has_records ? layout_.record_size() : variable.bytes / frames_;
  }

  // Reads values of frame k. libnetcdf would not read frames that the header does not count.
  template <class Number>
  void read_values(const NetcdfSeries& series, std::size_t k, std::size_t first, std::size_t count,
                   Number* to) {
    const NetcdfVariable& variable = *series.layout;
    const std::size_t size = variable.type == NC_DOUBLE ? 8 : 4;
    bytes_.resize(count * size);
    const std::uint64_t begin =
        variable.begin + (series.framed ? k * frame_bytes(variable) : 0) + first * size;
    if (!input_.read_at(begin, bytes_.data(), bytes_.size()))
      throw InputError(fmt::format("{}: frame {}: cannot read the file at byte {}", name_, k, begin));
    for (const char* from = bytes_.data(); count > 0; --count, from += size)
      *to++ = static_cast<Number>(variable.type == NC_DOUBLE  ? xdr_number<double>(from)
                                  : variable.type == NC_FLOAT ? xdr_number<float>(from)
                                                              : xdr_number<std::int32_t>(from));
  }

  // Reads three scaled numbers of each atom. Returns the first atom that was not written, if there is one.
  std::optional<std::size_t> read_atoms(const NetcdfSeries& series, std::size_t k,
                                        std::span<const std::size_t> atoms, Eigen::Matrix3Xd& to) {
    to.resize(3, static_cast<Eigen::Index>(atoms.size()));
    return series.layout->type == NC_FLOAT ? read_atoms(series, k, atoms, to, floats_)
                                           : read_atoms(series, k, atoms, to, doubles_);
  }

  // Reads from the first to the last of the wanted atoms at once. Floats are scaled as floats, as other
  // programs do.
  template <class Number>
  std::optional<std::size_t> read_atoms(const NetcdfSeries& series, std::size_t k,
                                        std::span<const std::size_t> atoms, Eigen::Matrix3Xd& to,
                                        std::vector<Number>& numbers) {
    if (atoms.empty()) return std::nullopt;
    const auto [least, most] = std::minmax_element(atoms.begin(), atoms.end());
    const std::size_t first = *least, span = *most - *least + 1;
    numbers.resize(3 * span);
    read_values(series, k, 3 * first, 3 * span, numbers.data());
    const auto scale = static_cast<Number>(series.scale);
    for (std::size_t bead = 0; bead < atoms.size(); ++bead)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Number value = numbers[3 * (atoms[bead] - first) + axis];
        if (value == static_cast<Number>(NC_FILL_FLOAT)) return atoms[bead];
        if (scale != 1) value *= scale;
        to(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(bead)) = value;
      }
    return std::nullopt;
  }

  [[noreturn]] void fail_unwritten(std::size_t k, std::size_t atom) const {
    const NetcdfVariable& variable = *coordinates_.layout;
    const std::uint64_t atom_bytes = variable.type == NC_FLOAT ? 12 : 24;
    throw DamagedFrame(
        name_, k, variable.begin + k * frame_bytes(variable) + atom * atom_bytes,
        fmt::format("expected the coordinates of atom {}, found NetCDF's fill value: none were written",
                    atom));
  }

  std::string name_;
  NetcdfLayout layout_;
  NetcdfFile file_;
  InputFile input_;
  std::size_t atoms_ = 0;
  std::uint64_t frames_ = 0;  // number by the header, if it has one, else by the file's size
  bool is_counted_ = true;
  NetcdfSeries coordinates_;
  std::optional<NetcdfSeries> time_, lengths_, angles_, velocities_;
  double to_angstrom_ = 1, cell_to_angstrom_ = 1, to_degrees_ = 1, to_picoseconds_ = 1,
         to_angstrom_per_picosecond_ = 1;
  FramesHeld held_;
  std::vector<std::string> notes_;
  std::vector<float> floats_;
  std::vector<double> doubles_;
  std::vector<char> bytes_;
};

}  // namespace

bool looks_like_netcdf(std::string_view start) {
  return start.size() >= 4 && start.starts_with("CDF") && (start[3] == 1 || start[3] == 2 || start[3] == 5);
}

std::unique_ptr<AtomFrames> open_netcdf(const std::filesystem::path& path, const ReadOptions& options) {
  return std::make_unique<NetcdfFrames>(path, options.velocities);
}

}  // namespace kds
