// The C interface with any input that a caller may pass: null pointers, sizes of 0 and below,
// strides of any sign, NaN and infinity, options out of range, arrays of another shape than the
// measure's. Every call returns a documented status, and leaves the result alone unless that is
// CURVEWISE_OK. It rejects a nan or an infinity, and otherwise never returns a nan. The sanitizers
// check the rest. (Pointers to too few numbers, and sizes beyond the memory, are the caller's to
// avoid: they are not drawn.)
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "curvewise/curvewise.h"
#include "fuzz_target.hpp"

namespace {

using test::Choices;

constexpr double untouched = -12345.678;

void require(bool holds, const char* what) {
    if (holds) return;
    std::printf("wrong: %s\n", what);
    std::abort();
}

// A curve of numbers that it owns, read backwards or with gaps.
class AnyCurve {
   public:
    explicit AnyCurve(Choices& choices) {
        const std::ptrdiff_t n =
            choices.one_in(16) ? choices.between(-1, 0) : choices.between(1, 9);
        const std::ptrdiff_t dim = choices.one_in(8) ? choices.between(-1, 4) : 2;
        const std::ptrdiff_t gap = choices.index(3);
        const auto count = static_cast<std::size_t>(n > 0 && dim > 0 ? n * (dim + gap) : 1);
        const bool is_small = !choices.one_in(3);
        for (std::size_t k = 0; k < count; ++k) {
            const double value =
                is_small ? static_cast<double>(choices.between(-4, 4)) / 2 : choices.any_double();
            numbers_.push_back(value);
        }
        curve_ = {numbers_.data(), n, dim, dim + gap, 1};
        if (choices.one_in(4) && n > 0 && dim > 0) {  // from the last point to the first
            curve_.data += (n - 1) * curve_.row_stride;
            curve_.row_stride = -curve_.row_stride;
        }
        if (choices.one_in(8)) curve_.row_stride = 0;  // one point, again and again
        if (choices.one_in(32)) curve_.data = nullptr;
        is_null_ = choices.one_in(64);
    }
    const curvewise_curve* get() const { return is_null_ ? nullptr : &curve_; }
    const curvewise_curve& curve() const { return curve_; }
    bool is_finite() const {
        if (curve_.data == nullptr) return true;
        for (std::ptrdiff_t i = 0; i < curve_.n; ++i) {
            for (std::ptrdiff_t c = 0; c < curve_.dim; ++c) {
                if (!std::isfinite(curve_.data[i * curve_.row_stride + c * curve_.col_stride])) {
                    return false;
                }
            }
        }
        return true;
    }

   private:
    std::vector<double> numbers_;
    curvewise_curve curve_{};
    bool is_null_ = false;
};

// Usually valid, so that calls get behind the checks.
int any_choice(Choices& choices, int count) {
    return static_cast<int>(choices.one_in(16) ? choices.between(-2, 9) : choices.index(count));
}

double any_number(Choices& choices, double usual) {
    return choices.one_in(8) ? choices.any_double() : usual;
}

std::ptrdiff_t any_workers(Choices& choices) {
    return choices.one_in(16) ? choices.between(-2, 3) : 1;
}

// The options of every measure.
struct AnyOptions {
    curvewise_area_options area;
    curvewise_pcm_options pcm;
    curvewise_frechet_options frechet;
    curvewise_dtw_options dtw;
    curvewise_curve_length_options curve_length;
    curvewise_frechet_continuous_options continuous;

    explicit AnyOptions(Choices& choices)
        : area{sizeof area, nullptr, any_choice(choices, 4), any_choice(choices, 2),
               any_choice(choices, 2)},
          pcm{sizeof pcm, nullptr, choices.between(-1, 30), choices.one_in(64) ? 1 : 0},
          frechet{sizeof frechet,          nullptr,
                  any_choice(choices, 5),  any_number(choices, 2.5),
                  any_workers(choices),    any_choice(choices, 2),
                  any_number(choices, 1.0)},
          dtw{sizeof dtw,
              nullptr,
              any_choice(choices, 5),
              any_number(choices, 2.5),
              any_choice(choices, 2),
              any_choice(choices, 2),
              any_choice(choices, 2),
              choices.one_in(2) ? CURVEWISE_NO_WINDOW : choices.between(-3, 12),
              any_workers(choices),
              any_choice(choices, 2),
              any_number(choices, HUGE_VAL),
              choices.one_in(4) ? any_number(choices, 0.5) : 0.0,
              any_choice(choices, 2)},
          curve_length{sizeof curve_length, nullptr, any_choice(choices, 3)},
          continuous{sizeof continuous, nullptr, any_workers(choices)} {}

