// The file of an index: its points, in the layout in which a measure reads stored points, and what
// says where each curve is. Nothing depends on a measure besides the layout.
//
//   header     16 words: see Header
//   curves     for each curve three words: its index; 4 times its number of points, and 1 more if
//              it is flat, and 2 more if its squares are in the usual domain; the bits of its
//              largest |coordinate|
//   note       the caller's bytes, with zeros up to a multiple of 64
//   points     from a multiple of 64 bytes on, curve behind curve, and 8 zeros behind them
//   bounds     of each curve, where the measure has bounds of points alone
//
// Words are 64-bit numbers in the byte order of the computer that writes, numbers are doubles.
// Every byte is in one of three checksums. What follows from the points is there so that an index
// is open in little time, and so that processes share it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "nearest/index_view.hpp"
#include "runtime/file.hpp"
#include "runtime/poller.hpp"

namespace curvewise::nearest {

// The curves of an index, and what they are written with.
struct SavedIndex {
    const pairwise::Targets& all;
    std::vector<std::ptrdiff_t> targets;  // of these
    std::vector<std::int64_t> indices;    // of each
    std::int64_t next_index;
    const std::string& note;
};

// Throws std::system_error where the file cannot be written, and Stopped; the old file then stays.
void save_index(const std::string& path, const SavedIndex& index, runtime::Poller& poller);

// A file that was opened. Its curves refer to its memory.
struct OpenedIndex {
    // Throws std::runtime_error where this is no such file, or a damaged one: all but the points is
    // checked here.
    explicit OpenedIndex(const std::string& name);
    // Throws where the points or their bounds are damaged.
    void check_points(runtime::Poller& poller) const;
    // The bounds of each curve, if they are those of these targets, or nullptr.
    std::vector<const double*> bounds_for(const pairwise::Targets& targets) const;

    std::string path;
    std::shared_ptr<const runtime::MappedFile> file;
    pairwise::PointLayout layout{};
    std::vector<std::int64_t> indices;
    std::int64_t next_index = 0;
    std::string note;
    std::vector<CurveView> curves;
    std::vector<pairwise::StoredCurve> stored;

   private:
    const double* points_ = nullptr;  // then the zeros, and the bounds
    const double* bounds_ = nullptr;
    const double* end_ = nullptr;
    std::uint64_t bounds_format_ = 0;
    std::uint64_t checksum_ = 0;
};

}  // namespace curvewise::nearest
