// Random nasty pairs and options, without end: every measure against a textbook's definition, which
// shares no code with the library (textbook_*.hpp). The draws depend only on the seed and the
// number of the round. So a run can be stopped and resumed, and a failure can be reproduced alone.
//
//   CURVEWISE_ISA=v3 random_pairs --pairs 1000000 --seed 1 --state v3.state
//   random_pairs --seed 1 --round 8123
//
// A round is one pair, or two lists of up to 12 pairs. --state names a file to which the run writes
// its counts from time to time, and from which it continues. The exit status is 1 if anything was
// wrong.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "check_continuous.hpp"
#include "check_mean_gradient_compare.hpp"
#include "check_planar.hpp"
#include "check_warping.hpp"
#include "choices.hpp"
#include "curvewise/build_info.hpp"
#include "record.hpp"

namespace {

using stress::Record;

struct Run {
    std::uint64_t seed = 1;
    std::uint64_t round = 0;
    std::int64_t pairs = 0;
    std::map<std::string, std::int64_t> pairs_of;
    Record record;
};

// Most rounds are the sweeps', whose code differs from level to level. A round of the continuous
// distance, whose extremes take numbers of thousands of bits, takes as long as a hundred of them.
void play(Run& run) {
    test::RandomChoices choices(run.seed, run.round);
    run.record.begin("--seed " + std::to_string(run.seed) + " --round " +
                     std::to_string(run.round));
    const auto count = [&](const char* part, std::ptrdiff_t pairs) {
        run.pairs += pairs;
        run.pairs_of[part] += pairs;
    };
    try {
        const std::uint64_t place = run.round % 32;
        if (run.round % 4096 == 0) {
            count("dtw and frechet, large", stress::check_large(choices, run.record));
        } else if (place == 1) {
            count("frechet_continuous", stress::check_continuous(choices, run.record));
        } else if (place < 6) {
            count("area, pcm, curve_length, pointwise", stress::check_planar(choices, run.record));
        } else if (place < 10) {
            count("means, gradients, compare, stopping",
                  stress::check_mean_gradient_compare(choices, run.record));
        } else {
            count("dtw and frechet", stress::check_warping(choices, run.record));
        }
    } catch (const std::exception& error) {
        run.record.is_true("no exception", false, {}, error.what());
    }
    ++run.round;
}

// Lines of a number or two, a tabulator, and the name of the count.
void write_state(const Run& run, const std::string& path) {
    std::ofstream out(path + ".new");
    out << run.seed << ' ' << run.round << ' ' << run.pairs << '\n';
    for (const auto& [part, pairs] : run.pairs_of) out << "pairs " << pairs << '\t' << part << '\n';
    for (const auto& [what, count] : run.record.counts()) {
        out << "compared " << count.compared << ' ' << count.wrong << '\t' << what << '\n';
    }
    for (const auto& [what, count] : run.record.skipped()) {
        out << "skipped " << count << '\t' << what << '\n';
    }
    out.close();
    std::rename((path + ".new").c_str(), path.c_str());
}

void read_state(Run& run, const std::string& path) {
    std::ifstream in(path);
    std::string line;
    if (!std::getline(in, line)) return;
    std::istringstream(line) >> run.seed >> run.round >> run.pairs;
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::string kind, what;
        std::int64_t count = 0, wrong = 0;
        fields >> kind >> count;
        if (kind == "compared") fields >> wrong;
        fields.get();
        std::getline(fields, what);
        if (kind == "pairs") run.pairs_of[what] = count;
        if (kind == "compared") run.record.counts()[what] = {count, wrong};
        if (kind == "skipped") run.record.skipped()[what] = count;
    }
}

std::int64_t print(const Run& run) {
    std::int64_t compared = 0, wrong = 0;
    for (const auto& [part, pairs] : run.pairs_of) {
        std::printf("%12lld pairs  %s\n", static_cast<long long>(pairs), part.c_str());
    }
    for (const auto& [what, count] : run.record.counts()) {
        std::printf("%12lld compared, %lld wrong  %s\n", static_cast<long long>(count.compared),
                    static_cast<long long>(count.wrong), what.c_str());
        compared += count.compared;
        wrong += count.wrong;
    }
    for (const auto& [what, count] : run.record.skipped()) {
        std::printf("%12lld skipped  %s\n", static_cast<long long>(count), what.c_str());
    }
    const char* level = std::getenv("CURVEWISE_ISA");
    std::printf("seed %llu, level %s: %llu rounds, %lld pairs, %lld comparisons, %lld wrong\n",
                static_cast<unsigned long long>(run.seed), level == nullptr ? "best" : level,
                static_cast<unsigned long long>(run.round), static_cast<long long>(run.pairs),
                static_cast<long long>(compared), static_cast<long long>(wrong));
    return wrong;
}

}  // namespace

int main(int argc, char** argv) {
    Run run;
    std::int64_t pairs = 10000;
    bool one_round = false;
    std::string state;
    for (int k = 1; k + 1 < argc; k += 2) {
        const std::string option = argv[k];
        const long long value = std::atoll(argv[k + 1]);
        if (option == "--seed") run.seed = static_cast<std::uint64_t>(value);
        if (option == "--pairs") pairs = value;
        if (option == "--state") state = argv[k + 1];
        if (option == "--round") {
            run.round = static_cast<std::uint64_t>(value);
            one_round = true;
        }
    }
    if (!state.empty()) read_state(run, state);
    auto written = std::chrono::steady_clock::now();
    do {
        play(run);
        const auto now = std::chrono::steady_clock::now();
        if (!state.empty() && now - written > std::chrono::seconds(10)) {
            write_state(run, state);
            written = now;
        }
    } while (!one_round && run.pairs < pairs);
    if (!state.empty()) write_state(run, state);
    return print(run) > 0 ? 1 : 0;
}
