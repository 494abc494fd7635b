// The scaling into the safe range, and the message if memory runs out.
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>

#include "check.hpp"
#include "curves/range_scale.hpp"
#include "runtime/allocation_error.hpp"

namespace {

using curvewise::curves::RangeScale;
using curvewise::runtime::allocate;

void range_scale() {
    const double high = std::ldexp(1.0, 500), low = std::ldexp(1.0, -500);
    for (const double magnitude : {0.0, 1.0, high, low}) {
        CHECK(RangeScale(magnitude).is_identity());
    }
    for (const double magnitude :
         {std::nextafter(high, 2 * high), std::nextafter(low, 0.0), 1e300, 1e-300,
          std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()}) {
        const RangeScale range(magnitude);
        CHECK(!range.is_identity());
        CHECK(range.shrink(magnitude) >= 0.5 && range.shrink(magnitude) < 1.0);
        CHECK_EQUAL(range.restore(range.shrink(magnitude), 1), magnitude);
        CHECK_EQUAL(range.restore(range.shrink(magnitude), 0), range.shrink(magnitude));
    }
    for (const double magnitude : {1.0, 3.5, 1e300, 1e-300, -7.0}) {
        const double shrunk = std::abs(RangeScale::to_unity(magnitude).shrink(magnitude));
        CHECK(shrunk >= 0.5 && shrunk < 1.0);
    }
    CHECK_EQUAL(RangeScale::to_unity(0.0).shrink(0.0), 0.0);
    const RangeScale range(std::ldexp(1.0, 600));
    CHECK_EQUAL(range.shrink(std::ldexp(-3.0, 600)), -1.5);
    CHECK_EQUAL(range.restore(1.5, -1), std::ldexp(1.5, -601));
    CHECK_EQUAL(range.restore(1.5, 2), std::numeric_limits<double>::infinity());
}

// Volatile, or the compiler would see through the size and leave the allocation out.
volatile std::ptrdiff_t largest = std::numeric_limits<std::ptrdiff_t>::max();
void* volatile memory = nullptr;

void no_memory() {
    CHECK_THROWS(memory = allocate<std::uint8_t>(largest, "a table").get(), std::bad_alloc,
                 "no memory for a table, 8.59e+09 GiB");
}

}  // namespace

int main() { return check::run({{"range scale", range_scale}, {"no memory", no_memory}}); }
