// Threads that wait for each other: a strip begins when the one above it has got far enough,
// however long that takes, unless the work is given up meanwhile. And the executor of a program,
// which runs tasks at once, later, too late, or not at all.
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <queue>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "check.hpp"
#include "curvewise/control.hpp"
#include "curvewise/curvewise.hpp"
#include "runtime/workers.hpp"

namespace {

using curvewise::Control;
using curvewise::CurveView;
using curvewise::runtime::Pipeline;
using curvewise::runtime::Poller;

constexpr auto longer_than_a_look = std::chrono::milliseconds(50);

void a_strip_waits_for_the_one_above() {
    Pipeline pipeline(2);
    CHECK_EQUAL(pipeline.take(), 0);
    CHECK_EQUAL(pipeline.take(), 1);
    CHECK_EQUAL(pipeline.take(), -1);
    std::atomic<bool> has_waited{false};
    std::thread below([&] {
        Poller poller(nullptr);
        CHECK(pipeline.wait(0, 1000, poller));  // nothing is above
        CHECK(pipeline.wait(1, 7, poller));
        has_waited = true;
    });
    pipeline.publish(0, 6);
    std::this_thread::sleep_for(longer_than_a_look);
    CHECK(!has_waited);
    pipeline.publish(0, 7);
    below.join();
    CHECK(has_waited);
    CHECK(!pipeline.is_finished(0));
    pipeline.finish(0);
    CHECK(pipeline.is_finished(0));
    CHECK(!pipeline.is_finished(1));
}

void a_strip_that_waits_hears_of_a_stop() {
    Pipeline pipeline(2);
    Control control;
    std::thread other([&] {
        std::this_thread::sleep_for(longer_than_a_look);
        control.stop();
    });
    Poller poller(&control);
    CHECK(!pipeline.wait(1, 7, poller));
    other.join();
}

// A batch, and one table that four threads sweep together.
struct Results {
    std::vector<double> distances;
    double distance;
};

std::vector<double> walk(std::ptrdiff_t n, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> step;
    std::vector<double> points(static_cast<std::size_t>(n));
    for (double& point : points) point = step(random);
    return points;
}

Results computed(Control* control, std::ptrdiff_t workers) {
    std::vector<std::vector<double>> walks;
    for (unsigned seed = 0; seed < 30; ++seed) walks.push_back(walk(80, seed));
    const std::vector<CurveView> views(walks.begin(), walks.end());
    const std::vector<double> P = walk(9000, 50), Q = walk(3000, 51);
    curvewise::DtwOptions options;
    const auto distances = curvewise::pdist(views, options, {workers}, control);
    options.workers = workers;
    options.prune = false;
    return {distances, curvewise::dtw(P, Q, options, control)};
}

void check_same(const Results& a, const Results& b) {
    CHECK(a.distances == b.distances);
    CHECK_EQUAL(a.distance, b.distance);
}

using Task = std::function<void()>;

// Threads that run what they are given, in order.
class Pool {
   public:
    explicit Pool(int count) {
        for (int i = 0; i < count; ++i) threads_.emplace_back([this] { run(); });
    }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    ~Pool() {
        for (std::size_t i = 0; i < threads_.size(); ++i) submit({});
        for (std::thread& thread : threads_) thread.join();
    }

    void submit(Task task) {
        const std::lock_guard<std::mutex> lock(mutex_);
        tasks_.push(std::move(task));
        changed_.notify_one();
    }

   private:
    void run() {
        for (;;) {
            std::unique_lock<std::mutex> lock(mutex_);
            changed_.wait(lock, [this] { return !tasks_.empty(); });
            const Task task = std::move(tasks_.front());
            tasks_.pop();
            lock.unlock();
            if (!task) return;
            task();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::queue<Task> tasks_;
    std::vector<std::thread> threads_;
};

void an_executor_has_the_tasks() {
    const Results expected = computed(nullptr, 1);
    for (const int size : {1, 3}) {
        Pool pool(size);
        Control control;
        std::atomic<int> tasks{0};
        control.run_on([&](Task task) {
            ++tasks;
            pool.submit(std::move(task));
        });
        check_same(computed(&control, 4), expected);
        CHECK_EQUAL(tasks, 6);
        check_same(computed(&control, 1), expected);
        CHECK_EQUAL(tasks, 6);  // one worker needs none
    }
    Control at_once;
    at_once.run_on([](const Task& task) { task(); });
    check_same(computed(&at_once, 4), expected);
}

void tasks_that_come_late_find_nothing() {
    const Results expected = computed(nullptr, 1);
    std::vector<Task> late;
    {
        Control control;
        control.run_on([&](Task task) { late.push_back(std::move(task)); });
        check_same(computed(&control, 4), expected);
    }
    CHECK_EQUAL(late.size(), 6U);
    for (const Task& task : late) task();
}

void an_executor_may_refuse() {
    Control control;
    int tasks = 0;
    control.run_on([&](const Task& /*task*/) {
        ++tasks;
        throw 1;
    });
    check_same(computed(&control, 4), computed(nullptr, 1));
    CHECK_EQUAL(tasks, 2);  // each of both calls asks once
}

// All threads of the pool call the library, so that no thread is left for its tasks.
void a_full_pool_does_not_deadlock() {
    const Results expected = computed(nullptr, 1);
    std::array<Results, 2> found;
    {
        Pool pool(2);
        for (Results& result : found) {
            pool.submit([&] {
                Control control;
                control.run_on([&](Task task) { pool.submit(std::move(task)); });
                result = computed(&control, 4);
            });
        }
    }
    for (const Results& result : found) check_same(result, expected);
}

void a_stop_reaches_the_tasks() {
    Pool pool(2);
    Control control([](std::int64_t /*done*/, std::int64_t /*total*/) { return false; },
                    std::chrono::milliseconds(0));
    control.run_on([&](Task task) { pool.submit(std::move(task)); });
    CHECK_THROWS(computed(&control, 3), curvewise::Stopped, "stopped before the work was done");
}

}  // namespace

int main() {
    return check::run({{"a strip waits for the one above", a_strip_waits_for_the_one_above},
                       {"a strip that waits hears of a stop", a_strip_that_waits_hears_of_a_stop},
                       {"an executor has the tasks", an_executor_has_the_tasks},
                       {"tasks that come late find nothing", tasks_that_come_late_find_nothing},
                       {"an executor may refuse", an_executor_may_refuse},
                       {"a full pool does not deadlock", a_full_pool_does_not_deadlock},
                       {"a stop reaches the tasks", a_stop_reaches_the_tasks}});
}
