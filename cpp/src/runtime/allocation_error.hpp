// Large arrays. If memory runs out, the message gives the size of the array.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

#include "runtime/scratch.hpp"

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
std::unique_ptr<T[], GiveScratch> allocate(std::ptrdiff_t size, const char* what_for) {
    static_assert(std::is_trivial_v<T>);
    const std::size_t bytes = static_cast<std::size_t>(size) * sizeof(T);
    try {
        return {static_cast<T*>(take_scratch(bytes)), GiveScratch(bytes)};
    } catch (const std::bad_alloc&) {
        throw AllocationError(what_for, static_cast<double>(bytes));
    }
}

}  // namespace curvewise::runtime
