// The functions that a path through few cells of a row needs from an instruction-set level: the
// cells of some rows next to each other, active cells and the cells between them. As for strips,
// only pointers and sizes cross the boundary.
#pragma once

#include <cstddef>
#include <cstdint>

namespace curvewise::kernels {

// The bytes that a diagonal of `lanes` lanes takes.
constexpr std::ptrdiff_t code_bytes(std::ptrdiff_t lanes) noexcept { return (lanes + 3) / 4; }

// Some rows of a table of DTW, with steps of equal weight and |dx| + |dy| as ground distance, in
// the plane. There is one row for each lane of a SIMD vector. On diagonal t, lane k is the cell of
// row k and column t - k. All arrays are finite and readable for `padding` further on either side.
struct NarrowRows {
    // Coordinate c of row k is p[c * p_stride + k]; of column j, q[c * q_stride - j].
    const double* p;
    const double* q;
    std::ptrdiff_t p_stride;
    std::ptrdiff_t q_stride;
    std::ptrdiff_t columns;
    // Cells with larger values are pruned.
    double most;
    // Before the call: the row above, active from column `first` to `last`, pruned elsewhere. After
    // it: the last of the rows, written up to column `last`, pruned behind it.
    double* boundary;
    std::ptrdiff_t first;
    std::ptrdiff_t last;
    double corner;  // value above and before the first column
    // For diagonal t, in the byte at [(t - first) * code_bytes + k / 4]: bit k % 4 is set if lane
    // k's path comes from above rather than from the left; bit 4 + k % 4 is set if it comes
    // diagonally instead. There are codes for the diagonals up to the last column and `lanes` more.
    std::uint8_t* codes;
};

// Sweeps the rows from the first diagonal on. Returns how many diagonals there are.
using NarrowFunction = std::ptrdiff_t (*)(NarrowRows& rows) noexcept;

}  // namespace curvewise::kernels
