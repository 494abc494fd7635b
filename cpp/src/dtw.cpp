#include "curvewise/dtw.hpp"

#include "table_measure.hpp"

namespace curvewise {

using detail::TableOptions;
using detail::TableProblem;
using detail::with_table;

double dtw(const CurveView& P, const CurveView& Q, const DtwOptions& options, Control* control) {
    return with_table(TableOptions(options), P, Q, control,
                      [](TableProblem& problem) { return problem.distance(); });
}

Alignment dtw_path(const CurveView& P, const CurveView& Q, const DtwOptions& options,
                   Control* control) {
    return with_table(TableOptions(options), P, Q, control,
                      [](TableProblem& problem) { return problem.alignment(); });
}

void dtw_table(const CurveView& P, const CurveView& Q, double* out, const DtwOptions& options,
               Control* control) {
    with_table(TableOptions(options), P, Q, control, [&](TableProblem& problem) {
        problem.write_table(out);
        return out;
    });
}

}  // namespace curvewise
