// A server of tracks: clients ask for the nearest track on their own threads while new tracks come
// in. No call waits for another, and a search sees the tracks that were there when it began.
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <curvewise/curvewise.hpp>
#include <limits>
#include <thread>
#include <vector>

namespace {

using Track = std::vector<std::array<double, 2>>;

Track track(int number, double shift = 0.0) {
    Track points;
    for (int i = 0; i < 24; ++i) {
        points.push_back({1.0 * i, number + (i * number % 7) / 8.0 + shift});
    }
    return points;
}

std::vector<Track> tracks(int first, int end) {
    std::vector<Track> list;
    for (int number = first; number < end; ++number) list.push_back(track(number));
    return list;
}

struct Nearest {
    std::int64_t place = -1;
    double distance = std::numeric_limits<double>::infinity();
};

Nearest nearest(const curvewise::Index& index, const Track& probe) {
    Nearest found;
    index.kneighbors({probe}, 1, &found.distance, &found.place);
    return found;
}

}  // namespace

int main() {
    const std::vector<Track> first = tracks(0, 8);
    curvewise::Index index({first.begin(), first.end()}, curvewise::FrechetOptions{});
    std::atomic<bool> is_open{true};
    std::atomic<int> worse{0};

    std::vector<std::thread> clients;
    for (int number : {40, 55}) {
        clients.emplace_back([&, number] {
            const Track probe = track(number, 0.25);
            Nearest best;
            while (is_open) {
                const Nearest found = nearest(index, probe);
                if (found.distance > best.distance) ++worse;  // tracks only come, so never
                best = found;
            }
        });
    }
    for (int number = 8; number < 64; number += 8) {
        const std::vector<Track> more = tracks(number, number + 8);
        index.add({more.begin(), more.end()});
    }
    is_open = false;
    for (std::thread& client : clients) client.join();

    const Nearest found = nearest(index, track(40, 0.25));
    std::printf("tracks %d\n", static_cast<int>(index.size()));
    std::printf("worse %d\n", worse.load());
    std::printf("nearest %d\n", static_cast<int>(found.place));
    std::printf("distance %.17g\n", found.distance);
}
