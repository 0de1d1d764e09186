#pragma once
// AMBER NetCDF trajectories and restart files in the classic formats CDF-1, CDF-2 and CDF-5. libnetcdf reads
// the attributes. If a file ends early, it returns zeros without an error; if the header counts too few
// frames, it does not return the others. Values are therefore read here, after the sizes in the header are
// compared with the file's size.

#include <filesystem>
#include <memory>
#include <string_view>

#include "motions/readers/atom_frames.h"
#include "motions/readers/read_options.h"

namespace kds {

/// Returns whether a classic NetCDF file begins with these bytes.
[[nodiscard]] bool looks_like_netcdf(std::string_view start);

/// Opens an AMBER NetCDF file. Throws InputError naming the file if the file is gzipped, is in another format
/// than the classic ones, or does not follow AMBER's conventions.
[[nodiscard]] std::unique_ptr<AtomFrames> open_netcdf(const std::filesystem::path& path,
                                                      const ReadOptions& options);

}  // namespace kds
