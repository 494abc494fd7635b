// The variants of dtw that its own sweep does not have, as recurrences.
#pragma once

#include "curvewise/dtw.hpp"
#include "curvewise/recurrence.hpp"

namespace curvewise::warping {

inline bool is_relaxed(const DtwOptions& options) noexcept {
    return options.relax != decltype(options.relax){};
}

// Whether dtw's own sweep has the options: symmetric1 or symmetric2, without a penalty and relax,
// and with open ends the first alone.
inline bool is_swept_by_dtw(const DtwOptions& options) noexcept {
    const bool is_open = options.open_begin || options.open_end;
    return options.own_steps.rows.empty() && options.penalty == 0.0 && !is_relaxed(options) &&
           (options.step_pattern == StepPattern::symmetric1 ||
            (options.step_pattern == StepPattern::symmetric2 && !is_open));
}

// Throws std::invalid_argument for options that do not go together.
Recurrence recurrence_of(const DtwOptions& options);
// The same without the division of normalize, which paths and tables do not look at.
Recurrence recurrence_of_path(DtwOptions options);

}  // namespace curvewise::warping
