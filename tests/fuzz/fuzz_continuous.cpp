// Frechet_continuous, its bounds, decisions and matchings: against the textbook
// (tests/stress/check_continuous.hpp).
#include "check_continuous.hpp"
#include "fuzz_target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::run(data, size, [](test::Choices& choices, stress::Record& record) {
        stress::check_continuous(choices, record);
    });
}
