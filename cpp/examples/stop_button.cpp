// A stop button: a worker thread computes, the thread of the window shows the progress and stops
// it.
#include <array>
#include <chrono>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <future>
#include <thread>
#include <vector>

namespace {

using Points = std::vector<std::array<double, 2>>;

Points line(int n, int number) {
    Points points;
    for (int i = 0; i < n; ++i) points.push_back({1.0 * i, 1.0 * (i * number % 17)});
    return points;
}

// A computation that a window shows: it runs in a thread, and can be stopped.
class Computation {
   public:
    Computation(const Points& P, const Points& Q)
        : result_(std::async(std::launch::async, [this, &P, &Q] {
              curvewise::DtwOptions options;
              options.prune = false;
              return curvewise::dtw(P, Q, options, &control_);
          })) {}

    double progress() const {
        const double total = static_cast<double>(control_.total());
        return total > 0.0 ? static_cast<double>(control_.done()) / total : 0.0;
    }
    void press_stop() { control_.stop(); }
    bool is_ready() const {
        return result_.wait_for(std::chrono::milliseconds(1)) == std::future_status::ready;
    }
    double result() { return result_.get(); }  // throws Stopped

   private:
    curvewise::Control control_;
    std::future<double> result_;
};

}  // namespace

int main() {
    const Points P = line(1000, 3), Q = line(800, 5);
    Computation brief(P, Q);
    while (!brief.is_ready()) std::fprintf(stderr, "%3.0f %%\n", 100.0 * brief.progress());
    std::printf("dtw %.17g\n", brief.result());
    std::printf("progress %g\n", brief.progress());

    const Points R = line(200'000, 3), S = line(160'000, 5);  // minutes
    Computation lengthy(R, S);
    while (lengthy.progress() == 0.0) std::this_thread::yield();
    lengthy.press_stop();
    try {
        std::printf("dtw %.17g\n", lengthy.result());
    } catch (const curvewise::Stopped& stopped) {
        std::printf("%s\n", stopped.what());
    }
    return lengthy.progress() < 1.0 ? 0 : 1;
}
