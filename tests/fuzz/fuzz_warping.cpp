// Dtw and frechet, by every way there is to them: against the textbook
// (tests/stress/check_warping.hpp).
#include "check_warping.hpp"
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::run(data, size, [](test::Choices& choices, stress::Record& record) {
        stress::check_warping(choices, record);
    });
}
