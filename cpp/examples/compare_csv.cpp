// compare_csv A.csv B.csv [scaled|paper|raw]: the five measures of two loops, as `curvewise
// compare` gives them. A file has one point a line, in its first two columns, separated by commas,
// semicolons or blanks; lines that do not begin with a number are skipped.
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

curvewise::Preset preset(const std::string& name) {
    if (name == "scaled") return curvewise::Preset::scaled;
    if (name == "paper") return curvewise::Preset::paper;
    if (name == "raw") return curvewise::Preset::raw;
    throw std::runtime_error("unknown preset " + name + "; choose from scaled, paper, raw");
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 3 && count != 4)
        throw std::runtime_error("give two files, and a preset if need be");
    const Points experiment = read(arguments[1]), simulation = read(arguments[2]);
    const curvewise::Comparison found =
        curvewise::compare(experiment, simulation, preset(count == 4 ? arguments[3] : "scaled"));
    std::printf("area %.17g\n", *found.area);
    std::printf("pcm %.17g\n", *found.pcm);
    std::printf("frechet %.17g\n", found.frechet);
    std::printf("dtw %.17g\n", found.dtw);
    std::printf("curve_length %.17g\n", *found.curve_length);
} catch (const std::exception& error) {
    std::fprintf(stderr, "compare_csv: %s\n", error.what());
    return 1;
}
