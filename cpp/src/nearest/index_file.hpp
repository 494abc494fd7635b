// The file of an index: its points, in the layout in which a measure reads stored points, and what
// says where each curve is. Nothing depends on a measure besides the layout.
//
//   header     16 words: see Header
//   curves     for each curve two words: its index; twice its number of points, and one more if it
//              is flat
//   note       the caller's bytes, with zeros up to a multiple of 64
//   points     from a multiple of 64 bytes on, curve behind curve, and 8 zeros behind them
//
// Words are 64-bit numbers in the byte order of the computer that writes, numbers are doubles.
// Every byte is in one of three checksums.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "nearest/index_view.hpp"
#include "runtime/file.hpp"
#include "runtime/poller.hpp"

namespace curvewise::nearest {

struct SavedCurve {
    CurveView curve;
    std::int64_t index;
};

// Throws std::system_error where the file cannot be written, and Stopped; the old file then stays.
void save_index(const std::string& path, const std::vector<SavedCurve>& curves,
                std::int64_t next_index, pairwise::PointLayout layout, const std::string& note,
                runtime::Poller& poller);

// A file that was opened. Its curves refer to its memory.
struct OpenedIndex {
    // Throws std::runtime_error where this is no such file, or a damaged one: all but the points is
    // checked here.
    explicit OpenedIndex(const std::string& name);
    // Throws where the points are damaged.
    void check_points(runtime::Poller& poller) const;

    std::string path;
    std::shared_ptr<const runtime::MappedFile> file;
    pairwise::PointLayout layout{};
    std::vector<std::int64_t> indices;
    std::int64_t next_index = 0;
    std::string note;
    std::vector<CurveView> curves;
    std::vector<const double*> points;  // of each curve

   private:
    const double* all_points_ = nullptr;
    std::uint64_t numbers_ = 0;  // with the zeros behind them
    std::uint64_t checksum_ = 0;
};

}  // namespace curvewise::nearest
