// What the library says about itself.
#include <algorithm>
#include <cctype>
#include <string>

#include "check.hpp"
#include "curvewise/build_info.hpp"
#include "curvewise/version.hpp"

namespace {

void says_what_it_is() {
    const curvewise::BuildInfo info = curvewise::build_info();
    CHECK_EQUAL(info.version, curvewise::version);
    CHECK_EQUAL(info.version, std::to_string(CURVEWISE_VERSION_MAJOR) + "." +
                                  std::to_string(CURVEWISE_VERSION_MINOR) + "." +
                                  std::to_string(CURVEWISE_VERSION_PATCH));
    CHECK(!info.compiler.empty() && info.compiler != "unknown");
    CHECK(!info.eigen.empty() && std::isdigit(static_cast<unsigned char>(info.eigen[0])) != 0);
    const auto& sets = info.instruction_sets;
    CHECK_EQUAL(std::count(sets.begin(), sets.end(), info.active), std::ptrdiff_t{1});
    CHECK_EQUAL(sets.front(), "baseline");
}

}  // namespace

int main() { return check::run({{"says what it is", says_what_it_is}}); }
