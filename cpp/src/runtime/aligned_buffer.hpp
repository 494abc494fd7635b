// Uninitialised storage for doubles, aligned to a cache line so that no SIMD load of a strip's
// points crosses one. It can be reused: it grows on demand, and then forgets its content. It
// allocates one line more than requested and takes the first aligned place in it. An allocator
// returns small blocks of its own alignment much faster than blocks of another alignment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace curvewise::runtime {

class AlignedBuffer {
   public:
    AlignedBuffer() noexcept = default;
    explicit AlignedBuffer(std::ptrdiff_t size) { reserve(size); }

    // Room for `size` doubles, of any content.
    void reserve(std::ptrdiff_t size) {
        if (size <= size_) return;
        storage_.reset(new double[static_cast<std::size_t>(size + line - 1)]);
        const auto place = reinterpret_cast<std::uintptr_t>(storage_.get()) / sizeof(double);
        data_ = storage_.get() + (rounded(static_cast<std::ptrdiff_t>(place % line)) -
                                  static_cast<std::ptrdiff_t>(place % line));
        size_ = size;
    }

    double* data() noexcept { return data_; }
    const double* data() const noexcept { return data_; }

    // `size` doubles rounded up, so that what follows is aligned too.
    static constexpr std::ptrdiff_t rounded(std::ptrdiff_t size) noexcept {
        return (size + line - 1) / line * line;
    }

   private:
    static constexpr std::ptrdiff_t line = 8;  // doubles
    std::unique_ptr<double[]> storage_;
    double* data_ = nullptr;
    std::ptrdiff_t size_ = 0;
};

}  // namespace curvewise::runtime
