// Area, pcm, curve_length and the pointwise measures: against the textbook
// (tests/stress/check_planar.hpp).
#include "check_planar.hpp"
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::run(data, size, [](test::Choices& choices, stress::Record& record) {
        stress::check_planar(choices, record);
    });
}
