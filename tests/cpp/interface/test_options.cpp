// The options as an interface to another language reads them: names of choices, and the work that
// decides whether a call is long.
#include <string>
#include <type_traits>
#include <vector>

#include "check.hpp"
#include "curvewise/curvewise.hpp"

namespace {

using namespace curvewise;

template <class Enum>
std::vector<std::string> names(Enum any) {
    const auto found = choice_names(any);
    return {found.begin(), found.end()};
}

using Names = std::vector<std::string>;

void choices_have_their_names() {
    CHECK_EQUAL(names(Metric{}), (Names{"euclidean", "sqeuclidean", "cityblock", "chebyshev",
                                        "minkowski", "haversine"}));
    CHECK_EQUAL(names(StepPattern{}).size(), std::size(step_patterns));
    CHECK_EQUAL(names(StepPattern{})[static_cast<std::size_t>(StepPattern::symmetricP1)],
                std::string("symmetricP1"));
    CHECK_EQUAL(names(StepPattern{}).back(), std::string("mori2006"));
    CHECK_EQUAL(names(SlopeWeight{}), (Names{"a", "b", "c", "d"}));
    CHECK_EQUAL(names(Spacing{}), (Names{"distance", "x", "arc_length", "matched", "function"}));
    CHECK_EQUAL(names(Crossing{}), (Names{"rearrange", "split", "polygon"}));
    CHECK_EQUAL(names(LengthScale{}), (Names{"mean", "mean_abs", "range"}));
    CHECK_EQUAL(names(Preset{}), (Names{"scaled", "paper", "raw"}));
}

// Linear in the points, or, of a table, in its cells.
void work_grows_with_the_points() {
    for_each_measure([](const auto& options) {
        const check::Note note(options.measure);
        const double some = options.work(1000.0, 2000.0, 2.0);
        CHECK(some >= 3000.0);
        CHECK(options.work(2000.0, 4000.0, 2.0) >= 2.0 * some);
        using Options = std::decay_t<decltype(options)>;
        if (std::is_same_v<Options, DtwOptions> || std::is_same_v<Options, FrechetOptions>) {
            CHECK(some >= 2e6);
        }
    });
    const AreaOptions matched{Spacing::matched};
    CHECK(matched.work(2000.0, 4000.0, 2.0) > matched.work(1000.0, 2000.0, 2.0));
}

}  // namespace

int main() {
    return check::run({{"choices have their names", choices_have_their_names},
                       {"work grows with the points", work_grows_with_the_points}});
}
