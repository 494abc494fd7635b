// Curves in the containers that a program has. Every call reads the points where they are.
#include <array>
#include <cstddef>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <vector>
#if __has_include(<span>) && __cplusplus >= 202002L
#include <span>
#endif

namespace {

struct Point {
    double x, y;
};
struct Record {  // of a data logger: x and y are neighbours, between other numbers
    double time, x, y, temperature;
};

void show(const char* name, double value) { std::printf("%s %.17g\n", name, value); }

}  // namespace

int main() {
    const std::vector<Point> points{{0, 0}, {1, 1.5}, {2, 2.25}, {3, 2.5}};
    const double array[3][2] = {{0, 0.25}, {1.5, 1.75}, {3, 2.25}};
    show("points_and_array", curvewise::dtw(points, array));

    const std::vector<std::array<double, 2>> arrays{{0, 0.25}, {1.5, 1.75}, {3, 2.25}};
    show("vector_of_arrays", curvewise::dtw(points, arrays));

    // Members of a struct, by strides that count doubles.
    const std::vector<Record> log{{0.0, 0, 0.25, 20}, {0.1, 1.5, 1.75, 21}, {0.2, 3, 2.25, 22}};
    const auto stride = static_cast<std::ptrdiff_t>(sizeof(Record) / sizeof(double));
    const curvewise::CurveView logged(&log[0].x, 3, 2, stride, 1);
    show("members_of_structs", curvewise::dtw(points, logged));
    const curvewise::CurveView backwards(&log[2].x, 3, 2, -stride, 1);
    show("backwards", curvewise::dtw(points, backwards));

    // A list of numbers is a curve in one dimension.
    const std::vector<double> signal{0, 1, 4, 2}, shifted{0, 0, 1, 4, 2};
    show("one_dimension", curvewise::dtw(signal, shifted));

    // Column-major, as in Fortran and MATLAB: all x, then all y.
    const double columns[] = {0, 1.5, 3, 0.25, 1.75, 2.25};
    show("column_major", curvewise::dtw(points, curvewise::CurveView(columns, 3, 2, 1, 3)));

    // A list of floats, which are converted one curve at a time.
    const float floats[] = {0, 0.25F, 1.5F, 1.75F, 3, 2.25F};
    double distance = 0.0;
    curvewise::cdist({points}, {curvewise::CurveView(floats, 3, 2, 2, 1)}, curvewise::DtwOptions{},
                     &distance);
    show("floats", distance);

#ifdef __cpp_lib_span
    // A part of a container, in C++20.
    show("span", curvewise::dtw(std::span(points).first(3), std::span(arrays)));
#endif
}
