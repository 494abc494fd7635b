// The C interface: curves, controls, the version.
#include <chrono>

#include "interface/c_translate.hpp"

namespace {

using curvewise::c::at;
using curvewise::c::guarded;

curvewise::Control::Report report_of(curvewise_report report, void* context) {
    if (report == nullptr) return {};
    return [=](std::int64_t done, std::int64_t total) { return report(context, done, total) != 0; };
}

}  // namespace

curvewise_curve curvewise_rows(const double* data, ptrdiff_t n, ptrdiff_t dim) {
    return {data, n, dim, dim, 1};
}

int curvewise_control_create(curvewise_report report, void* context, int interval,
                             curvewise_control** control, curvewise_error* error) {
    return guarded(error, [&] {
        curvewise_control*& created = at(control, "control");
        if (interval < 0) {
            throw std::invalid_argument("interval is " + std::to_string(interval) +
                                        "; give a whole number >= 0");
        }
        created = new curvewise_control{
            curvewise::Control(report_of(report, context), std::chrono::milliseconds(interval))};
    });
}

void curvewise_control_destroy(curvewise_control* control) { delete control; }

void curvewise_control_stop(curvewise_control* control) {
    if (control != nullptr) control->control.stop();
}

int curvewise_control_stopped(const curvewise_control* control) {
    return control != nullptr && control->control.stopped() ? 1 : 0;
}

int64_t curvewise_control_done(const curvewise_control* control) {
    return control == nullptr ? 0 : control->control.done();
}

int64_t curvewise_control_total(const curvewise_control* control) {
    return control == nullptr ? 0 : control->control.total();
}

const char* curvewise_version(void) { return curvewise::version; }
