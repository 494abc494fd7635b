// compare_csv A.csv B.csv: the five measures of two loops, both scaled by the box of the first, as
// `curvewise compare` gives them. A file has one point a line, in its first two columns, separated
// by commas, semicolons or blanks; lines that do not begin with a number are skipped.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <curvewise/curvewise.hpp>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Points = std::vector<std::array<double, 2>>;

Points read(const char* file) {
    std::ifstream lines(file);
    if (!lines) throw std::runtime_error(std::string(file) + " cannot be read");
    Points points;
    for (std::string line; std::getline(lines, line);) {
        const char* const begin = line.c_str();
        char* end = nullptr;
        const double x = std::strtod(begin, &end);
        if (end == begin) continue;
        const char* second = end;
        while (*second == ',' || *second == ';') ++second;
        const double y = std::strtod(second, &end);
        if (end == second) throw std::runtime_error(std::string(file) + ": one column: " + line);
        points.push_back({x, y});
    }
    return points;
}

Points scaled(const Points& box, const Points& curve) {
    Points result(curve.size());
    curvewise::normalize(box, curve, result.empty() ? nullptr : result.front().data());
    return result;
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 3) throw std::runtime_error("give two files");
    const Points experiment = read(arguments[1]), simulation = read(arguments[2]);
    const Points P = scaled(experiment, experiment), Q = scaled(experiment, simulation);
    curvewise::CurveLengthOptions length;
    length.scale = curvewise::LengthScale::mean_abs;  // loops are centred on zero
    std::printf("area %.17g\n", curvewise::area(P, Q));
    std::printf("pcm %.17g\n", curvewise::pcm(P, Q));
    std::printf("frechet %.17g\n", curvewise::frechet(P, Q));
    std::printf("dtw %.17g\n", curvewise::dtw(P, Q));
    std::printf("curve_length %.17g\n", curvewise::curve_length(P, Q, length));
} catch (const std::exception& error) {
    std::fprintf(stderr, "compare_csv: %s\n", error.what());
    return 1;
}
