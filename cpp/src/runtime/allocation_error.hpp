// Large arrays. If memory runs out, the message gives the size of the array.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <string>

namespace curvewise::runtime {

class AllocationError : public std::bad_alloc {
   public:
    AllocationError(const std::string& what_for, double bytes);
    const char* what() const noexcept override { return message_.c_str(); }

   private:
    std::string message_;
};

// Uninitialised.
template <class T>
std::unique_ptr<T[]> allocate(std::ptrdiff_t size, const std::string& what_for) {
    std::unique_ptr<T[]> data(new (std::nothrow) T[static_cast<std::size_t>(size)]);
    if (!data) throw AllocationError(what_for, static_cast<double>(size) * sizeof(T));
    return data;
}

}  // namespace curvewise::runtime
