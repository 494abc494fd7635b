// Results and errors of the C functions. The C and Fortran programs of tests/python/embedding
// compare the values with Python.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "curvewise/curvewise.h"
#include "curvewise/version.hpp"
#include "interface/c_translate.hpp"

namespace {

// A struct as it was in the first version, and as it is now.
struct First {
    std::size_t size;
    curvewise_control* control;
    double cutoff;
};
struct Grown {
    std::size_t size;
    curvewise_control* control;
    double cutoff;
    double penalty;
    std::ptrdiff_t offsets;
};

}  // namespace

template <>
inline constexpr std::size_t curvewise::c::first_size<Grown> = sizeof(First);

namespace {

constexpr double untouched = -1.0;
const double points[] = {0.0, 0.0, 1.0, 2.0, 3.0, 1.0};

struct Answer {
    int status;
    double value;
    std::string message;
};

// Of three points against two of them.
template <class Function, class Options>
Answer answer(Function function, const Options* options) {
    const curvewise_curve P = curvewise_rows(points, 3, 2), Q = curvewise_rows(points, 2, 2);
    Answer found{-1, untouched, ""};
    curvewise_error error;
    found.status = function(&P, &Q, options, &found.value, &error);
    found.message = error.message;
    return found;
}

void refused(const Answer& given, const std::string& message) {
    CHECK_EQUAL(given.status, int{CURVEWISE_INVALID_ARGUMENT});
    CHECK_EQUAL(given.message, message);
    CHECK_EQUAL(given.value, untouched);
}

void options_are_those_given() {
    const Answer chosen = answer(curvewise_frechet_continuous,
                                 static_cast<curvewise_frechet_continuous_options*>(nullptr));
    CHECK_EQUAL(chosen.status, int{CURVEWISE_OK});
    CHECK_EQUAL(chosen.value, std::sqrt(5.0));
    CHECK_EQUAL(chosen.message, "");
    curvewise_frechet_continuous_options continuous = CURVEWISE_FRECHET_CONTINUOUS_DEFAULTS;
    CHECK_EQUAL(answer(curvewise_frechet_continuous, &continuous).value, chosen.value);
    continuous.workers = 0;
    refused(answer(curvewise_frechet_continuous, &continuous),
            "workers is 0; give a whole number >= 1, or -1 for all cores");
    curvewise_area_options area = CURVEWISE_AREA_DEFAULTS;
    area.spacing = 9;
    refused(answer(curvewise_area, &area), "unknown spacing 9; choose from 0 to 4");
    curvewise_dtw_options dtw = CURVEWISE_DTW_DEFAULTS;
    dtw.step_pattern = -1;
    refused(answer(curvewise_dtw, &dtw), "unknown step_pattern -1; choose from 0 to 26");
}

void null_pointers_are_named() {
    const curvewise_curve P = curvewise_rows(points, 3, 2), none = curvewise_rows(nullptr, 3, 2);
    double value = untouched;
    curvewise_error error;
    CHECK_EQUAL(curvewise_dtw(nullptr, &P, nullptr, &value, &error),
                int{CURVEWISE_INVALID_ARGUMENT});
    CHECK_EQUAL(std::string(error.message), "P is a null pointer");
    CHECK_EQUAL(curvewise_dtw(&P, &none, nullptr, &value, &error), int{CURVEWISE_INVALID_ARGUMENT});
    CHECK_EQUAL(std::string(error.message), "Q->data is a null pointer");
    CHECK_EQUAL(curvewise_dtw(&P, &P, nullptr, nullptr, nullptr), int{CURVEWISE_INVALID_ARGUMENT});
    CHECK_EQUAL(value, untouched);
}

void batches_refuse_what_is_none() {
    const std::vector<curvewise_curve> X(2, curvewise_rows(points, 3, 2));
    double out[4] = {untouched, untouched, untouched, untouched};
    curvewise_error error;
    CHECK_EQUAL(
        curvewise_cdist(X.data(), 2, X.data(), -2, CURVEWISE_DTW, nullptr, nullptr, out, &error),
        int{CURVEWISE_INVALID_ARGUMENT});
    CHECK_EQUAL(std::string(error.message), "XB has -2 curves; give a whole number >= 0");
    CHECK_EQUAL(curvewise_pdist(X.data(), 2, 77, nullptr, nullptr, out, &error),
                int{CURVEWISE_INVALID_ARGUMENT});
    CHECK_EQUAL(std::string(error.message), "unknown measure 77; choose from 0 to 5");
    CHECK_EQUAL(out[0], untouched);
    const curvewise_frechet_continuous_options options = CURVEWISE_FRECHET_CONTINUOUS_DEFAULTS;
    CHECK_EQUAL(
        curvewise_pdist(X.data(), 2, CURVEWISE_FRECHET_CONTINUOUS, &options, nullptr, out, &error),
        int{CURVEWISE_OK});
    CHECK_EQUAL(out[0], 0.0);
}

// A program that was compiled with the first version has nothing behind its own options.
void older_structs_have_the_defaults_of_newer_options() {
    constexpr const char* start = "GROWN_DEFAULTS";
    const auto read = [&](const void* given) {
        return curvewise::c::covered<Grown>(given, {0, nullptr, 1.0, 2.0, 3}, start);
    };
    const First first{sizeof first, nullptr, 7.0};
    const Grown of_first = read(&first);
    CHECK_EQUAL(of_first.cutoff, 7.0);
    CHECK_EQUAL(of_first.penalty, 2.0);
    CHECK_EQUAL(of_first.offsets, std::ptrdiff_t{3});
    Grown given{sizeof given, nullptr, 7.0, 8.0, 9};
    CHECK_EQUAL(read(&given).penalty, 8.0);
    CHECK_EQUAL(read(&given).offsets, std::ptrdiff_t{9});
    given.size = sizeof(First) + sizeof(double);  // a version between the two
    CHECK_EQUAL(read(&given).penalty, 8.0);
    CHECK_EQUAL(read(&given).offsets, std::ptrdiff_t{3});
    for (const std::size_t wrong : {std::size_t{0}, sizeof(First) - 8, sizeof(Grown) + 8}) {
        given.size = wrong;
        CHECK_THROWS(read(&given), std::invalid_argument,
                     "the size of the struct is " + std::to_string(wrong) + ", and curvewise " +
                         curvewise::version + " needs 40; start from GROWN_DEFAULTS");
    }
}

void results_are_written_as_far_as_the_struct_reaches() {
    const Grown result{sizeof result, nullptr, 1.0, 2.0, 3};
    Grown to{sizeof(First), nullptr, untouched, untouched, 0};
    curvewise::c::write_covered(result, &to, "GROWN");
    CHECK_EQUAL(to.size, sizeof(First));
    CHECK_EQUAL(to.cutoff, 1.0);
    CHECK_EQUAL(to.penalty, untouched);
    curvewise_comparison found = CURVEWISE_COMPARISON;
    const curvewise_curve P = curvewise_rows(points, 3, 2), Q = curvewise_rows(points, 2, 2);
    CHECK_EQUAL(curvewise_compare(&P, &Q, nullptr, &found, nullptr), int{CURVEWISE_OK});
    CHECK_EQUAL(found.size, sizeof found);
    CHECK(found.dtw > 0.0);
}

void a_struct_of_zeros_is_refused() {
    const curvewise_dtw_options zeros{};
    refused(answer(curvewise_dtw, &zeros),
            "the size of the struct is 0, and curvewise " + std::string(curvewise::version) +
                " needs " + std::to_string(sizeof zeros) + "; start from CURVEWISE_DTW_DEFAULTS");
}

void the_version_is_that_of_the_library() {
    CHECK_EQUAL(std::string(curvewise_version()), curvewise::version);
}

// Run with CURVEWISE_ISA=v9.
void no_such_level() {
    const Answer failed = answer(curvewise_dtw, static_cast<curvewise_dtw_options*>(nullptr));
    CHECK_EQUAL(failed.status, int{CURVEWISE_FAILED});
    CHECK_EQUAL(failed.message.substr(0, 48), "CURVEWISE_ISA is 'v9'; this machine has baseline");
    CHECK_EQUAL(failed.value, untouched);
}

}  // namespace

int main(int argc, char** /*argv*/) {
    if (argc > 1) return check::run({{"no such level", no_such_level}});
    return check::run({{"options are those given", options_are_those_given},
                       {"null pointers are named", null_pointers_are_named},
                       {"batches refuse what is none", batches_refuse_what_is_none},
                       {"older structs have the defaults of newer options",
                        older_structs_have_the_defaults_of_newer_options},
                       {"results are written as far as the struct reaches",
                        results_are_written_as_far_as_the_struct_reaches},
                       {"a struct of zeros is refused", a_struct_of_zeros_is_refused},
                       {"the version is that of the library", the_version_is_that_of_the_library}});
}
