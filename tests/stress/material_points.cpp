// Random points of material against a textbook's integration in 10^5 increments, and their slopes
// against central differences in quadruple precision of the same formulas.
//
//   material_points [draws] [seed]         1,000 draws of five sets of parameters, one a loop
//
// Prints the largest errors: of the stress, relative to the largest stress; of the slopes by each
// parameter, relative to the largest by that parameter. A point at which
// the material begins to yield within the difference has a kink and is left out. Ends with 1 where
// one is above 1e-8, 1e-7.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "materials/check_materials.hpp"

int main(int argc, char** argv) {
    const int draws = argc > 1 ? std::atoi(argv[1]) : 1000;
    test::Generator generator(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    const std::vector<test::Errors> found = test::errors_of_all(generator, draws, 100000);
    bool is_wrong = false;
    for (const test::Errors& one : found) {
        std::printf("%-38s %4d sets: stress %.1e, slopes %.1e (%ld of %ld at kinks)\n",
                    one.material.c_str(), one.sets, one.stress, one.slopes, one.kinks, one.points);
        is_wrong = is_wrong || !(one.stress <= 1e-8 && one.slopes <= 1e-7);
    }
    return is_wrong ? 1 : 0;
}
