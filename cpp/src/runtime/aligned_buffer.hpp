// Uninitialised storage for doubles, aligned to a cache line so that no SIMD load of a strip's
// points crosses one. It can be reused: it grows on demand, and then forgets its content. It takes
// one line more than requested, and uses the first aligned place in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "runtime/scratch.hpp"

namespace curvewise::runtime {

class AlignedBuffer {
   public:
    AlignedBuffer() noexcept = default;
    explicit AlignedBuffer(std::ptrdiff_t size) { reserve(size); }

    // Room for `size` doubles, of any content.
    void reserve(std::ptrdiff_t size) {
        if (size <= size_) return;
        const std::size_t bytes = static_cast<std::size_t>(size + line - 1) * sizeof(double);
        storage_.reset();  // before more is taken
        size_ = 0;
        storage_ = Storage(static_cast<double*>(take_scratch(bytes)), GiveScratch(bytes));
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
    using Storage = std::unique_ptr<double[], GiveScratch>;
    Storage storage_;
    double* data_ = nullptr;
    std::ptrdiff_t size_ = 0;
};

}  // namespace curvewise::runtime