    const void* of(int measure) const {
        const void* const all[] = {&area, &pcm, &frechet, &dtw, &curve_length, &continuous};
        return measure >= 0 && measure < 6 ? all[measure] : nullptr;
    }
};

void check_status(int status, const curvewise_error& error) {
    require(status >= CURVEWISE_OK && status <= CURVEWISE_INVALID_ARGUMENT, "the status");
    const bool says_something = error.message[0] != '\0';
    require(std::memchr(error.message, '\0', sizeof error.message) != nullptr, "the message ends");
    require(says_something == (status != CURVEWISE_OK), "a message where, and only where, refused");
}

int call(int measure, const curvewise_curve* P, const curvewise_curve* Q, const AnyOptions& options,
         bool defaults, double* value, curvewise_error* error) {
    switch (measure) {
        case CURVEWISE_AREA:
            return curvewise_area(P, Q, defaults ? nullptr : &options.area, value, error);
        case CURVEWISE_PCM:
            return curvewise_pcm(P, Q, defaults ? nullptr : &options.pcm, value, error);
        case CURVEWISE_FRECHET:
            return curvewise_frechet(P, Q, defaults ? nullptr : &options.frechet, value, error);
        case CURVEWISE_DTW:
            return curvewise_dtw(P, Q, defaults ? nullptr : &options.dtw, value, error);
        case CURVEWISE_CURVE_LENGTH:
            return curvewise_curve_length(P, Q, defaults ? nullptr : &options.curve_length, value,
                                          error);
        default:
            return curvewise_frechet_continuous(P, Q, defaults ? nullptr : &options.continuous,
                                                value, error);
    }
}

void check_single(Choices& choices) {
    const AnyCurve P(choices), Q(choices);
    const AnyOptions options(choices);
    const int measure = static_cast<int>(choices.index(6));
    const bool defaults = choices.one_in(4);
    double value = untouched;
    curvewise_error error;
    const int status = call(measure, P.get(), Q.get(), options, defaults, &value, &error);
    check_status(status, error);
    require((status == CURVEWISE_OK) == (value != untouched), "the result left alone");
    if (status == CURVEWISE_OK) {
        require(P.is_finite() && Q.is_finite(), "numbers that are none refused");
        require(value >= 0.0, "a number");
        double again = untouched;
        call(measure, P.get(), Q.get(), options, defaults, &again, nullptr);
        require(std::memcmp(&value, &again, sizeof value) == 0, "the same again");
    }
    require(call(measure, P.get(), Q.get(), options, defaults, nullptr, &error) ==
                CURVEWISE_INVALID_ARGUMENT,
            "no place for the result");
}

void check_normalize(Choices& choices) {
    const AnyCurve P(choices), C(choices);
    std::vector<double> out(64, untouched);
    curvewise_error error;
    check_status(
        curvewise_normalize(P.get(), C.get(), choices.one_in(16) ? nullptr : out.data(), &error),
        error);
}

void check_batch(Choices& choices) {
    std::vector<AnyCurve> kept;
    const std::ptrdiff_t na = choices.between(0, 3), nb = choices.between(0, 3);
    for (std::ptrdiff_t k = 0; k < na + nb; ++k) kept.emplace_back(choices);
    std::vector<curvewise_curve> curves;
    for (const AnyCurve& one : kept) curves.push_back(one.curve());
    const AnyOptions options(choices);
    const int measure = any_choice(choices, 6);
    const curvewise_batch_options batch = {sizeof batch, nullptr, any_workers(choices),
                                           any_number(choices, HUGE_VAL)};
    const void* const given = choices.one_in(4) ? nullptr : options.of(measure);
    std::vector<double> out(40, untouched);
    double* const place = choices.one_in(16) ? nullptr : out.data();
    curvewise_error error;
    const auto* const a = choices.one_in(32) ? nullptr : curves.data();
    int status = 0;
    if (choices.one_in(3)) {
        const std::ptrdiff_t k = choices.one_in(16) ? -1 : na + nb;
        status = curvewise_pdist(a, k, measure, given, choices.one_in(4) ? nullptr : &batch, place,
                                 &error);
    } else {
        status = curvewise_cdist(a, na, curves.data() + na, nb, measure, given,
                                 choices.one_in(4) ? nullptr : &batch, place, &error);
    }
    check_status(status, error);
    for (const double value : out) require(!std::isnan(value), "no nan in a batch");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    test::ByteChoices choices(data, size);
    switch (choices.index(4)) {
        case 0:
            check_normalize(choices);
            break;
        case 1:
            check_batch(choices);
            break;
        default:
            check_single(choices);
            break;
    }
    return 0;
}
