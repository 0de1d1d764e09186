#include "motions/readers/trr_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/xdr.h"

namespace kds {

namespace {

// The magic number, the length of the text with its final zero, and the text with its length.
constexpr std::string_view trr_start("\0\0\x07\xC9\0\0\0\x0D\0\0\0\x0CGMX_trn_file", 24);

struct TrrHeader {
  std::uint64_t begin = 0;  // where the frame begins in the file
  std::size_t size = 0;     // the header's size
  std::size_t real = 4;     // bytes of a number
  std::size_t atoms = 0;
  double time = 0;
  std::uint64_t box = 0, tensors = 0, positions = 0, velocities = 0, forces = 0;  // bytes

  static constexpr std::size_t most_size = 92;
  [[nodiscard]] std::uint64_t positions_begin() const { return begin + size + box + tensors; }
  [[nodiscard]] std::uint64_t end() const { return positions_begin() + positions + velocities + forces; }
};

class TrrFrames final : public AtomFrames {
 public:
  TrrFrames(const std::filesystem::path& path, bool velocities) : input_(path), velocities_(velocities) {
    const InputFile::Length length = input_.length();
    length_ = length.bytes;
    held_.end = length_;
    count_frames();
    held_.ends_inside |= length.cut;
    if (begins_.empty() && left_out_ > 0 && !held_.damage && !held_.ends_inside)
      throw InputError(fmt::format("{}: expected positions, found velocities or forces only in {}",
                                   input_.name(), counted(left_out_, "frame")));
  }

  [[nodiscard]] std::size_t atom_count() const override { return begins_.empty() ? 0 : atoms_; }
  [[nodiscard]] FramesHeld held() const override { return held_; }
  [[nodiscard]] bool may_have_cell() const override { return has_box_; }

  [[nodiscard]] std::vector<std::string> notes() const override {
    if (left_out_ == 0) return {};
    return {fmt::format("{} without positions {} left out; the others are numbered from 0",
                        counted(left_out_, "frame"), left_out_ == 1 ? "is" : "are")};
  }

  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    const std::optional<TrrHeader> header = read_header(k, begins_.at(k));
    if (!header) throw InputError(fmt::format("{}: frame {}: the file has become shorter", input_.name(), k));
    frame.stamp = {
        k, header->real == 4 ? xdr_time(static_cast<float>(header->time)) : finite_time(header->time)};
    CellRead cell = header->real == 4 ? read_box<float>(*header) : read_box<double>(*header);
    frame.cell = cell.cell;
    frame.cell_doubt = std::move(cell.doubt);
    if (!frame.asked && !frame.cell) return;
    read_atoms(*header, header->positions_begin(), atoms, frame.positions);
    if (velocities_ && frame.asked && header->velocities > 0)
      read_atoms(*header, header->positions_begin() + header->positions, atoms, frame.velocities);
  }

 private:
  static std::optional<double> finite_time(double time) {
    return std::isfinite(time) ? std::optional(time) : std::nullopt;
  }

  template <class Real>
  CellRead read_box(const TrrHeader& header) {
    if (header.box == 0) return {};
    std::array<char, 9 * sizeof(Real)> bytes;
    load(header.begin + header.size, bytes.data(), bytes.size());
    return xdr_box<Real>(bytes.data());
  }

  // Reads the positions or velocities, which begin at `begin` in the file.
  void read_atoms(const TrrHeader& header, std::uint64_t begin, std::span<const std::size_t> atoms,
                  Eigen::Matrix3Xd& numbers) {
    numbers.resize(3, static_cast<Eigen::Index>(atoms.size()));
    header.real == 4 ? read_numbers<float>(begin, atoms, numbers)
                     : read_numbers<double>(begin, atoms, numbers);
  }

  // Reads the bytes from the first of the atoms to the last.
  template <class Real>
  void read_numbers(std::uint64_t begin, std::span<const std::size_t> atoms, Eigen::Matrix3Xd& numbers) {
    if (atoms.empty()) return;
    const auto [least, greatest] = std::ranges::minmax(atoms);
    bytes_.resize((greatest - least + 1) * 3 * sizeof(Real));
    load(begin + least * 3 * sizeof(Real), bytes_.data(), bytes_.size());
    double* to = numbers.data();
    for (const std::size_t atom : atoms) {
      const char* const from = bytes_.data() + (atom - least) * 3 * sizeof(Real);
      for (std::size_t axis = 0; axis < 3; ++axis)
        *to++ = angstrom_of_nanometres(static_cast<float>(xdr_number<Real>(from + axis * sizeof(Real))));
    }
  }

  void load(std::uint64_t offset, char* to, std::size_t size) {
    if (!input_.read_at(offset, to, size))
      throw InputError(fmt::format("{}: cannot read the file at byte {}", input_.name(), offset));
  }

