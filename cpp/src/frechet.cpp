#include "curvewise/frechet.hpp"

#include "table_measure.hpp"

namespace curvewise {

using detail::TableOptions;
using detail::TableProblem;
using detail::with_table;

double frechet(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
               Control* control) {
    return with_table(TableOptions(options), P, Q, control,
                      [](TableProblem& problem) { return problem.distance(); });
}

Alignment frechet_path(const CurveView& P, const CurveView& Q, const FrechetOptions& options,
                       Control* control) {
    return with_table(TableOptions(options), P, Q, control,
                      [](TableProblem& problem) { return problem.alignment(); });
}

void frechet_table(const CurveView& P, const CurveView& Q, double* out,
                   const FrechetOptions& options, Control* control) {
    with_table(TableOptions(options), P, Q, control, [&](TableProblem& problem) {
        problem.write_table(out);
        return out;
    });
}

}  // namespace curvewise
