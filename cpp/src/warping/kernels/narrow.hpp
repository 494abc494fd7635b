// What a path through few cells a row asks of an instruction-set level: the cells of some rows
// beside each other, those that are live and what lies between them. As for strips, pointers and
// sizes only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace curvewise::kernels {

// What a diagonal of so many lanes takes.
constexpr std::ptrdiff_t code_bytes(std::ptrdiff_t lanes) noexcept { return (lanes + 3) / 4; }

// Some rows of a table of DTW, with steps of equal weight and |dx| + |dy| as ground distance, in
// the plane: as many as a SIMD vector has lanes. On diagonal t, lane k is the cell of row k and
// column t - k. Everything is finite, and may be read, for `padding` further on either side.
struct NarrowRows {
    // Coordinate c of row k is p[c * p_stride + k]; of column j, q[c * q_stride - j].
    const double* p;
    const double* q;
    std::ptrdiff_t p_stride;
    std::ptrdiff_t q_stride;
    std::ptrdiff_t columns;
    // What is above is dead.
    double most;
    // The row above on the way in, live from the column `first` to `last`, dead elsewhere; the last
    // of the rows on the way out, written up to the column `last`, dead behind it.
    double* boundary;
    std::ptrdiff_t first;
    std::ptrdiff_t last;
    double corner;  // what stands above and before the first column
    // For diagonal t, in the byte at [(t - first) * code_bytes + k / 4]: bit k % 4, whether lane
    // k's path comes from above rather than from the left; bit 4 + k % 4, whether it comes
    // diagonally instead. Of the diagonals up to the last column and `lanes` more.
    std::uint8_t* codes;
};

// Sweeps the rows from the first diagonal on. Returns how many diagonals there are.
using NarrowFunction = std::ptrdiff_t (*)(NarrowRows& rows) noexcept;

}  // namespace curvewise::kernels