  void count_frames() try {
    for (std::uint64_t begin = 0; begin < length_;) {
      const std::optional<TrrHeader> header = read_header(begins_.size(), begin);
      held_.ends_inside = !header || header->end() > length_;
      if (held_.ends_inside) break;
      atoms_ = header->atoms;
      has_box_ |= header->box > 0;
      if (header->positions > 0)
        begins_.push_back(begin);
      else
        ++left_out_;
      begin = header->end();
    }
    held_.whole = begins_.size();
  } catch (const DamagedFrame& damage) {
    held_.whole = begins_.size();
    held_.damage = damage;
  }

  // Reads and checks a header. Returns nothing if the file ends inside the header.
  std::optional<TrrHeader> read_header(std::size_t frame, std::uint64_t begin) {
    std::array<char, TrrHeader::most_size> bytes{};
    const auto left = static_cast<std::size_t>(std::min<std::uint64_t>(length_ - begin, bytes.size()));
    if (!input_.read_at(begin, bytes.data(), left)) return std::nullopt;
    const auto damaged = [&](std::size_t offset, const std::string& what) {
      return DamagedFrame(input_.name(), frame, begin + offset, what);
    };
    const std::size_t told = std::min(left, trr_start.size());
    if (std::string_view(bytes.data(), told) != trr_start.substr(0, told))
      throw damaged(0, "expected 1993 and GMX_trn_file, the mark of TRR, found other bytes");
    if (left < 84) return std::nullopt;

    // The sizes of what a frame may hold, in the order of the header. Parts without a number are always
    // empty.
    const auto integer = [&](std::size_t i) { return xdr_number<std::uint32_t>(bytes.data() + 24 + 4 * i); };
    enum Part : std::size_t {
      input_record,
      energies,
      box,
      virial,
      pressure,
      topology,
      symbols,
      positions,
      velocities,
      forces,
      atoms
    };
    TrrHeader header;
    header.begin = begin;
    header.atoms = integer(atoms);
    if (header.atoms == 0 || header.atoms > std::numeric_limits<std::int32_t>::max())
      throw damaged(24 + 4 * atoms, fmt::format("expected at least 1 atom, found {}",
                                                static_cast<std::int32_t>(integer(atoms))));
    if (begin > 0 && header.atoms != atoms_)
      throw damaged(24 + 4 * atoms,
                    fmt::format("expected {}, found {}", counted(atoms_, "atom"), header.atoms));
    const auto numbers = [&](std::size_t part) -> std::uint64_t {
      if (part == box || part == virial || part == pressure) return 9;
      return part == positions || part == velocities || part == forces ? 3 * std::uint64_t{header.atoms} : 0;
    };
    header.real = 0;
    for (std::size_t part = input_record; part <= forces; ++part) {
      const std::uint64_t bytes_told = integer(part);
      if (bytes_told == 0) continue;
      if (header.real == 0) header.real = bytes_told == 8 * numbers(part) ? 8 : 4;
      if (numbers(part) == 0 || bytes_told != header.real * numbers(part))
        throw damaged(24 + 4 * part,
                      fmt::format("expected a size of {}, found {}",
                                  numbers(part) == 0
                                      ? "0"
                                      : fmt::format("0 or {}", counted(header.real * numbers(part), "byte")),
                                  static_cast<std::int32_t>(bytes_told)));
    }
    if (header.real == 0) throw damaged(24, "expected a box, positions, velocities or forces, found none");
    header.size = header.real == 4 ? 84 : 92;
    if (left < header.size) return std::nullopt;
    header.time = header.real == 4 ? static_cast<double>(xdr_number<float>(bytes.data() + 76))
                                   : xdr_number<double>(bytes.data() + 76);
    header.box = integer(box);
    header.tensors = std::uint64_t{integer(virial)} + integer(pressure);
    header.positions = integer(positions);
    header.velocities = integer(velocities);
    header.forces = integer(forces);
    return header;
  }

  InputFile input_;
  bool velocities_;  // are asked for
  std::uint64_t length_ = 0;
  std::size_t atoms_ = 0;
  bool has_box_ = false;
  std::vector<std::uint64_t> begins_;  // where the frames with positions begin
  std::size_t left_out_ = 0;           // frames without positions
  FramesHeld held_;
  std::vector<char> bytes_;
};

}  // namespace

bool looks_like_trr(std::string_view start) { return start.starts_with(trr_start); }

std::unique_ptr<AtomFrames> open_trr(const std::filesystem::path& path, const ReadOptions& options) {
  return std::make_unique<TrrFrames>(path, options.velocities);
}

}  // namespace kds
