// Uninitialised storage for doubles, aligned to a cache line so that no SIMD load of a strip's
// points crosses one. May be used again and again: it grows, and forgets its content, on demand.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace curvewise::runtime {

class AlignedBuffer {
   public:
    AlignedBuffer() noexcept = default;
    explicit AlignedBuffer(std::ptrdiff_t size) { reserve(size); }

    // Room for `size` doubles, of any content.
    void reserve(std::ptrdiff_t size) {
        if (size <= size_) return;
        data_.reset(static_cast<double*>(
            ::operator new(static_cast<std::size_t>(size) * sizeof(double), line)));
        size_ = size;
    }

    double* data() noexcept { return data_.get(); }
    const double* data() const noexcept { return data_.get(); }

    // `size` doubles rounded up, so that what follows is aligned too.
    static constexpr std::ptrdiff_t rounded(std::ptrdiff_t size) noexcept {
        return (size + 7) / 8 * 8;
    }

   private:
    static constexpr std::align_val_t line{64};
    struct Free {
        void operator()(double* data) const noexcept { ::operator delete(data, line); }
    };
    std::unique_ptr<double, Free> data_;
    std::ptrdiff_t size_ = 0;
};

}  // namespace curvewise::runtime
